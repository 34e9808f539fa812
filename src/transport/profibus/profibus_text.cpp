#include "transport/profibus/profibus_text.h"

#include <cstdio>

#include "transport/addresses_asked.h"

namespace nord_driver {

namespace {

using profibus::DpEventKind;

const char* moduleName(std::uint16_t ident) noexcept {
  if (ident == profile::kIdentTechnologyUnit) return " (SK TU1/2/3-PBR)";
  if (ident == profile::kIdentCu4Tu4) return " (SK CU4/TU4-PBR)";
  return "";
}

bool isInformation(DpEventKind kind) noexcept {
  return kind == DpEventKind::kSlaveFound || kind == DpEventKind::kDataExchangeEntered;
}

}  // namespace

std::string addressText(const ProfibusDpConfig& config, DriveIndex drive) {
  const ProfibusDrive& of = config.drives[drive];
  std::string text = "PROFIBUS station " + std::to_string(config.slaves[of.slave].address.value());
  if (config.stations[of.slave].module == ProfibusModule::kSkCu4) text += ", inverter " + std::to_string(of.inverter);
  return text;
}

ProfibusText::ProfibusText(const ProfibusDpConfig& config) : config_(config) {
  for (std::size_t i = 0; i < config.stations.size(); ++i) {
    std::string drives;
    for (const std::size_t drive : config.stations[i].drives) {
      drives += (drives.empty() ? "" : ", ") + config.drives[drive].name;
    }
    names_.push_back("PROFIBUS station " + std::to_string(config.slaves[i].address.value()) + " (" + drives + ")");
  }
}

BusEvent ProfibusText::event(const profibus::DpEvent& event, const profibus::DpMaster& master) const noexcept {
  BusEvent told;
  told.warning = !isInformation(event.kind);
  if (event.slave >= names_.size()) {
    if (event.kind == DpEventKind::kForeignMaster) {
      told.text.format("PROFIBUS address %u: %s", event.master, event.text);
    } else {
      told.text.format("PROFIBUS: %s", event.text);
    }
    return told;
  }
  const char* const name = names_[event.slave].c_str();
  switch (event.kind) {
    case DpEventKind::kDataExchangeEntered:
      told.text.format("%s exchanges data", name);
      break;
    case DpEventKind::kConfigurationDiffers:
    case DpEventKind::kConfigurationRead:
      told.text.format("%s: %s", name, master.configurationText(event.slave).c_str());
      break;
    case DpEventKind::kLockedByMaster:
      told.text.format("%s %s: address %u", name, event.text, event.master);
      break;
    case DpEventKind::kWrongIdent:
    case DpEventKind::kConfigurationFault:
      told.text.format("%s %s", name, note(event.slave, master).c_str());
      break;
    default:
      told.text.format("%s %s", name, event.text);
      break;
  }
  return told;
}

Sentence ProfibusText::note(std::size_t station, const profibus::DpMaster& master) const noexcept {
  const profibus::SlaveStatus& status = master.status(station);
  const std::uint16_t configured = config_.slaves[station].ident_number;
  Sentence text;
  text = status.note;
  if (status.phase == profibus::SlavePhase::kDataExchange || status.phase == profibus::SlavePhase::kSilent) return text;
  if (status.ident && *status.ident != configured) {
    text.format("is another module than configured: it reports the ident number %04Xh%s, expected %04Xh%s",
                *status.ident, moduleName(*status.ident), configured, moduleName(configured));
  } else if (status.diagnosis.configurationFault() && !status.configuration.empty()) {
    text.format("%s; %s", "refuses its configuration (Cfg_Fault)", master.configurationText(station).c_str());
  } else if (const profibus::Diagnosis& told = status.diagnosis;
             !told.empty() && told.owner() != profibus::kNoOwner && told.owner() != config_.bus.master.value()) {
    text.format("%s: its address is %u", status.note, told.owner());
  }
  return text;
}

Sentence ProfibusText::named(std::size_t station, const char* what) const noexcept {
  Sentence text;
  text.format("%s %s", names_[station].c_str(), what);
  return text;
}

Sentence ProfibusText::silence(const Sentence& live_list) const noexcept {
  const auto asked =
      addressesAsked(config_.slaves.size(), [this](auto i) { return config_.slaves[i].address.value(); });
  Sentence text;
  text.format(
      "%s is open, but no station answers (asked: %s): power, address, baud rate, wires A and B the right way round, "
      "termination?%s%s",
      config_.device.c_str(), asked.c_str(),
      live_list.empty() ? " nord_param scan finds who is there" : "; scan: ", live_list.c_str());
  return text;
}

Sentence ProfibusText::liveList(const profibus::BusScan& scan) noexcept {
  Sentence text;
  if (const auto master = scan.refusedBy()) {
    const bool asked = scan.counters().telegrams_sent > 0;
    text.format("%s: the master %u is on this segment", asked ? "it was broken off" : "nobody was asked", *master);
    return text;
  }
  char list[200] = {};
  std::size_t length = 0;
  for (unsigned address = 0; address < profibus::BusScan::kAddresses && length < sizeof list; ++address) {
    const profibus::ScannedStation& station = scan.station(static_cast<std::uint8_t>(address));
    if (station.kind == profibus::ScannedStation::Kind::kSilent ||
        station.kind == profibus::ScannedStation::Kind::kSelf) {
      continue;
    }
    const char* what = "";
    if (station.kind == profibus::ScannedStation::Kind::kMaster) what = " (a master)";
    if (station.kind == profibus::ScannedStation::Kind::kGarbled) what = " (garbled)";
    if (address == profibus::StationAddress::kUnnamed) what = " (not addressed yet: set its address to 3 to 125)";
    const int written =
        std::snprintf(list + length, sizeof list - length, "%s%u%s", length == 0 ? "" : ", ", address, what);
    if (written > 0) length += static_cast<std::size_t>(written);
  }
  if (length == 0) return scan.lineBusy() ? "the line never fell silent" : "no station answered";
  text.format("stations that answered: %s", list);
  return text;
}

}  // namespace nord_driver
