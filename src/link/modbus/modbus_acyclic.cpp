#include "link/modbus/modbus_acyclic.h"

namespace nord_driver::link {

ModbusRequest requestOf(const RegisterOrder& order) noexcept {
  ModbusRequest request;
  if (order.write) {
    request.function = ModbusFunction::kWriteRegisters;
    request.write = order.registers;
    request.values = order.values.data();
  } else {
    request.function =
        order.input_registers ? ModbusFunction::kReadInputRegisters : ModbusFunction::kReadHoldingRegisters;
    request.read = order.registers;
  }
  return request;
}

bool ModbusAcyclic::ask(const ModbusRequest& request, const Wakeup& stop) noexcept {
  if (!connection_.exchange(request, stop)) {
    reason_ = connection_.reason();
    return false;
  }
  ++requests_;
  return true;
}

bool ModbusAcyclic::watchdogFailed() noexcept {
  const Sentence why = reason_;
  reason_.format("the watchdog of the gateway was not set: %.200s", why.c_str());
  return false;
}

bool ModbusAcyclic::writeWatchdog(const Wakeup& stop) noexcept {
  if (!settings_.watchdog) return true;
  ModbusRequest write;
  write.function = ModbusFunction::kWriteRegisters;
  write.write = {settings_.watchdog->address, 1};
  write.values = &settings_.watchdog->value;
  return ask(write, stop) || watchdogFailed();
}

bool ModbusAcyclic::checkWatchdog(const Wakeup& stop) noexcept {
  if (!settings_.watchdog) return true;
  const WatchdogRegister& watchdog = *settings_.watchdog;
  ModbusRequest read;
  read.function = ModbusFunction::kReadHoldingRegisters;
  read.read = {watchdog.address, 1};
  if (!ask(read, stop)) return watchdogFailed();
  if (connection_.answered(0) == watchdog.value) return true;
  reason_.format(
      "%s holds %u in its watchdog register %u after %u was written there: it would not stop the drives as "
      "configured",
      settings_.server.c_str(), connection_.answered(0), watchdog.address, watchdog.value);
  return false;
}

bool ModbusAcyclic::readRunning(RunningState& state, const Wakeup& stop) noexcept {
  RunningState read;
  read.known = true;
  read.asked = std::chrono::steady_clock::now();
  if (!settings_.running) {
    state = read;
    return true;
  }
  const RunningFlag& flag = *settings_.running;
  ModbusRequest request;
  request.function = flag.function;
  request.read = {flag.address, 1};
  if (!ask(request, stop)) return false;
  read.value = connection_.answered(0);
  read.bus_runs = (read.value & flag.mask) == flag.value;
  state = read;
  return true;
}

bool ModbusAcyclic::carryOut(const RegisterOrder& order, RegisterAnswer& answer, const Wakeup& stop) noexcept {
  answer.good = ask(requestOf(order), stop);
  if (!answer.good) {
    answer.text = reason_;
    answer.not_taken = connection_.trouble() == ModbusTrouble::kException && connection_.exception() == kServerBusy;
    return false;
  }
  answer.text.clear();
  for (std::size_t i = 0; i < order.registers.count && !order.write; ++i) answer.values[i] = connection_.answered(i);
  return true;
}

}  // namespace nord_driver::link
