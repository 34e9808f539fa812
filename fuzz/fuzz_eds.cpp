// Any text as an EDS file of CANopen and of DeviceNet: read to its end, every problem names a line of it, and a
// configuration filled from it and checked against it holds nothing that could not be sent.
#include <algorithm>
#include <string>

#include "canopen/eds_check.h"
#include "devicenet/eds_check.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nord_driver;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const canopen::EdsFile file = canopen::parseEds(text);
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  for (const canopen::EdsProblem& problem : file.problems) {
    fuzz::require(problem.line >= 1 && problem.line <= lines && !problem.text.empty());
  }
  for (std::size_t i = 1; i < file.objects.size(); ++i) {
    const canopen::EdsObject &before = file.objects[i - 1], &object = file.objects[i];
    fuzz::require(before.index < object.index ||
                  (before.index == object.index && before.sub_index <= object.sub_index));
  }
  canopen::NodeConfig config;
  config.id = 32;
  config.setup = {{0x2066, 1, 103, 2}};
  config.receive_pdos.resize(2);
  config.receive_pdos[1].number = 512;
  config.transmit_pdos.resize(1);
  config = canopen::filledFromEds(config, file);
  for (const canopen::PdoConfig& pdo : config.receive_pdos) fuzz::require(pdo.cob_id <= 0x7FF);
  for (const std::string& sentence : canopen::checkAgainstEds(config, file, 250'000)) {
    fuzz::require(!sentence.empty());
  }
  const devicenet::EdsFile device = devicenet::parseEds(text);
  for (const devicenet::EdsProblem& problem : device.problems) {
    fuzz::require(problem.line >= 1 && problem.line <= lines && !problem.text.empty());
  }
  devicenet::NodeConfig module;
  module.mac = 5;
  module.io.input_bytes = module.io.output_bytes = 5;
  module = devicenet::filledFromEds(module, device);
  for (const std::string& sentence : devicenet::checkAgainstEds(module, {110, 100, false}, device)) {
    fuzz::require(sentence.compare(0, 5, "line ") == 0);
  }
  return 0;
}
