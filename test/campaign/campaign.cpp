#include "campaign/campaign.h"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <iomanip>
#include <mutex>
#include <sstream>
#include <thread>

#include "campaign/generator.h"

namespace nord_driver::test {

namespace {

void add(CampaignReport& report, const Scenario& scenario, const Outcome& outcome) {
  ++report.scenarios;
  report.stops += outcome.stopped;
  report.enabled += outcome.enabled;
  report.answers += outcome.answers;
  report.arrived += outcome.arrived;
  const auto& stop = outcome.worst_stop;
  if (stop.bound > 0.0 &&
      (report.worst_stop.bound == 0.0 || stop.took * report.worst_stop.bound > report.worst_stop.took * stop.bound)) {
    report.worst_stop = stop;
    report.worst_stop_seed = scenario.seed;
  }
  if (outcome.recovery > report.worst_recovery) {
    report.worst_recovery = outcome.recovery;
    report.worst_recovery_seed = scenario.seed;
  }
  if (outcome.violation) report.found.push_back({scenario, *outcome.violation});
}

}  // namespace

CampaignReport runCampaign(const CampaignBus& bus, std::uint32_t first, unsigned scenarios) {
  CampaignReport report;
  report.bus = bus.name;
  std::mutex access;
  std::atomic<unsigned> next{0};
  const auto work = [&] {
    // For each thread by itself (sched(7)): tests beside it are about real time, this one has none.
    static_cast<void>(::setpriority(PRIO_PROCESS, 0, 19));
    for (unsigned i = next++; i < scenarios; i = next++) {
      const Scenario scenario = makeScenario(bus, first + i);
      const Outcome outcome = Player{scenario, bus}.play();
      const std::lock_guard<std::mutex> lock{access};
      add(report, scenario, outcome);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  std::sort(report.found.begin(), report.found.end(),
            [](const Found& a, const Found& b) { return a.scenario.seed < b.scenario.seed; });
  return report;
}

std::vector<CampaignBus> campaignBuses() {
  return {profibusCampaign(), canopenCampaign(), devicenetCampaign(), interbusCampaign()};
}

std::string tableOf(const std::vector<CampaignReport>& reports) {
  std::ostringstream out;
  out << "campaign    scenarios  violations  enabled   stops  answers  worst stop / bound (seed)    worst recovery "
         "(seed)\n";
  out << std::fixed << std::setprecision(3);
  for (const CampaignReport& report : reports) {
    out << std::left << std::setw(10) << report.bus << std::right << std::setw(11) << report.scenarios << std::setw(12)
        << report.found.size() << std::setw(9) << report.enabled << std::setw(8) << report.stops << std::setw(9)
        << report.answers << "  " << report.worst_stop.took << " s / " << report.worst_stop.bound << " s ("
        << report.worst_stop_seed << ")    " << report.worst_recovery << " s (" << report.worst_recovery_seed << ")\n";
  }
  return out.str();
}

std::string textOf(const Found& found) {
  std::ostringstream out;
  out << found.violation.invariant << " at " << found.violation.at << " ms: " << found.violation.what << "\n  \""
      << found.violation.sentence << "\"\n  NORD_CAMPAIGN_REPLAY=\"" << toText(found.scenario) << '"';
  return out.str();
}

}  // namespace nord_driver::test
