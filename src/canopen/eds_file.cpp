#include "canopen/eds_file.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "canopen/eds_lines.h"
#include "core/text.h"

namespace nord_driver::canopen {

namespace {

constexpr unsigned kMostSubIndices = 254;  // CompactSubObj: sub-index 0 and 1 to 254
constexpr std::uint16_t kMaxDummy = 0x0007;
constexpr std::uint16_t kUnsigned8 = 0x0005;

struct RateName {
  const char* key;
  std::uint32_t bits_per_second;
};
constexpr std::array<RateName, 9> kRates{{{"baudrate_10", 10'000},
                                          {"baudrate_20", 20'000},
                                          {"baudrate_50", 50'000},
                                          {"baudrate_100", 100'000},
                                          {"baudrate_125", 125'000},
                                          {"baudrate_250", 250'000},
                                          {"baudrate_500", 500'000},
                                          {"baudrate_800", 800'000},
                                          {"baudrate_1000", 1'000'000}}};

std::string objectName(std::uint16_t index, std::optional<std::uint8_t> sub_index) {
  char name[16];
  std::snprintf(name, sizeof name, sub_index ? "%04Xh:%u" : "%04Xh", unsigned{index}, unsigned{sub_index.value_or(0)});
  return name;
}

/// The number of `count` hexadecimal digits of `name` from `at` on.
std::optional<unsigned> hexAt(const std::string& name, std::size_t at, std::size_t count) {
  if (count == 0 || name.size() < at + count) return std::nullopt;
  const auto number = edsNumber("0x" + name.substr(at, count));
  if (!number || number->plus_node_id) return std::nullopt;
  return static_cast<unsigned>(number->value);
}

struct ObjectSection {
  std::uint16_t index;
  std::optional<std::uint8_t> sub_index;
};

/// "1018" and "1018sub1".
std::optional<ObjectSection> objectSection(const std::string& name) {
  const auto index = hexAt(name, 0, 4);
  if (!index) return std::nullopt;
  if (name.size() == 4) return ObjectSection{static_cast<std::uint16_t>(*index), std::nullopt};
  if (name.compare(4, 3, "sub") != 0 || name.size() > 9) return std::nullopt;
  const auto sub_index = hexAt(name, 7, name.size() - 7);
  if (!sub_index) return std::nullopt;
  return ObjectSection{static_cast<std::uint16_t>(*index), static_cast<std::uint8_t>(*sub_index)};
}

/// The first of the sorted objects that is not before index and sub-index.
std::vector<EdsObject>::const_iterator firstFrom(const std::vector<EdsObject>& objects, std::uint16_t index,
                                                 std::uint8_t sub_index) noexcept {
  return std::lower_bound(objects.begin(), objects.end(), std::make_pair(index, sub_index),
                          [](const EdsObject& object, const std::pair<std::uint16_t, std::uint8_t>& place) {
                            return std::make_pair(object.index, object.sub_index) < place;
                          });
}

class EdsReader {
 public:
  EdsFile read(const std::string& text) {
    sections_ = splitEds(text, file_.problems);
    takeDeviceInfo();
    takeDummies();
    for (const auto& entry : sections_) takeSection(entry.first, entry.second);
    std::sort(file_.objects.begin(), file_.objects.end(), [](const EdsObject& a, const EdsObject& b) {
      return a.index != b.index ? a.index < b.index : a.sub_index < b.sub_index;
    });
    for (const char* list : {"mandatoryobjects", "optionalobjects", "manufacturerobjects"}) checkList(list);
    takeIdentity();
    std::stable_sort(file_.problems.begin(), file_.problems.end(),
                     [](const EdsProblem& a, const EdsProblem& b) { return a.line < b.line; });
    return std::move(file_);
  }

 private:
  const EdsSection* section(const std::string& name) const {
    const auto found = sections_.find(name);
    return found == sections_.end() ? nullptr : &found->second;
  }

  void takeDeviceInfo() {
    const EdsSection* info = section("deviceinfo");
    if (info == nullptr) {
      problem(1, "no section [DeviceInfo]: this may be no EDS file");
    } else {
      if (const EdsValue* name = info->find("vendorname")) file_.vendor = name->text;
      if (const EdsValue* name = info->find("productname")) file_.product = name->text;
      file_.vendor_id = number32(*info, "vendornumber");
      file_.product_code = number32(*info, "productnumber");
      file_.revision_number = number32(*info, "revisionnumber");
      file_.receive_pdos = number32(*info, "nrofrxpdo");
      file_.transmit_pdos = number32(*info, "nroftxpdo");
      for (const RateName& rate : kRates) {
        if (number(*info, rate.key, 1).value_or(0) != 0) file_.bit_rates.push_back(rate.bits_per_second);
      }
    }
    // The section's name has lost an "m" in the standard; both are found.
    for (const char* name : {"devicecomissioning", "devicecommissioning"}) {
      const EdsSection* commissioning = section(name);
      if (commissioning == nullptr) continue;
      if (const auto id = number(*commissioning, "nodeid", 127)) file_.node_id = static_cast<std::uint8_t>(*id);
    }
  }

  void takeDummies() {
    const EdsSection* usage = section("dummyusage");
    if (usage == nullptr) return;
    for (std::uint16_t type = 1; type <= kMaxDummy; ++type) {
      if (number(*usage, "dummy000" + std::to_string(type), 1).value_or(0) != 0) file_.dummies.push_back(type);
    }
  }

  void takeSection(const std::string& name, const EdsSection& values) {
    const auto place = objectSection(name);
    if (!place) return;
    if (place->sub_index) {
      takeObject(place->index, *place->sub_index, true, values);
      return;
    }
    if (const auto count = number(values, "compactsubobj", kMostSubIndices)) {
      if (*count != 0) return takeCompact(place->index, static_cast<unsigned>(*count), values);
    }
    const std::size_t subs = subSections(name);
    const auto told = number(values, "subnumber", 0xFF);
    if (subs == 0 && told.value_or(0) == 0) return takeObject(place->index, 0, false, values);
    if (told && *told != subs) {
      problem(values.line, objectName(place->index, std::nullopt) + ": SubNumber is " + std::to_string(*told) +
                               ", but there are " + std::to_string(subs) + " sections of sub-indices");
    }
  }

  std::size_t subSections(const std::string& index) const {
    std::size_t count = 0;
    const std::string prefix = index + "sub";
    for (auto at = sections_.lower_bound(prefix); at != sections_.end() && at->first.compare(0, 7, prefix) == 0; ++at) {
      if (objectSection(at->first)) ++count;
    }
    return count;
  }

  void takeObject(std::uint16_t index, std::uint8_t sub_index, bool has_subs, const EdsSection& values) {
    EdsObject object;
    object.index = index;
    object.sub_index = sub_index;
    object.line = values.line;
    title_ = objectName(index, has_subs ? std::optional<std::uint8_t>{sub_index} : std::nullopt);
    if (const EdsValue* name = values.find("parametername")) object.name = name->text;
    if (const auto type = number(values, "datatype", 0xFFFF)) object.data_type = static_cast<std::uint16_t>(*type);
    object.pdo_mapping = number(values, "pdomapping", 1).value_or(0) != 0;
    object.access = access(values);
    const EdsValue* value = values.find("parametervalue");
    if (value == nullptr) value = values.find("defaultvalue");
    if (value != nullptr) {
      object.text = value->text;
      object.value = valueOf(object, *value);
    }
    if (const EdsValue* limit = values.find("lowlimit")) object.low_limit = valueOf(object, *limit);
    if (const EdsValue* limit = values.find("highlimit")) object.high_limit = valueOf(object, *limit);
    file_.objects.push_back(std::move(object));
    title_.clear();
  }

  /// An array all of whose elements are alike (CiA 306 4.6.3.2.2): sub-index 0 is the count. A DCF has their values in
  /// a section of its own.
  void takeCompact(std::uint16_t index, unsigned count, const EdsSection& values) {
    EdsObject elements;
    elements.index = index;
    elements.data_type = kUnsigned8;
    elements.access = EdsAccess::kReadOnly;
    elements.value = EdsNumber{count, false};
    elements.text = std::to_string(count);
    elements.line = values.line;
    file_.objects.push_back(elements);
    const EdsSection* own = section(lowerCase(objectName(index, std::nullopt).substr(0, 4)) + "value");
    for (unsigned sub_index = 1; sub_index <= count; ++sub_index) {
      takeObject(index, static_cast<std::uint8_t>(sub_index), true, values);
      const EdsValue* value = own == nullptr ? nullptr : own->find(std::to_string(sub_index));
      if (value == nullptr) continue;
      file_.objects.back().text = value->text;
      file_.objects.back().value = valueOf(file_.objects.back(), *value);
    }
  }

  EdsAccess access(const EdsSection& values) {
    const EdsValue* value = values.find("accesstype");
    if (value == nullptr) return EdsAccess::kUnknown;
    constexpr std::array<std::pair<const char*, EdsAccess>, 6> kWords{{{"ro", EdsAccess::kReadOnly},
                                                                       {"wo", EdsAccess::kWriteOnly},
                                                                       {"rw", EdsAccess::kReadWrite},
                                                                       {"rwr", EdsAccess::kReadWriteInput},
                                                                       {"rww", EdsAccess::kReadWriteOutput},
                                                                       {"const", EdsAccess::kConst}}};
    const std::string word = lowerCase(value->text);
    for (const auto& known : kWords) {
      if (word == known.first) return known.second;
    }
    problem(value->line, title_ + ": AccessType \"" + value->text + "\" is none of ro, wo, rw, rwr, rww, const");
    return EdsAccess::kUnknown;
  }

  /// Nothing, and no complaint, where the data type holds no integer.
  std::optional<EdsNumber> valueOf(const EdsObject& object, const EdsValue& value) {
    constexpr unsigned kNoInteger = 0;
    const unsigned bits = object.data_type ? edsBits(*object.data_type).value_or(kNoInteger) : kNoInteger;
    const auto number = edsNumber(value.text);
    constexpr std::uint16_t kReal32 = 0x0008, kReal64 = 0x0011;
    if (bits == kNoInteger || object.data_type == kReal32 || object.data_type == kReal64) return number;
    if (!number) {
      problem(value.line, objectName(object.index, object.sub_index) + ": \"" + value.text + "\" is no number");
      return std::nullopt;
    }
    if (bits == 64 || number->value >> bits == 0) return number;
    const std::uint64_t sign_and_above = ~std::uint64_t{0} << (bits - 1);
    if ((number->value & sign_and_above) == sign_and_above) {
      return EdsNumber{number->value & ~(~std::uint64_t{0} << bits), number->plus_node_id};
    }
    problem(value.line, objectName(object.index, object.sub_index) + ": \"" + value.text + "\" does not fit " +
                            std::to_string(bits) + " bits");
    return std::nullopt;
  }

  /// "SupportedObjects=2", "1=0x1000", "2=0x1001".
  void checkList(const char* name) {
    const EdsSection* list = section(name);
    if (list == nullptr) return;
    for (const auto& entry : list->values) {
      if (entry.first == "supportedobjects" || entry.second.text.empty()) continue;
      const auto index = edsNumber(entry.second.text);
      if (!index || index->value > 0xFFFF) {
        problem(entry.second.line, "\"" + entry.second.text + "\" is no index of an object");
      } else if (!file_.hasIndex(static_cast<std::uint16_t>(index->value))) {
        problem(entry.second.line,
                objectName(static_cast<std::uint16_t>(index->value), std::nullopt) + " is listed, but not described");
      }
    }
  }

  void takeIdentity() {
    if (const auto type = file_.value(0x1000, 0, 0)) file_.device_type = static_cast<std::uint32_t>(*type);
    if (!file_.device_type) problem(1, "no device type (the value of object 1000h)");
    takeIdentity(1, "VendorNumber", file_.vendor_id);
    takeIdentity(2, "ProductNumber", file_.product_code);
    takeIdentity(3, "RevisionNumber", file_.revision_number);
  }

  /// What [DeviceInfo] says holds; 1018h fills in, where it has a value that is not zero.
  void takeIdentity(std::uint8_t sub_index, const char* key, std::optional<std::uint32_t>& number) {
    const auto object = file_.value(0x1018, sub_index, 0);
    if (!object || *object == 0) return;
    if (!number || *number == 0) {
      number = static_cast<std::uint32_t>(*object);
    } else if (*number != *object) {
      problem(file_.object(0x1018, sub_index)->line,
              objectName(0x1018, sub_index) + " and " + key + " of [DeviceInfo] differ; the latter is taken");
    }
  }

  std::optional<std::uint64_t> number(const EdsSection& values, const std::string& key, std::uint64_t limit) {
    const EdsValue* value = values.find(key);
    if (value == nullptr) return std::nullopt;
    const auto read = edsNumber(value->text);
    if (read && !read->plus_node_id && read->value <= limit) return read->value;
    problem(value->line, (title_.empty() ? "" : title_ + ": ") + key + " = \"" + value->text +
                             "\": expected a number of at most " + std::to_string(limit));
    return std::nullopt;
  }

  std::optional<std::uint32_t> number32(const EdsSection& values, const std::string& key) {
    const auto read = number(values, key, 0xFFFFFFFF);
    if (!read) return std::nullopt;
    return static_cast<std::uint32_t>(*read);
  }

  void problem(std::size_t line, const std::string& text) { file_.problems.push_back({line, text}); }

  EdsFile file_;
  EdsSections sections_;
  std::string title_;  // of the object being read
};

}  // namespace

const EdsObject* EdsFile::object(std::uint16_t index, std::uint8_t sub_index) const noexcept {
  const auto found = firstFrom(objects, index, sub_index);
  const bool there = found != objects.end() && found->index == index && found->sub_index == sub_index;
  return there ? &*found : nullptr;
}

bool EdsFile::hasIndex(std::uint16_t index) const noexcept {
  const auto found = firstFrom(objects, index, 0);
  return found != objects.end() && found->index == index;
}

std::optional<std::uint64_t> EdsFile::value(std::uint16_t index, std::uint8_t sub_index,
                                            std::uint8_t node) const noexcept {
  const EdsObject* found = object(index, sub_index);
  if (found == nullptr || !found->value) return std::nullopt;
  return found->value->at(node);
}

std::optional<unsigned> edsBits(std::uint16_t data_type) noexcept {
  // CiA 301 table 44. 000Ch and 000Dh (times) have 48 bits, but no numbers.
  constexpr std::array<unsigned, 0x1C> kBits{0, 1, 8,  16, 32, 8,  16, 32, 32, 0, 0,  0,  0,  0,
                                             0, 0, 24, 64, 40, 48, 56, 64, 24, 0, 40, 48, 56, 64};
  if (data_type >= kBits.size() || kBits[data_type] == 0) return std::nullopt;
  return kBits[data_type];
}

EdsFile parseEds(const std::string& text) {
  return EdsReader{}.read(text);
}

}  // namespace nord_driver::canopen
