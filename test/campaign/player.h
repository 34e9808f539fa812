// Plays one scenario: runs the driver on its simulated robot, lets happen what is written, and holds every invariant
// after each cycle. When all causes have ended, it judges whether everything is back in service.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "campaign/invariant.h"
#include "campaign/motion_invariants.h"
#include "campaign/reborn_transport.h"
#include "campaign/rig.h"
#include "campaign/scenario.h"

namespace nord_driver::test {

struct Violation {
  std::string invariant;
  std::string sentence;
  std::string what;
  unsigned at = 0;  ///< ms after the start
};

struct Outcome {
  std::optional<Violation> violation;  ///< the first one; the scenario ends with it
  TurnsOnlyAsCommanded::Stop worst_stop;
  double recovery = 0.0;  ///< s from the end of the last cause until all drives answered
  unsigned enabled = 0;   ///< enablings that succeeded
  unsigned stopped = 0;   ///< groups the driver stopped by itself
  unsigned answers = 0;
  unsigned arrived = 0;  ///< axes that went to another place, and were there
};

/// What users do, as the players know it: their `begin` and `end` are the player's own.
const std::vector<Act>& userActs();
/// Of drives, of users and of this bus. Null: there is none of this name.
const Act* findAct(const CampaignBus& bus, const std::string& name);

class Player {
 public:
  Player(const Scenario& scenario, const CampaignBus& bus, const TransportWrap& wrap = {});

  static constexpr double kFullSpeed = 7.853981633974483;  ///< rad/s at the joint: 50 Hz, two pole pairs, 20:1
  static constexpr double kHertzPerSpeed = 50.0 / kFullSpeed;

  Outcome play();

 private:
  struct Active {
    Event event;
    const Act* act = nullptr;
  };
  struct Client {
    Instant until{};
    DriveIndex drive = 0;
    std::uint32_t waits_for = 0;
  };
  struct Loss {
    Instant due{};
    std::uint64_t counted = 0;
    std::string act;
  };

  /// The first drive is not heard, as far as this act goes, or so late that its answers tell nothing; a twin stands beside it
  /// and hides nothing.
  static bool hidesTheFirst(const Active& active) {
    const bool first = active.act->cuts == Cuts::kAll || active.event.drive == 0;
    const bool hides = active.act->cuts != Cuts::kNothing || active.event.act == "late_answers";
    return first && hides && active.event.act != "twin";
  }
  Instant now() { return rig_->robot().transport().now(); }
  unsigned sinceStart() { return static_cast<unsigned>(toSeconds(now() - start_) * 1000.0 + 0.5); }
  bool goesOn() const { return !outcome_.violation; }

  void playEvents();
  void judgeRecovery();
  /// What the referee of the bus has counted.
  void judgeWire();
  void endNode();
  void kill();
  void letItSayMore();
  void respawn(Duration gone);
  void tick();
  void pass(Duration span);

  void begin(const Event& event);
  void beginUser(const Event& event);
  void endOver(unsigned at);
  void endAll();
  /// Something goes on at `at` (ms) that takes longer than it has lasted.
  bool mustLast(unsigned at) const;
  bool excluded(const Event& event, const Act& act);
  bool samePlace(const Active& active, const Event& event);
  void command();
  /// Of a drive that goes to positions, rad.
  void move(DriveIndex drive, const AskedMove& move);
  void runClients();
  void askParameter(Client& client);
  std::uint32_t submit(cycle::RequestKind kind, DriveIndex drive, Duration patience);
  std::uint32_t submit(cycle::Request request);
  void wish(const cycle::Request& request);
  bool concerns(const cycle::Request& request, const GroupWish& group) const;
  /// Somebody waits for the answer to an enabling of it.
  bool asksToEnable(const GroupWish& group) const;

  void look(Instant began, bool driver_ran);
  void seeTruth();
  void seeAnswers();
  void seeStops();
  void seeInterruptions();
  void seeArrivals();
  void forgetMoves();
  void sampleParameters();
  void watchLosses();
  std::uint64_t counted();
  /// How long a stop may take where its words reach the drive, and where only the time-outs act.
  Duration byWords();
  Duration byTimeouts();
  Duration reaction();
  Duration slowestQueue();
  bool answered(std::uint32_t id, bool& success, std::string& message);
  bool allOnline();
  void fail(const char* invariant, const char* sentence, std::string what);
  bool ask(cycle::RequestKind kind, const char* expectation);
  void judgeAxes(Instant until);

  static void presetSlowest(sim::DriveUnit& unit);
  void seeWanted();
  /// The bus, with its transport behind one that the driver may begin anew with.
  std::unique_ptr<CampaignRig> makeRig(const TransportWrap& wrap);

  Scenario scenario_;
  CampaignBus bus_;
  RebornTransport* reborn_ = nullptr;  // the rig's
  std::unique_ptr<CampaignRig> rig_;
  std::vector<std::unique_ptr<Invariant>> invariants_;
  Moment moment_;
  Outcome outcome_;
  Instant start_{};
  std::size_t next_ = 0;
  std::vector<Active> active_;
  std::optional<Instant> disturbed_;  // when something disturbed last
  std::optional<Instant> began_;      // when a driver took the place of another one
  std::vector<Call> calls_;
  std::size_t first_open_ = 0;
  std::size_t seen_answers_ = 0;
  std::uint32_t next_id_ = 1;
  std::vector<Client> clients_;
  std::vector<Loss> losses_;
  std::optional<Instant> first_hidden_at_;  // last
  std::uint32_t dice_ = 1;                  // for what clients ask
  // The newest commands.
  struct Command {
    Instant until{};  // renewed until then
    Instant given{};
    bool ever = false;
    bool followed = false;               // since its drives were enabled
    double linear = 0.0, angular = 0.0;  // base
    double velocity = 0.0;               // single drive
  };
  bool isFresh(const Command& command);
  Command& commandOf(const GroupWish& group);
  /// A stop that takes another way than setpoint_zero ends disabled, and begins when a command that was followed grew old.
  bool hasRunOut(const GroupWish& group);
  Command base_command_;
  RecentSpan linear_, angular_;  // commanded
  std::vector<Command> drive_commands_;
  Duration queue_turn_{};  // of an interface that takes a frame now and then
  Instant queue_slow_until_{};
  std::vector<double> places_;  // rad, where axes arrived last
};

}  // namespace nord_driver::test
