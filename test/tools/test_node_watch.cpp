// Drives watched through a node that is made up here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "catalogue/shipped.h"
#include "tools/node_watch.h"
#include "tools/usage_error.h"

namespace nord_driver::tools {
namespace {

using ::testing::ElementsAre;

/// What the node says now; the test changes it.
struct Told {
  LiveStatus status;
  bool ended = false;
  std::int32_t p102 = 250;  // raw
  int reads = 0;
};

class ToldStatus final : public StatusFeed {
 public:
  explicit ToldStatus(const Told& told) : told_(told) {}
  LiveStatus newest() override {
    if (told_.ended) throw Trouble("node /nord_driver has ended");
    return told_.status;
  }

 private:
  const Told& told_;
};

class ToldParameters final : public DriveParameters {
 public:
  ToldParameters(Told& told, DriveDescription drive) : told_(told), drive_(std::move(drive)) {}
  ParameterAnswer read(const catalogue::ParameterAddress& address) override {
    ++told_.reads;
    ParameterAnswer answer;
    if (address.number != 102) {
      answer.message = "drive left refuses it";
      return answer;
    }
    answer.success = true;
    answer.raw = told_.p102;
    answer.entry = drive_.known.find(102);
    return answer;
  }
  ParameterAnswer write(const catalogue::ParameterAccess&) override { throw Trouble("nobody writes here"); }
  const std::string& name() const override { return drive_.name; }
  profile::Series series() const override { return drive_.series; }
  DriveIdentity identity() const override { return drive_.identity; }
  const catalogue::DriveCatalogue& known() const override { return drive_.known; }

 private:
  Told& told_;
  DriveDescription drive_;
};

class ToldNodes final : public DriveNodes {
 public:
  std::optional<std::string> find(const NodeQuery&) override { return "/nord_driver"; }
  std::unique_ptr<DriveParameters> open(const std::string&, const DriveDescription& drive) override {
    return std::make_unique<ToldParameters>(drives[drive.name], drive);
  }
  std::unique_ptr<StatusFeed> statusOf(const std::string&, const std::string& drive) override {
    return std::make_unique<ToldStatus>(drives[drive]);
  }
  std::unique_ptr<CycleFeed> cyclesOf(const std::string&, const std::string&) override { return nullptr; }
  ScanReport scan(const std::string&) override { return {}; }

  std::map<std::string, Told> drives;
};

DriveDescription described(const std::string& name, std::uint8_t process_values) {
  DriveIdentity identity;
  identity.process_values = process_values;
  return {name, profile::Series::kSk5xxe, identity, {catalogue::shippedCatalogues(), profile::Series::kSk5xxe, {}}};
}

class NodeWatchTest : public ::testing::Test {
 protected:
  NodeWatchTest() {
    LiveStatus& left = nodes_.drives["left"].status;
    left.online = true;
    left.output.control_word = 0x047F;
    left.output.setpoints[0] = 4096;
    left.input.status_word = 0x0B37;
    left.input.actual_values[0] = 4095;
    left.frequency = 12.5;
    nodes_.drives["right"].status.input.status_word = 0x0B31;
  }
  NodeWatch watch(const std::vector<std::string>& parameters = {}) {
    return {nodes_, "/nord_driver", {described("left", 3), described("right", 1)}, parameters};
  }

  ToldNodes nodes_;
};

// A drive that moves, too; of one that is not there only that.
TEST_F(NodeWatchTest, ShowsWhatTheNodeTells) {
  NodeWatch watched = watch();
  const std::vector<WatchedDrive> seen = watched.look();
  ASSERT_EQ(2u, seen.size());
  EXPECT_EQ("left", seen[0].name);
  EXPECT_TRUE(seen[0].online);
  EXPECT_EQ(3, seen[0].process_values);
  EXPECT_EQ(0x047F, seen[0].output.control_word);
  EXPECT_EQ(4096, seen[0].output.setpoints[0]);
  EXPECT_EQ(0x0B37, seen[0].input.status_word);
  EXPECT_EQ(4095, seen[0].input.actual_values[0]);
  EXPECT_EQ(12.5, seen[0].frequency);
  EXPECT_EQ("none", seen[0].fault);
  EXPECT_FALSE(seen[1].online);
  EXPECT_EQ("the node has no fresh process data of it", seen[1].silence);
  EXPECT_FALSE(seen[1].frequency);
}

TEST_F(NodeWatchTest, NamesTheFault) {
  LiveStatus& left = nodes_.drives["left"].status;
  NodeWatch watched = watch();
  left.fault_number = 102;
  left.fault_text = "bus timeout of the option";
  EXPECT_EQ("E10.2 bus timeout of the option", watched.look()[0].fault);
  left.fault_number = 65535;
  EXPECT_EQ("its number is not known", watched.look()[0].fault);
}

// Each time anew; one that is not there is not asked: the node would wait for it.
TEST_F(NodeWatchTest, ReadsParametersOfDrivesThatAnswer) {
  NodeWatch watched = watch({"P102", "P105"});
  EXPECT_THAT(watched.labels(), ElementsAre("P102 Acceleration time", "P105 Maximum frequency"));
  EXPECT_THAT(watched.look()[0].values, ElementsAre("2.50 s", "drive left refuses it"));
  nodes_.drives["left"].p102 = 300;
  const std::vector<WatchedDrive> seen = watched.look();
  EXPECT_EQ("3.00 s", seen[0].values[0]);
  EXPECT_THAT(seen[1].values, ElementsAre("not read", "not read"));
  EXPECT_EQ(0, nodes_.drives["right"].reads);
}

TEST_F(NodeWatchTest, EndsWithTheNode) {
  NodeWatch watched = watch();
  watched.look();
  nodes_.drives["right"].ended = true;
  EXPECT_THROW(watched.look(), Trouble);
}

TEST_F(NodeWatchTest, RefusesAParameterThatCannotBe) {
  EXPECT_THROW(watch({"Maximum frequenzy"}), UsageError);
}

}  // namespace
}  // namespace nord_driver::tools
