// Compiled into a test program: what the programs of a user keep in ~/.ros is kept in a folder of this run, and nothing of
// the user who runs the tests is read or changed.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <memory>

#include "support/temporary_folder.h"

namespace nord_driver::test {
namespace {

class OwnRosHome final : public ::testing::Environment {
 public:
  void SetUp() override {
    folder_ = std::make_unique<TemporaryFolder>();
    ASSERT_EQ(0, ::setenv("ROS_HOME", folder_->path("ros_home").c_str(), 1));
  }
  void TearDown() override { folder_.reset(); }

 private:
  std::unique_ptr<TemporaryFolder> folder_;
};

// GoogleTest deletes it.
const ::testing::Environment* const kOwnRosHome = ::testing::AddGlobalTestEnvironment(new OwnRosHome);

}  // namespace
}  // namespace nord_driver::test
