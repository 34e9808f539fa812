#include "node/driver_node.h"

#include <std_msgs/UInt8.h>

#include <algorithm>
#include <boost/function.hpp>
#include <cmath>
#include <thread>
#include <utility>

#include "config/driver_settings.h"
#include "config/setting_checks.h"
#include "node/eeprom_switch_end.h"
#include "node/end_poll_period.h"
#include "node/start_sentence.h"
#include "node/what_is_offered.h"
#include "nord_driver/profile/series.h"
#include "tools/counted_write.h"
#include "tools/installed_catalogues.h"

namespace nord_driver::node {

namespace {

XmlRpc::XmlRpcValue privateParameters() {
  XmlRpc::XmlRpcValue value;
  ros::NodeHandle("~").getParam("", value);
  return value;
}

// The URDF of the robot, where somebody has put it; empty when nobody has.
std::string robotDescription() {
  std::string key, text;
  if (ros::param::search("robot_description", key)) ros::param::get(key, text);
  return text;
}

// Calls that may wait for their drives at the same time, beside those that enable, stop and home.
constexpr int kSpinnerThreads = 4;
constexpr std::uint32_t kIncrementQueue = 100;
// Jobs that run at the same time; further ones wait.
constexpr int kJobThreads = 4;
constexpr int kShutDownAttempts = 50;

/// What the base does not use counts, too: whose rest is broken means nothing.
bool isFinite(const geometry_msgs::Twist& twist) {
  for (const geometry_msgs::Vector3& part : {twist.linear, twist.angular}) {
    if (!std::isfinite(part.x) || !std::isfinite(part.y) || !std::isfinite(part.z)) return false;
  }
  return true;
}

// Each drive that positions may be on its reference run, a minute long. One more: a call while they run is refused by
// the cycle at once, and would otherwise wait here and start another run when the first has ended.
std::uint32_t homingThreads(const NodeConfig& config) {
  const auto& drives = config.cycle.drives;
  const auto count =
      std::count_if(drives.begin(), drives.end(), [](const auto& drive) { return drive.position.has_value(); });
  return static_cast<std::uint32_t>(count) + 1;
}

Instant steadyNow() {
  return std::chrono::steady_clock::now();
}

}  // namespace

DriverNode::DriverNode()
    : private_node_("~"),
      commands_(node_, 1),
      private_commands_(private_node_, 1),
      jobs_(private_node_, kJobThreads),
      settings_("~", privateParameters()),
      config_(withWhatIsOffered(readNodeConfig(settings_, robotDescription()), settings_)),
      enabling_(private_node_, StopCalls::enableThreads(config_.cycle.drives.size())),
      quick_stops_(private_node_, StopCalls::quickStopThreads(config_.cycle.drives.size())),
      homing_(private_node_, homingThreads(config_)),
      catalogues_(tools::installedCatalogues(config_.parameter_files, settings_.fullName("parameter_files"))),
      loader_("nord_driver", "nord_driver::Transport"),
      eeprom_budget_(tools::eepromBudget(config_.eeprom)),
      ignored_(config_.drives.size()) {
  loadTransport();
  lookUpMonitored();
  warnOfUnknownKeys();
  ROS_INFO("nord_driver: %s", startSentence(config_, identities_, where_).c_str());
  ports_ = std::make_unique<cycle::CyclePorts>(config_.drives.size());
  cycle_ =
      std::make_unique<cycle::BusCycle>(config_.cycle, *transport_, *ports_, config_.auto_enable,
                                        config_.read_only ? cycle::CycleRole::kOnlooker : cycle::CycleRole::kDriver);
  broker_ = std::make_unique<RequestBroker>(*ports_);
  advertise();
}

DriverNode::~DriverNode() {
  if (parameter_jobs_) parameter_jobs_->end();
  // They use what goes next.
  for (CallbackThreads* lane : lanes()) lane->stop();
  thread_.reset();
  tracing_.reset();  // after the bus: what happened last is in the last trace
  services_.reset();
  parameter_jobs_.reset();
  broker_.reset();
  if (transport_) transport_->close();
}

std::array<CallbackThreads*, 6> DriverNode::lanes() noexcept {
  return {&commands_, &private_commands_, &enabling_, &quick_stops_, &jobs_, &homing_};
}

void DriverNode::loadTransport() {
  if (!loader_.isClassAvailable(config_.transport)) {
    throw unknownTransport(settings_, config_.transport, loader_.getDeclaredClasses());
  }
  transport_ = loader_.createInstance(config_.transport);
  ConfiguredTransport configured = configureTransport(config_, *transport_);
  where_ = std::move(configured.where);
  identities_ = std::move(configured.identities);
  for (const std::string& sentence : configured.warnings) ROS_WARN("nord_driver: %s", sentence.c_str());
}

std::vector<catalogue::DriveCatalogue> DriverNode::knownDrives() const {
  std::vector<catalogue::DriveCatalogue> known;
  for (DriveIndex i = 0; i < config_.cycle.drives.size(); ++i) {
    known.push_back(catalogue::driveCatalogue(catalogues_, config_.cycle.drives[i].series,
                                              shortTransportName(config_.transport),
                                              identities_[i].timeout_owner == TimeoutOwner::kModule));
  }
  return known;
}

void DriverNode::lookUpMonitored() {
  const std::vector<catalogue::DriveCatalogue> known = knownDrives();
  for (DriveIndex i = 0; i < known.size(); ++i) {
    const auto list = tools::monitoredParameters(config_.drives[i], config_.monitor[i], known[i], identities_[i]);
    const auto raw_ones = tools::notInCatalogue(config_.drives[i], list);
    config_.warnings.insert(config_.warnings.end(), raw_ones.begin(), raw_ones.end());
    for (const auto& parameter : list) config_.cycle.drives[i].monitor.push_back(parameter.access.request);
    values_.emplace_back(known[i], list);
  }
}

void DriverNode::warnOfUnknownKeys() const {
  std::vector<std::string> sentences = config_.warnings;
  for (const std::string& sentence : unknownKeys(settings_, config_, ros::this_node::getName())) {
    sentences.push_back(sentence);
  }
  for (const std::string& sentence : sentences) ROS_WARN("nord_driver: %s", sentence.c_str());
}

void DriverNode::advertise() {
  base_publisher_ = std::make_unique<BasePublisher>(node_, config_);
  if (config_.cycle.base && !config_.cycle.base->steered) {
    base_tuner_ = std::make_unique<BaseTuner>(private_node_, config_, *ports_, *base_publisher_);
  } else {
    nothing_to_tune_ = std::make_unique<NothingToTune>(private_node_);
  }
  known_ = knownDrives();
  for (const catalogue::DriveCatalogue& drive : known_) faults_.push_back(drive.faults());
  std::vector<std::string> names;
  std::vector<trace::TracedDrive> traced;
  for (DriveIndex i = 0; i < config_.drives.size(); ++i) {
    const cycle::DriveSetup& setup = config_.cycle.drives[i];
    names.push_back(setup.name);
    eeproms_.emplace_back(eeprom_budget_,
                          tools::placeOf(where_, shortTransportName(config_.transport), config_.drives[i]), setup.name,
                          transport_->parameterCapabilities(i).ram_writes);
    traced.push_back({setup.name, identities_[i].address});
    drive_publishers_.emplace_back(
        private_node_, setup, identities_[i],
        DriveProtection{identities_[i], config_.cycle.drives[i].series, config_.cycle.cmd_vel_timeout,
                        config_.cycle.period(), config_.read_only},
        faults_[i], static_cast<std::uint16_t>(setup.address.value_or(0)));
    fault_publishers_.emplace_back(private_node_, setup.name, faults_[i]);
    values_publishers_.emplace_back(private_node_, setup.name, values_[i]);
    if (cycle_->inBase(i) || cycle_->isLed(i)) continue;
    setup.position ? subscribePosition(i) : subscribeCommand(i);
  }
  word_topics_ = std::make_unique<WordTopics>(private_commands_, config_.cycle, *ports_, ignored_);
  fault_board_ = std::make_unique<FaultBoard>(names, faults_);
  bus_publisher_ = std::make_unique<BusPublisher>(private_node_, names);
  diagnostics_ = std::make_unique<Diagnostics>(config_, identities_, known_, values_, where_, ignored_);
  const ServiceLanes lanes{private_node_, enabling_.handle(), quick_stops_.handle(), homing_.handle()};
  services_ = std::make_unique<Services>(lanes, config_, known_, *fault_board_, eeproms_, *broker_);
  parameter_jobs_ = std::make_unique<ParameterJobs>(jobs_.handle(), config_, identities_, known_, eeproms_, *broker_);
  tracing_ = std::make_unique<Tracing>(private_node_, config_.trace, traced, transport_->trace());
  ports_->setObserver(&tracing_->feed());
  process_data_publisher_ = std::make_unique<ProcessDataPublisher>(private_node_, names, tracing_->feed().history());
  if (config_.cycle.base) {
    boost::function<void(const geometry_msgs::Twist&)> take = [this](const geometry_msgs::Twist& twist) {
      takeCommand(twist);
    };
    command_subscriber_ = commands_.handle().subscribe<geometry_msgs::Twist>("cmd_vel", 1, take);
  }
}

// Only looks at the command and stores it: the cycle decides.
void DriverNode::takeCommand(const geometry_msgs::Twist& twist) {
  if (!isFinite(twist)) {
    // No command at all: the time-out of the one before runs on.
    if (const auto count = ignored_.addToBase(steadyNow())) {
      ROS_WARN("nord_driver: cmd_vel is not a number or infinite, ignored (%lu so far)",
               static_cast<unsigned long>(*count));
    }
    return;
  }
  const bool sideways = config_.cycle.base->movesSideways();
  const double linear_y = sideways ? twist.linear.y : 0.0;
  cycle::TwistCommand command{{twist.linear.x, twist.angular.z, linear_y}, steadyNow(), true};
  if (!config_.publish.allow_multiple_cmd_vel_publishers && command_subscriber_.getNumPublishers() > 1) {
    if (publishers_told_.isOver(command.received)) {
      ROS_ERROR("nord_driver: %u publishers on cmd_vel, expected one: the base brakes",
                command_subscriber_.getNumPublishers());
    }
    command.held = true;
  }
  ports_->commandBase(command);
}

void DriverNode::subscribeCommand(DriveIndex drive) {
  boost::function<void(const std_msgs::Float64&)> take = [this, drive](const std_msgs::Float64& command) {
    countBadCommand(drive, "command", command.data, ports_->commandDrive(drive, {command.data, steadyNow(), true}));
  };
  const std::string topic = config_.cycle.drives[drive].name + "/command";
  subscribers_.push_back(private_commands_.handle().subscribe<std_msgs::Float64>(topic, 1, take));
}

// Of targets the newest counts; of increments each.
void DriverNode::subscribePosition(DriveIndex drive) {
  ros::NodeHandle& node = private_commands_.handle();
  const std::string prefix = config_.cycle.drives[drive].name + "/";
  boost::function<void(const std_msgs::Float64&)> target = [this, drive](const std_msgs::Float64& command) {
    countBadCommand(drive, "position command", command.data, ports_->commandPosition(drive, command.data));
  };
  subscribers_.push_back(node.subscribe<std_msgs::Float64>(prefix + "position_command", 1, target));
  boost::function<void(const std_msgs::Float64&)> increment = [this, drive](const std_msgs::Float64& command) {
    countBadCommand(drive, "position increment", command.data, ports_->commandIncrement(drive, command.data));
  };
  subscribers_.push_back(node.subscribe<std_msgs::Float64>(prefix + "position_increment", kIncrementQueue, increment));
  boost::function<void(const std_msgs::UInt8&)> element = [this, drive](const std_msgs::UInt8& command) {
    ports_->commandElement(drive, command.data);
  };
  subscribers_.push_back(node.subscribe<std_msgs::UInt8>(prefix + "position_element", 1, element));
}

void DriverNode::countBadCommand(DriveIndex drive, const char* what, double command, bool taken) {
  if (taken) return;
  if (const auto count = ignored_.add(drive, steadyNow())) {
    ROS_WARN("nord_driver: the %s of drive %s %s, ignored (%lu so far)", what, config_.cycle.drives[drive].name.c_str(),
             whyIgnored(command).c_str(), static_cast<unsigned long>(*count));
  }
}

void DriverNode::run(const std::atomic<bool>& end_asked) {
  ros::AsyncSpinner spinner(kSpinnerThreads);
  spinner.start();
  for (CallbackThreads* lane : lanes()) lane->start();
  if (config_.cycle.cmd_vel_timeout == Duration::zero()) {
    ROS_WARN("nord_driver: cmd_vel_timeout is 0: the last command is followed for ever");
  }
  thread_ = std::make_unique<cycle::CycleThread>(*cycle_, *transport_, config_.cycle.real_time);
  if (!thread_->refused().empty()) ROS_WARN("nord_driver: %s", thread_->refused().c_str());

  // Whatever ends the node, the drives come to rest first: an exchange that simply ends lets the wheels coast.
  bool healthy = true;
  try {
    const SnapshotParts parts{*base_publisher_,         drive_publishers_, values_publishers_, fault_publishers_,
                              *process_data_publisher_, *bus_publisher_,   *diagnostics_,      *fault_board_};
    publisher_.emplace(*ports_, config_.publish, parts, loggedDrives());
    const Duration pause = endPollPeriod(config_.cycle.period());
    // roscpp is "ok" until it has unregistered every topic: tenths of a second in which the robot would drive on. Nothing
    // here may take its time, a line in the log neither: two cycles after a signal the ramp has to begin.
    while (!end_asked && ros::ok() && !ros::isShuttingDown() && healthy) {
      noteCommanders();
      std::this_thread::sleep_for(pause);
      healthy = publisher_->healthy();
    }
  } catch (...) {
    bringToRest();
    throw;
  }
  bringToRest();
  if (!healthy) throw std::runtime_error("the node ended by itself: publishing failed, as said above");
}

LoggedDrives DriverNode::loggedDrives() const {
  LoggedDrives drives;
  drives.node = ros::this_node::getName();
  drives.faults = faults_;
  drives.bus = where_;
  if (!where_.empty()) drives.bus_key = config_.bus->fullName(transport_->endPoint().key);
  drives.read_only = config_.read_only;
  const auto& setups = config_.cycle.drives;
  for (DriveIndex i = 0; i < setups.size(); ++i) {
    drives.names.push_back(setups[i].name);
    drives.enabled_as.push_back(cycle_->inBase(i) ? "" : setups[setups[i].leader.value_or(i)].name);
  }
  return drives;
}

void DriverNode::noteCommanders() {
  std::uint32_t now = command_subscriber_ ? command_subscriber_.getNumPublishers() : 0;
  for (const ros::Subscriber& subscriber : subscribers_) now += subscriber.getNumPublishers();
  now += word_topics_->commanders();
  if (now > commanders_) ports_->commanderConnected(steadyNow());
  commanders_ = now;
}

void DriverNode::bringToRest() {
  const auto begun = [this] {
    if (!config_.read_only) ROS_INFO("nord_driver: bringing the drives to rest");
    parameter_jobs_->end();
    broker_->refuseWrites();
  };
  cycle::Request request;
  request.kind = cycle::RequestKind::kShutDown;
  request.patience = config_.cycle.shutdown_timeout + kQuickStopAtTheEnd;
  cycle::Completion answer = broker_->call(request, begun);
  // Services fill the queue at most for a moment; the stop must get through.
  for (int attempt = 0; attempt < kShutDownAttempts && answer.id == 0; ++attempt) {
    ros::WallDuration(0.02).sleep();
    answer = broker_->call(request, begun);
  }
  if (answer.success && config_.read_only) {
    ROS_INFO("nord_driver: ending; the drives are as they were: read_only is true");
  } else if (answer.success) {
    ROS_INFO("nord_driver: all drives are at rest, ending the exchange");
  } else {
    ROS_ERROR("nord_driver: ending, although %s", answer.message.c_str());
  }
  // Once more where no attempt has got through.
  parameter_jobs_->end();
  broker_->refuseWrites();
  publisher_.reset();
  putEepromSwitchesBack();
  thread_.reset();
  broker_->end();       // nobody is to wait for a cycle that has ended
  transport_->close();  // at once: nobody guards the nodes from here on, and the rest of the node takes its time to end
}

void DriverNode::putEepromSwitchesBack() {
  const EndingNode node{[this] { return broker_->writesUnderWay(); },
                        [this]() -> const cycle::CycleSnapshot& { return ports_->readSnapshot(); },
                        [this](const cycle::Request& request) { return broker_->call(request); }, steadyNow,
                        [](Duration time) { std::this_thread::sleep_for(time); }};
  for (const DriveIndex drive : settleEepromSwitches(node)) {
    ROS_ERROR(
        "nord_driver: P560 of drive %s is 0 and could not be put back to 1: it saves nothing in its EEPROM until it is",
        config_.cycle.drives[drive].name.c_str());
  }
}

}  // namespace nord_driver::node
