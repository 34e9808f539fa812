#include "sim_node/sim_drive_node.h"

#include <boost/function.hpp>
#include <cmath>

namespace nord_driver::sim_node {

namespace {

constexpr double kLongestDelay = 60.0;       // s
constexpr double kHighestFrequency = 400.0;  // Hz

/// "0.03", not "0.030000".
std::string inWords(double number) {
  std::string text = std::to_string(number);
  while (text.find('.') != std::string::npos && (text.back() == '0' || text.back() == '.')) {
    const bool whole = text.back() == '.';
    text.pop_back();
    if (whole) break;
  }
  return text;
}

/// Why `power_module` finds nothing to switch.
std::string withoutSupply(sim::Supply supply) {
  return supply == sim::Supply::kPartOfInverter
             ? "its bus port is part of the inverter; unplug takes the power from both"
             : "has a module of its own; unplug takes the power from both";
}

}  // namespace

SimDriveNode::SimDriveNode(ros::NodeHandle& handle, sim::RunningBus& bus, std::size_t index, const std::string& name)
    : handle_(handle), bus_(bus), index_(index), name_(name) {
  truth_ = handle_.advertise<SimDrive>("truth/" + name_, 10);
  serveFaults();
  serveStation();
  serveParameters();
  serveControl();
  serveInputs();
}

template <typename Service>
void SimDriveNode::serve(const std::string& service, Act<Service> act) {
  const boost::function<bool(typename Service::Request&, typename Service::Response&)> callback =
      [this, act](typename Service::Request& request, typename Service::Response& response) {
        response.success = true;
        const std::string message =
            bus_.withModel([&](sim::RobotSim& robot) { return act(robot.drive(index_), request, response); });
        response.message = name_ + ": " + message;
        return true;
      };
  services_.push_back(handle_.advertiseService(name_ + "/" + service, callback));
}

void SimDriveNode::serveSwitch(const std::string& service, void (*act)(sim::DriveUnit&, bool), const char* on,
                               const char* off) {
  serve<std_srvs::SetBool>(service,
                           [act, on, off](sim::DriveUnit& drive, const std_srvs::SetBool::Request& request,
                                          std_srvs::SetBool::Response&) -> std::string {
                             act(drive, request.data != 0);
                             return request.data != 0 ? on : off;
                           });
}

void SimDriveNode::serveFaults() {
  serve<SimTrip>("trip", [](sim::DriveUnit& drive, const SimTrip::Request& request, SimTrip::Response& response) {
    if (request.number == 0) {
      response.success = false;
      return std::string("number is 0; expected a fault number as P700 shows it, 102 for E10.2");
    }
    response.success = drive.inverter().powered();
    drive.inverter().trip(request.number, request.cause_stays != 0);
    return (response.success != 0 ? "tripped with fault " : "off, cannot trip with ") + std::to_string(request.number);
  });
  serve<std_srvs::Trigger>("clear_cause", [](sim::DriveUnit& drive, const auto&, auto&) {
    drive.inverter().clearCause();
    return std::string("the cause is gone, the fault waits for its acknowledgement");
  });
  serve<std_srvs::Trigger>("acknowledge", [](sim::DriveUnit& drive, const auto&, auto& response) {
    response.success = drive.inverter().acknowledge();
    return std::string(response.success != 0 ? "acknowledged at the device" : "no fault, or its cause stands");
  });
  serve<SimWarn>("warn", [](sim::DriveUnit& drive, const SimWarn::Request& request, SimWarn::Response&) {
    drive.inverter().setWarning(request.number);
    return request.number == 0 ? std::string("no warning") : "warns with " + std::to_string(request.number);
  });
}

void SimDriveNode::serveStation() {
  serveSwitch(
      "unplug", [](sim::DriveUnit& drive, bool on) { drive.setPlugged(!on); },
      "unplugged: the module is silent, the mains are off", "plugged in");
  serveSwitch(
      "power_inverter", [](sim::DriveUnit& drive, bool on) { drive.setInverterPower(on); }, "mains of the inverter on",
      "mains of the inverter off, the module lives on 24 V");
  serve<std_srvs::SetBool>("power_module", [](sim::DriveUnit& drive, const auto& request, auto& response) {
    sim::BusModule& module = drive.module();
    response.success = module.supply() == sim::Supply::kOwn;
    if (!response.success) return withoutSupply(module.supply());
    module.setPowered(request.data != 0);
    return std::string(request.data != 0 ? "24 V of its module on" : "24 V of its module off, the station is silent");
  });
  serveSwitch(
      "module_link", [](sim::DriveUnit& drive, bool on) { drive.setInverterLink(on); },
      "module and inverter are connected", "the connection between module and inverter is interrupted");
  serveSwitch(
      "mute", [](sim::DriveUnit& drive, bool on) { drive.setMute(on); }, "answers are lost", "answers get through");
  serveSwitch(
      "torn_words", [](sim::DriveUnit& drive, bool on) { drive.inverter().setTornWords(on); },
      "high words of positions are those of the telegram before", "the words of a telegram belong together");
  serveSwitch(
      "block", [](sim::DriveUnit& drive, bool on) { drive.setBlocked(on); }, "something holds the shaft",
      "the shaft is free");
  serve<SimAnswerDelay>("answer_delay", [](sim::DriveUnit& drive, const SimAnswerDelay::Request& request,
                                           SimAnswerDelay::Response& response) {
    if (!(request.seconds >= 0.0 && request.seconds <= kLongestDelay)) {
      response.success = false;
      return "seconds is " + inWords(request.seconds) + "; expected 0 to " + inWords(kLongestDelay);
    }
    drive.setAnswerDelay(seconds(request.seconds));
    sim::ParameterSwitches switches = drive.parameterSwitches();
    switches.delay = request.parameter_cycles;
    drive.setParameterSwitches(switches);
    return "answers " + inWords(request.seconds) + " s late, parameters " + std::to_string(request.parameter_cycles) +
           " telegrams late";
  });
}

void SimDriveNode::serveParameters() {
  serve<SimSetParameter>("set_parameter", [](sim::DriveUnit& drive, const SimSetParameter::Request& request,
                                             SimSetParameter::Response& response) {
    const unsigned element = request.index == 0 ? 0u : request.index - 1u;
    const unsigned first = request.parameter_set == 0 ? 0u : request.parameter_set - 1u;
    const unsigned last = request.parameter_set == 0 ? sim::ParameterStore::kSets - 1 : first;
    bool known = true;
    for (unsigned set = first; set <= last; ++set) {
      known = drive.parameters().preset(request.number, set, element, request.raw) && known;
    }
    response.success = known;
    const std::string parameter = "P" + std::to_string(request.number);
    if (known) return parameter + " is " + std::to_string(request.raw);
    return "no parameter " + parameter + " with set " + std::to_string(request.parameter_set) + " and index " +
           std::to_string(request.index);
  });
  serve<SimParameterChannel>("parameter_channel", [](sim::DriveUnit& drive, const SimParameterChannel::Request& request,
                                                     SimParameterChannel::Response&) {
    sim::ParameterSwitches switches = drive.parameterSwitches();
    switches.silent = request.silent != 0;
    switches.refuse.reset();
    if (request.refuse != 0) {
      sim::PkwRefusal refusal;
      refusal.error = request.error;
      if (request.number != 0) refusal.number = request.number;
      switches.refuse = refusal;
    }
    drive.setParameterSwitches(switches);
    if (request.silent != 0) return std::string("the parameter channel is silent");
    if (request.refuse == 0) return std::string("the parameter channel answers");
    return (request.number == 0 ? std::string("every order") : "P" + std::to_string(request.number)) +
           " is refused with error " + std::to_string(request.error);
  });
}

void SimDriveNode::serveControl() {
  serveSwitch(
      "local_control", [](sim::DriveUnit& drive, bool on) { drive.inverter().setLocalControl(on); },
      "controlled by its terminals", "controlled by the bus");
  serve<SimTerminals>(
      "terminals", [](sim::DriveUnit& drive, const SimTerminals::Request& request, SimTerminals::Response& response) {
        if (!(std::fabs(request.frequency) <= kHighestFrequency)) {
          response.success = false;
          return "frequency is " + inWords(request.frequency) + "; expected -" + inWords(kHighestFrequency) + " to " +
                 inWords(kHighestFrequency) + " Hz";
        }
        sim::Terminals terminals;
        terminals.enable = request.enable != 0;
        terminals.frequency = request.frequency;
        terminals.coast = request.coast != 0;
        terminals.quick_stop = request.quick_stop != 0;
        drive.inverter().setTerminals(terminals);
        return "terminals say " +
               (terminals.enable ? "enable with " + inWords(terminals.frequency) + " Hz" : std::string("OFF1")) +
               (terminals.coast ? ", disable voltage" : "") + (terminals.quick_stop ? ", quick stop" : "");
      });
}

void SimDriveNode::serveInputs() {
  serve<SimInputs>(
      "inputs", [](sim::DriveUnit& drive, const SimInputs::Request& request, SimInputs::Response& response) {
        sim::InverterInputs inputs;
        inputs.digital_io = request.digital_io;
        inputs.bus_out_bits = request.bus_out_bits;
        inputs.bit_10 = request.status_bit_10 != 0;
        inputs.bit_13 = request.status_bit_13 != 0;
        inputs.analog = {request.analog_input_1 / 100.0, request.analog_input_2 / 100.0};
        drive.inverter().setInputs(inputs);
        const bool taken = drive.module().setInputs(request.module_inputs);
        response.success = taken || request.module_inputs == 0;
        return std::string(response.success != 0 ? "inputs are set" : "its bus module has no inputs of its own");
      });
}

SimDrive SimDriveNode::truthOf(const sim::DriveUnit& drive) {
  const sim::InverterModel& inverter = drive.inverter();
  const sim::ExchangeCounters counters = drive.counters();
  SimDrive truth;
  truth.powered = inverter.powered();
  truth.in_data_exchange = drive.inDataExchange();
  truth.operation_enabled = inverter.state() == sim::InverterState::kOperationEnabled;
  truth.status_word = inverter.statusWord();
  truth.control_word = counters.last_control;
  truth.last_control_word_before_loss = counters.control_before_loss;
  truth.status_word_at_loss = counters.status_at_loss;
  truth.setpoint_1 = toSigned(inverter.setpoint1());
  truth.setpoint_2 = toSigned(inverter.setpoint(1));
  truth.setpoint_3 = toSigned(inverter.setpoint(2));
  truth.bus_in_bits = inverter.busInBits();
  truth.module_outputs = drive.module().outputs();
  truth.parameter_set = static_cast<std::uint8_t>(inverter.parameterSet() + 1);
  truth.frequency = inverter.frequency();
  truth.shaft_velocity = drive.shaftSpeed();
  truth.shaft_angle = drive.shaftAngle();
  truth.wheel_velocity = drive.wheelSpeed();
  truth.wheel_angle = drive.wheelAngle();
  truth.position = drive.position();
  truth.position_target = inverter.posicon().target();
  truth.position_reached = inverter.posicon().reached();
  truth.referenced = inverter.posicon().referenced();
  truth.fault_number = inverter.faultNumber();
  truth.watchdog_trips = counters.watchdog_trips;
  truth.set_switches = inverter.setSwitches();
  truth.telegrams = counters.telegrams;
  truth.zero_control_words = counters.zero_control_words;
  truth.eeprom_writes = drive.parameters().eepromWrites();
  return truth;
}

}  // namespace nord_driver::sim_node
