#include "documents/catalogue_tables.h"

#include <optional>
#include <vector>

#include "catalogue/parameter_text.h"

namespace nord_driver::documents {

namespace {

using catalogue::Catalogues;
using catalogue::Device;
using catalogue::FaultCodes;
using catalogue::FaultEntry;
using catalogue::Module;
using catalogue::ParameterEntry;
using profile::Series;

constexpr char kWritten[] =
    "This file is written by a program (write_tables in test/documents): correct the files, not this one, or lay one "
    "of "
    "your own over them ([parameter_files.md](parameter_files.md)).\n";

struct Family {
  Device device;  ///< the first one of the file
  const char* title;
};

const std::vector<Family> kFamilies{
    {Series::kSk1x0e, "SK 1x0E and SK 2xxE"},
    {Series::kSk5xxe, "SK 500E to SK 535E"},
    {Series::kSk54xe, "SK 54xE"},
    {Series::kSk300e, "SK 300E"},
    {Series::kSk700e, "SK 700E and SK 750E"},
    {Module::kProfibus, "Bus modules SK CU4-PBR and SK TU4-PBR (PROFIBUS)"},
    {Module::kDevicenet, "Bus modules SK CU4-DEV and SK TU4-DEV (DeviceNet)"},
    {Module::kCanopen, "Bus modules SK CU4-CAO and SK TU4-CAO (CANopen)"},
    {Module::kInterbus, "DRIVECOM objects of the InterBus technology units"},
};

struct Codes {
  FaultCodes codes;
  std::optional<Device> device;  ///< the first one of the file
  const char* title;
};

const std::vector<Codes> kCodes{
    {FaultCodes::kP700, std::nullopt, "Faults of the inverters (P700, P701)"},
    {FaultCodes::kP700, Series::kSk1x0e, "The same in the words of SK 1x0E and SK 2xxE"},
    {FaultCodes::kP700, Series::kSk5xxe, "The same in the words of SK 5xxE and SK 54xE"},
    {FaultCodes::kP700, Series::kSk300e, "The same in the words of SK 300E, SK 700E and SK 750E"},
    {FaultCodes::kP170, Module::kProfibus, "Faults of the PROFIBUS modules (P170)"},
    {FaultCodes::kP170, Module::kDevicenet, "Faults of the DeviceNet modules (P170)"},
    {FaultCodes::kEmcy, std::nullopt, "CANopen EMCY"},
    {FaultCodes::kDrivecom, std::nullopt, "DRIVECOM object 603Fh"},
    {FaultCodes::kPkw, std::nullopt, "Error numbers of the parameter channel (PKW)"},
    {FaultCodes::kDpv1, std::nullopt, "DP-V1, Error_Code_1"},
    {FaultCodes::kDpv1Abort, std::nullopt, "DP-V1, reasons of an MS2 abort"},
    {FaultCodes::kSdoAbort, std::nullopt, "SDO abort codes"},
    {FaultCodes::kDevicenetGeneral, std::nullopt, "DeviceNet, general error codes"},
    {FaultCodes::kDevicenetAllocate, std::nullopt, "DeviceNet, codes of a refused allocation"},
};

// What would end a cell or a row, or be taken for a tag.
std::string cell(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '|' || letter == '<' || letter == '>' || letter == '*' || letter == '_') result += '\\';
    result += letter;
  }
  return result;
}

void append(std::string& text, const std::string& words) {
  if (!words.empty()) text += (text.empty() ? "" : ". ") + words;
}

std::string rowNumbers(std::int64_t first, std::int64_t last) {
  return std::to_string(first) + (last == first ? "" : "..." + std::to_string(last));
}

std::string namesOf(const catalogue::ValueNames& names) {
  std::string text;
  for (const auto& [first, value] : names) {
    text += (text.empty() ? "" : "; ") + rowNumbers(first, value.last) + " " + value.name;
  }
  return text;
}

std::string bitsOf(const ParameterEntry& entry) {
  std::string text;
  for (const auto& [first, field] : entry.bits) {
    text += (text.empty() ? "bit " : "; bit ") + rowNumbers(first, field.last) + " " + field.name;
    if (!field.values.empty()) text += " (" + namesOf(field.values) + ")";
  }
  return text;
}

std::string rawText(const ParameterEntry& entry, double value, unsigned index) {
  return catalogue::valueText(entry, static_cast<std::int32_t>(entry.rawOf(value)), index);
}

std::string elementsOf(const ParameterEntry& entry) {
  std::string text;
  for (const auto& [index, element] : entry.element_infos) {
    text += (text.empty() ? "[-" : "; [-") + std::string(index < 10 ? "0" : "") + std::to_string(index) + "] " +
            element.name;
    std::string own;
    if (element.unit) own += ", " + *element.unit;
    if (element.size) own += ", " + std::to_string(*element.size) + " bits";
    if (element.range) own += ", " + catalogue::rangeText(entry, index);
    if (element.default_value) own += ", factory setting " + rawText(entry, *element.default_value, index);
    if (!element.values.empty()) own += ", " + namesOf(element.values);
    if (!own.empty()) text += " (" + own.substr(2) + ")";
  }
  return text;
}

// The range of a parameter nobody states one of would be that of its size.
std::string rangeOf(const ParameterEntry& entry) {
  if (entry.range) return catalogue::rangeText(entry);
  const std::string unit = entry.unit.value_or("");
  if (!entry.resolution) return unit;
  return "steps of " + catalogue::stepText(entry);
}

std::string sourcesOf(const std::vector<std::string>& sources) {
  std::string text;
  for (const std::string& source : sources) text += (text.empty() ? "" : "; ") + source;
  return text;
}

std::string parameterRow(const ParameterEntry& entry) {
  std::string number = catalogue::label(entry);
  number = number.substr(0, number.find_first_of("[:"));
  std::string kind = catalogue::kindText(entry);
  if (entry.supervisor.value_or(false)) kind += kind.empty() ? "supervisor" : ", supervisor";
  std::string content;
  append(content, elementsOf(entry));
  append(content, namesOf(entry.values));
  for (const catalogue::OtherValues& other : entry.other_values)
    append(content, other.source + ": " + namesOf(other.values));
  append(content, bitsOf(entry));
  append(content, entry.note.value_or(""));
  if (entry.erratum) append(content, "Erratum: " + *entry.erratum);
  std::string row = "|";
  const std::string factory = entry.default_value ? rawText(entry, *entry.default_value, 1) : "";
  for (const std::string& text :
       {number, entry.title(), rangeOf(entry), factory, kind, content, sourcesOf(entry.source)}) {
    row += " " + cell(text) + " |";
  }
  return row + "\n";
}

std::string faultRow(FaultCodes codes, const FaultEntry& fault) {
  std::string remarks;
  if (!fault.stands_for.empty()) {
    const bool p700 = codes == FaultCodes::kEmcy || codes == FaultCodes::kDrivecom;
    std::string behind;
    for (const std::uint32_t raw : fault.stands_for) {
      behind += (behind.empty() ? "" : ", ") + catalogue::faultLabel(p700 ? FaultCodes::kP700 : FaultCodes::kPkw, raw);
    }
    append(remarks, (p700 ? "stands for " : "as PKW error ") + behind);
  }
  append(remarks, fault.note.value_or(""));
  if (fault.erratum) append(remarks, "Erratum: " + *fault.erratum);
  std::string row = "|";
  for (const std::string& text :
       {catalogue::faultLabel(codes, fault.number), fault.name.value_or(""), fault.cause.value_or(""),
        fault.remedy.value_or(""), remarks, sourcesOf(fault.source)}) {
    row += " " + cell(text) + " |";
  }
  return row + "\n";
}

}  // namespace

std::string parameterTables(const Catalogues& catalogues) {
  std::string text = "# Parameters of the inverters and bus modules\n\nWhat config/parameters says. ";
  text += kWritten;
  text +=
      "An empty cell says: no manual tells. How they are read and written: [nord_param.md](nord_param.md), "
      "[services.md](services.md).\n";
  for (const Family& family : kFamilies) {
    text += std::string("\n## ") + family.title + "\n\n";
    text += "| Number | Name | Range | Factory setting | Access | Elements, values, bits, remarks | Source |\n";
    text += "|---|---|---|---|---|---|---|\n";
    for (const ParameterEntry* entry : catalogues.parameters.all(family.device)) text += parameterRow(*entry);
  }
  return text;
}

std::string faultTables(const Catalogues& catalogues) {
  std::string text = "# Faults and error numbers\n\nWhat config/faults says. ";
  text += kWritten;
  text += "The words of a series go before those for all.\n";
  for (const Codes& table : kCodes) {
    text += std::string("\n## ") + table.title + "\n\n";
    text += "| Number | Name | Likely cause | Remedy | Remarks | Source |\n|---|---|---|---|---|---|\n";
    for (const FaultEntry* fault : catalogues.faults.all(table.codes, table.device))
      text += faultRow(table.codes, *fault);
  }
  return text;
}

}  // namespace nord_driver::documents
