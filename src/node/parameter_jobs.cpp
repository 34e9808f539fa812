#include "node/parameter_jobs.h"

#include "config/text_file.h"
#include "node/offer.h"
#include "tools/comparison.h"
#include "tools/parameter_dump.h"
#include "tools/usage_error.h"

namespace nord_driver::node {

namespace {

tools::Dump dumpOf(const VerifyParameters::Request& request) {
  if (request.yaml.empty() == request.file.empty()) {
    throw tools::UsageError(request.yaml.empty() ? "neither yaml nor file is given, expected one of them"
                                                 : "yaml and file are given, expected one of them");
  }
  if (request.file.empty()) return tools::dumpFrom(request.yaml, "the text in yaml");
  // The node does not stand in the folder of whoever asks.
  if (request.file.front() != '/') {
    throw tools::UsageError("file: \"" + request.file + "\" is not valid, expected an absolute path");
  }
  // Whoever can call a service names it: a pipe would keep this drive busy for ever, /dev/zero take all memory.
  const std::string why = whyNoTextFile(request.file);
  if (!why.empty()) throw tools::UsageError(request.file + ": " + why);
  return tools::readDump(request.file);
}

}  // namespace

ParameterJobs::ParameterJobs(ros::NodeHandle& node, const NodeConfig& config,
                             const std::vector<DriveIdentity>& identities,
                             const std::vector<catalogue::DriveCatalogue>& known,
                             std::deque<state::DriveEeprom>& eeproms, RequestBroker& broker) {
  const CarryOut carry_out = [&broker](const cycle::Request& request) { return broker.call(request); };
  for (DriveIndex i = 0; i < config.cycle.drives.size(); ++i) {
    const cycle::DriveSetup& setup = config.cycle.drives[i];
    Drive& drive = drives_.emplace_back(
        BrokerParameters{{i, setup, identities[i], known[i], eeproms[i]}, config.cycle.service_timeout, carry_out});
    servers_.push_back(offer<DumpParameters>(node, setup.name + "/dump_parameters",
                                             [this, &drive](auto&, auto& response) { dump(drive, response); }));
    servers_.push_back(
        offer<VerifyParameters>(node, setup.name + "/verify_parameters",
                                [this, &drive](auto& request, auto& response) { verify(drive, request, response); }));
  }
}

std::string ParameterJobs::run(Drive& drive, const std::function<void()>& job) {
  const std::string name = "drive " + drive.parameters.name();
  if (drive.busy.exchange(true)) return name + ": its parameters are being dumped or verified already: ask again";
  std::string why;
  try {
    job();
  } catch (const std::exception& error) {
    why = error.what();
  }
  drive.busy = false;
  return why;
}

void ParameterJobs::dump(Drive& drive, DumpParameters::Response& response) {
  const std::string why = run(drive, [&] {
    const BrokerParameters& parameters = drive.parameters;
    const tools::Dump dump = tools::takeDump(drive.parameters, end_asked_);
    response.yaml = tools::dumpText(dump, parameters.known(), parameters.name(), parameters.identity().address);
    response.success = true;
    response.message = std::to_string(dump.values.size()) + " values of drive " + parameters.name() + " were read";
  });
  if (!why.empty()) response.message = why;
}

void ParameterJobs::verify(Drive& drive, const VerifyParameters::Request& request,
                           VerifyParameters::Response& response) {
  const std::string why = run(drive, [&] {
    BrokerParameters& parameters = drive.parameters;
    const tools::Dump dump = dumpOf(request);
    tools::refuseOtherSeries("the dump", dump.series, "drive " + parameters.name(), parameters.series());
    const tools::Dump present = tools::readAlike(parameters, dump, end_asked_);
    const tools::Differences differences = tools::differencesOf(dump, present, parameters.known());
    if (differences.compared == 0) throw tools::UsageError("the dump has no settings to compare");
    for (const tools::Difference& difference : differences.found) {
      response.differences.push_back(tools::differenceText(difference, parameters.known(), "the file", "the drive"));
    }
    response.success = differences.found.empty();
    response.message =
        std::to_string(differences.found.size()) + " of " + std::to_string(differences.compared) + " settings differ";
  });
  if (!why.empty()) response.message = why;
}

}  // namespace nord_driver::node
