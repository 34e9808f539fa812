#include "transport/profibus/profibus_telegram_text.h"

#include <algorithm>

#include "profibus/class2_pdu.h"
#include "profibus/diagnosis.h"
#include "profibus/diagnosis_blocks.h"
#include "profibus/function_code.h"

namespace nord_driver {

namespace {

using profibus::Diagnosis;
using profibus::ResponseCode;
using profibus::Telegram;
using profibus::TelegramKind;

// Service access points of a slave (EN 50170-8).
constexpr std::uint8_t kRecordSap = 51, kGlobalControlSap = 58, kGetCfgSap = 59, kSlaveDiagSap = 60, kSetPrmSap = 61,
                       kChkCfgSap = 62;

const char* serviceName(std::uint8_t sap) {
  switch (sap) {
    case kRecordSap:
      return "record";
    case kGetCfgSap:
      return "Get_Cfg";
    case kGlobalControlSap:
      return "Global_Control";
    case kSlaveDiagSap:
      return "Slave_Diag";
    case kSetPrmSap:
      return "Set_Prm";
    case kChkCfgSap:
      return "Chk_Cfg";
    case profibus::kResourceManagerSap:
      return "MS2 resource manager";
    default:
      return sap <= profibus::kLastClass2Sap ? "MS2" : "access point";
  }
}

std::string way(const Telegram& telegram) {
  return std::to_string(telegram.da) + " <- " + std::to_string(telegram.sa);
}

std::string withHex(const std::string& text, ByteView data) {
  return data.empty() ? text : text + " " + toHex(data);
}

std::string diagnosisText(ByteView data) {
  const auto diagnosis = Diagnosis::from(data);
  if (!diagnosis) return withHex("", data);
  std::string text = " ident " + toHexWord(diagnosis->ident());
  text += diagnosis->owner() == profibus::kNoOwner ? ", no owner" : ", owner " + std::to_string(diagnosis->owner());
  const auto add = [&text](bool set, const char* name) {
    if (set) text += std::string(", ") + name;
  };
  add(diagnosis->notReady(), "not ready");
  add(diagnosis->configurationFault(), "Cfg_Fault");
  add(diagnosis->notSupported(), "Not_Supported");
  add(diagnosis->parameterFault(), "Prm_Fault");
  add(diagnosis->parameterRequest(), "Prm_Req");
  add(diagnosis->staticDiagnosis(), "Stat_Diag");
  add(diagnosis->watchdogOn(), "watchdog on");
  if (!diagnosis->extendedBytes().empty()) text += ", extended " + toHex(diagnosis->extendedBytes());
  profibus::DiagnosisBlocks blocks{diagnosis->extendedBytes()};
  while (const auto block = blocks.next()) text += std::string(", ") + describe(*block).c_str();
  return text;
}

const char* responseText(ResponseCode code) {
  switch (code) {
    case ResponseCode::kOk:
      return "OK";
    case ResponseCode::kUserError:
      return "user error";
    case ResponseCode::kNoResource:
      return "no resource";
    case ResponseCode::kNotActivated:
      return "not activated";
    case ResponseCode::kDataLow:
      return "data";
    case ResponseCode::kNoData:
      return "no data";
    case ResponseCode::kDataHigh:
      return "diagnosis waits";
    case ResponseCode::kDataLowNoResource:
    case ResponseCode::kDataHighNoResource:
      return "sent data not taken";
  }
  return "unknown response";
}

profile::PpoWords wordsOf(ByteView data) {
  ByteReader reader{data};
  profile::PpoWords words;
  while (reader.remaining() >= 2) words.push_back(reader.u16be());
  return words;
}

}  // namespace

ProfibusTelegramText::ProfibusTelegramText(const ProfibusDpConfig& config) {
  for (std::size_t i = 0; i < config.stations.size(); ++i) {
    const ProfibusStation& station = config.stations[i];
    Layout& layout = layouts_[config.slaves[i].address.value()];
    layout.length = config.slaves[i].output_length;
    layout.io_byte = station.io_byte;
    for (const std::size_t drive : station.drives) {
      const ProfibusDrive& from = config.drives[drive];
      const bool several = station.module == ProfibusModule::kSkCu4;
      layout.parts.push_back({from.offset, from.ppo, several ? " FI" + std::to_string(from.inverter) : ""});
    }
  }
}

std::string ProfibusTelegramText::operator()(const TraceRecord& record) const {
  if (record.kind == TraceKind::kNoise) return "no telegram";
  const profibus::ParseResult result = profibus::parse(record.view());
  if (result.kind != profibus::Parse::kOk) return "no telegram";
  const Telegram& telegram = result.telegram;
  if (telegram.kind == TelegramKind::kSc) return "acknowledge";
  if (telegram.kind == TelegramKind::kSd4) return "token " + way(telegram);
  return profibus::isRequest(telegram.fc) ? request(telegram) : answer(telegram);
}

std::string ProfibusTelegramText::request(const Telegram& telegram) const {
  if (telegram.fc == profibus::kRequestFdlStatus) return "FDL status " + way(telegram);
  if (telegram.dsap) {
    return withHex(std::string(serviceName(*telegram.dsap)) + " " + way(telegram), telegram.data);
  }
  return "DX " + way(telegram) + processData(telegram.da, telegram.data, true);
}

// An answer carries the access points of its request the other way round.
std::string ProfibusTelegramText::answer(const Telegram& telegram) const {
  const ResponseCode code = profibus::responseCode(telegram.fc);
  if (telegram.ssap == kSlaveDiagSap && !telegram.data.empty()) {
    return "diag " + way(telegram) + diagnosisText(telegram.data);
  }
  if (telegram.ssap) {
    return withHex(std::string(serviceName(*telegram.ssap)) + " " + way(telegram) + " " + responseText(code),
                   telegram.data);
  }
  if (telegram.data.empty()) return "answer " + way(telegram) + " " + responseText(code);
  const std::string text = "DX " + way(telegram) + processData(telegram.sa, telegram.data, false);
  return code == ResponseCode::kDataLow ? text : text + ", " + responseText(code);
}

std::string ProfibusTelegramText::processData(std::uint8_t station, ByteView data, bool to_drive) const {
  const auto layout = layouts_.find(station);
  if (layout == layouts_.end() || data.size() != layout->second.length) return withHex("", data);
  std::string text;
  if (layout->second.io_byte) text = " I/O " + toHex(data.sub(0, 1));
  for (const Part& part : layout->second.parts) {
    text += part.name + partText(part, data.sub(part.offset, part.layout.bytes()), to_drive);
  }
  return text;
}

std::string ProfibusTelegramText::partText(const Part& part, ByteView data, bool to_drive) {
  profile::PkwWords pkw{};
  profile::ProcessInput values;  // the way back is laid out as the way there
  if (!profile::unpack(part.layout, wordsOf(data), pkw, values)) return withHex("", data);
  std::string text;
  if (std::any_of(pkw.begin(), pkw.end(), [](Word word) { return word != 0; })) {
    text += " PKW";
    for (const Word word : pkw) text += " " + toHexWord(word);
  }
  text += (to_drive ? " STW " : " ZSW ") + toHexWord(values.status_word);
  for (std::size_t i = 0; i < part.layout.process_values; ++i) {
    text += (to_drive ? " SW" : " IW") + std::to_string(i + 1) + " " + toHexWord(toWord(values.actual_values[i]));
  }
  return text;
}

}  // namespace nord_driver
