#include <gtest/gtest.h>

#include <random>
#include <string>

#include "canopen/eds_file.h"
#include "canopen/eds_samples.h"

namespace nord_driver::canopen {
namespace {

constexpr std::uint8_t kNode = 0x32;

/// One object 2000h of this data type with this default.
EdsFile withDefault(const std::string& type, const std::string& value) {
  return parseEds("[DeviceInfo]\n[1000]\nDataType=7\nDefaultValue=0\n[2000]\nDataType=" + type +
                  "\nDefaultValue=" + value + "\n");
}

std::string onlyProblem(const EdsFile& file) {
  EXPECT_EQ(1u, file.problems.size());
  for (const EdsProblem& problem : file.problems) {
    if (file.problems.size() > 1) ADD_FAILURE() << problem.line << ": " << problem.text;
  }
  return file.problems.empty() ? "" : std::to_string(file.problems[0].line) + ": " + file.problems[0].text;
}

TEST(EdsFile, TellsWhatTheDeviceIs) {
  const EdsFile file = parseEds(kEds);
  EXPECT_TRUE(file.problems.empty()) << file.problems[0].line << file.problems[0].text;
  EXPECT_EQ("Tester", file.vendor);
  EXPECT_EQ("CAO", file.product);
  EXPECT_EQ(0x00010192u, file.device_type);
  EXPECT_EQ(0x189u, file.vendor_id);
  EXPECT_EQ(20u, file.product_code);
  EXPECT_EQ(0x00010002u, file.revision_number);
  EXPECT_EQ((std::vector<std::uint32_t>{125'000, 250'000, 1'000'000}), file.bit_rates);
  EXPECT_EQ(2u, file.receive_pdos);
  EXPECT_EQ(1u, file.transmit_pdos);
  EXPECT_EQ((std::vector<std::uint16_t>{5, 6}), file.dummies);
  EXPECT_FALSE(file.node_id);
}

TEST(EdsFile, DescribesTheObjects) {
  const EdsFile file = parseEds(kEds);
  const EdsObject* p102 = file.object(0x2066, 1);
  ASSERT_NE(nullptr, p102);
  EXPECT_EQ("P102 set 1", p102->name);
  EXPECT_EQ(3, p102->data_type);
  EXPECT_EQ(EdsAccess::kReadWrite, p102->access);
  EXPECT_TRUE(p102->writable() && p102->readable());
  EXPECT_FALSE(p102->pdo_mapping);
  EXPECT_EQ("200", p102->text);
  EXPECT_EQ(200u, p102->value->value);
  EXPECT_EQ(0xFFFFu, p102->low_limit->value) << "-1 in 16 bits";
  EXPECT_EQ(32000u, p102->high_limit->value);
  EXPECT_EQ(nullptr, file.object(0x2066, 2));
  EXPECT_TRUE(file.hasIndex(0x2066));
  EXPECT_FALSE(file.hasIndex(0x2067));
  const EdsObject* control_word = file.object(0x3000, 0);
  ASSERT_NE(nullptr, control_word);
  EXPECT_EQ(EdsAccess::kReadWriteOutput, control_word->access);
  EXPECT_TRUE(control_word->pdo_mapping);
  EXPECT_FALSE(control_word->value);
  EXPECT_FALSE(file.object(0x3001, 0)->writable());
  EXPECT_EQ(nullptr, file.object(0x1800, 4)) << "a gap between the sub-indices";
}

// "$NODEID+0x180", either way round, in any case, with spaces; octal 0377.
TEST(EdsFile, AddsTheNodeId) {
  const EdsFile file = parseEds(kEds);
  EXPECT_EQ(0x40000232u, file.value(0x1400, 1, kNode));
  EXPECT_EQ(0x40000332u, file.value(0x1401, 1, kNode));
  EXPECT_EQ(0x400001B2u, file.value(0x1800, 1, kNode));
  EXPECT_EQ(255u, file.value(0x1401, 2, kNode));
  EXPECT_EQ(std::nullopt, file.value(0x3000, 0, kNode));
  EXPECT_EQ(std::nullopt, file.value(0x4000, 0, kNode));
  EXPECT_EQ(7u, withDefault("5", "$NODEID").value(0x2000, 0, 7));
}

TEST(EdsFile, NumbersInEveryDress) {
  const std::vector<std::pair<const char*, std::uint64_t>> numbers{{"16", 16},
                                                                   {"0x10", 16},
                                                                   {"0X1f", 31},
                                                                   {"020", 16},
                                                                   {"0", 0},
                                                                   {"08", 8},
                                                                   {" 5 ; five", 5},
                                                                   {"+7", 7},
                                                                   {"-1", 0xFFFFFFFF},
                                                                   {"-0x80000000", 0x80000000},
                                                                   {"4294967295", 0xFFFFFFFF}};
  for (const auto& number : numbers) {
    const EdsFile file = withDefault("7", number.first);
    EXPECT_TRUE(file.problems.empty()) << number.first;
    EXPECT_EQ(number.second, file.value(0x2000, 0, 0)) << number.first;
  }
  EXPECT_EQ(0xFFFFFFFFFFFFFFFFu, withDefault("0x1B", "18446744073709551615").value(0x2000, 0, 0));
  EXPECT_EQ(0x8000000000000000u, withDefault("0x15", "-9223372036854775808").value(0x2000, 0, 0));
}

// The value is left out, the object stays, and the sentence names line and object.
TEST(EdsFile, ValuesThatAreNoNumbersOfTheType) {
  for (const char* text :
       {"ERROR", "0x", "-", "0xG", "1 2", "18446744073709551616", "$NODEID*2", "2-$NODEID", "-$NODEID", "0x8$NODEID"}) {
    const EdsFile file = withDefault("7", text);
    EXPECT_EQ("7: 2000h:0: \"" + std::string{text} + "\" is no number", onlyProblem(file));
    ASSERT_NE(nullptr, file.object(0x2000, 0));
    EXPECT_FALSE(file.object(0x2000, 0)->value);
    EXPECT_EQ(text, file.object(0x2000, 0)->text);
  }
  EXPECT_FALSE(withDefault("0x15", "-9223372036854775809").value(0x2000, 0, 0));
  EXPECT_EQ("7: 2000h:0: \"256\" does not fit 8 bits", onlyProblem(withDefault("5", "256")));
  EXPECT_EQ("7: 2000h:0: \"-129\" does not fit 8 bits", onlyProblem(withDefault("2", "-129")));
  EXPECT_EQ(0x80u, withDefault("2", "-128").value(0x2000, 0, 0));
}

// Texts, times, domains, floating point and types of the maker's own are not complained about.
TEST(EdsFile, OtherDataTypesAreLeftAsText) {
  for (const char* type : {"9", "0xA", "0xF", "0x8", "0x11", "0x40", "0xFFFF", ""}) {
    const EdsFile file = withDefault(type, "any 1.5");
    EXPECT_TRUE(file.problems.empty()) << type;
    EXPECT_EQ("any 1.5", file.object(0x2000, 0)->text);
    EXPECT_FALSE(file.object(0x2000, 0)->value);
  }
  EXPECT_EQ("6: 2000h: datatype = \"0x10000\": expected a number of at most 65535",
            onlyProblem(withDefault("0x10000", "1")));
}

// Keys without a value are as good as missing ones.
TEST(EdsFile, EmptyValues) {
  const EdsFile file = parseEds(
      "[DeviceInfo]\nVendorNumber=\nProductName=\nBaudRate_250=\nNrOfRXPDO=\n[1000]\nDataType=7\nAccessType=\n"
      "DefaultValue=1\nLowLimit=\nPDOMapping=\n[MandatoryObjects]\n1=\n");
  EXPECT_TRUE(file.problems.empty()) << file.problems[0].text;
  EXPECT_FALSE(file.vendor_id || file.receive_pdos);
  EXPECT_TRUE(file.bit_rates.empty());
  EXPECT_EQ(EdsAccess::kUnknown, file.object(0x1000, 0)->access);
  EXPECT_EQ(1u, file.device_type);
}

// CRLF, a byte order mark, comments, upper and lower case, white space.
TEST(EdsFile, AnyDressOfLines) {
  std::string text = "\xEF\xBB\xBF; a comment\r\n";
  for (const char c : std::string{kEds}) text += c == '\n' ? std::string{"\r\n"} : std::string{c};
  const EdsFile file = parseEds(text);
  EXPECT_TRUE(file.problems.empty()) << file.problems[0].text;
  EXPECT_EQ(0x10192u, file.device_type);
  const EdsFile shouting = parseEds(
      "[DEVICEINFO]\n  vendornumber = 1\n[ 1A00SUB1 ]\ndatatype=0X7\nDEFAULTVALUE=0X30010010\n"
      "[1000]\nDataType=7\nDefaultValue=0");
  EXPECT_TRUE(shouting.problems.empty()) << shouting.problems[0].text;
  EXPECT_EQ(1u, shouting.vendor_id);
  EXPECT_EQ(0x30010010u, shouting.value(0x1A00, 1, 0));
}

constexpr const char* kShort = "[DeviceInfo]\n[1000]\nDataType=7\nDefaultValue=1\n";

TEST(EdsFile, NamesWhatIsWrongWithLines) {
  const std::string base = kShort;
  EXPECT_EQ("5: \"nonsense\" is no section, no key with a value and no comment",
            onlyProblem(parseEds(base + "nonsense\n")));
  EXPECT_EQ("1: \"a=b\" stands before the first section", onlyProblem(parseEds("a=b\n" + base)));
  EXPECT_EQ("5: \"[2000\" has no closing bracket", onlyProblem(parseEds(base + "[2000\nDataType=5\n")));
  EXPECT_NE(nullptr, parseEds(base + "[2000\nDataType=5\n").object(0x2000, 0));
  EXPECT_EQ("5: DefaultValue stands twice in [1000]; the first one (line 4) holds",
            onlyProblem(parseEds(base + "DefaultValue=2\n")));
  EXPECT_EQ(1u, parseEds(base + "DefaultValue=2\n").device_type);
  EXPECT_EQ("5: section [1000] was there before (line 2); what it adds is taken",
            onlyProblem(parseEds(base + "[1000]\nAccessType=ro\n")));
  EXPECT_EQ(EdsAccess::kReadOnly, parseEds(base + "[1000]\nAccessType=ro\n").object(0x1000, 0)->access);
}

TEST(EdsFile, NamesWhatIsMissing) {
  EXPECT_EQ(2u, parseEds("").problems.size());
  EXPECT_EQ("1: no section [DeviceInfo]: this may be no EDS file",
            onlyProblem(parseEds("[1000]\nDataType=7\nDefaultValue=1\n")));
  EXPECT_EQ("1: no device type (the value of object 1000h)", onlyProblem(parseEds("[DeviceInfo]\n")));
  const std::string base = kShort;
  EXPECT_EQ("7: 1018h is listed, but not described",
            onlyProblem(parseEds(base + "[OptionalObjects]\nSupportedObjects=2\n1=0x1018\n2=0x1000\n")));
  EXPECT_EQ("6: \"0x12345\" is no index of an object", onlyProblem(parseEds(base + "[OptionalObjects]\n1=0x12345\n")));
}

TEST(EdsFile, SubNumberIsOnlyAHint) {
  const std::string base = kShort;
  EXPECT_EQ("5: 1018h: SubNumber is 4, but there are 1 sections of sub-indices",
            onlyProblem(parseEds(base + "[1018]\nSubNumber=4\n[1018sub1]\nDataType=7\nDefaultValue=9\n")));
  const EdsFile huge = parseEds(base + "[1018]\nSubNumber=0xFFFFFFFF\n[1018sub1]\nDataType=7\nDefaultValue=9\n");
  EXPECT_EQ("6: subnumber = \"0xFFFFFFFF\": expected a number of at most 255", onlyProblem(huge));
  EXPECT_EQ(9u, huge.vendor_id) << "1018h fills in what [DeviceInfo] does not tell";
  const EdsFile none = parseEds(base + "[2001]\nSubNumber=4\nDataType=5\n");
  EXPECT_EQ("5: 2001h: SubNumber is 4, but there are 0 sections of sub-indices", onlyProblem(none));
  EXPECT_FALSE(none.hasIndex(0x2001));
  EXPECT_NE(nullptr, parseEds(base + "[2000]\nSubNumber=0\nDataType=5\n").object(0x2000, 0));
}

// An array of equal elements, CiA 306 4.6.3.2.2; a DCF gives single values in a section of its own.
TEST(EdsFile, CompactArrays) {
  const std::string base = kShort;
  const EdsFile file = parseEds(base +
                                "[2700]\nCompactSubObj=3\nDataType=6\nAccessType=rw\nDefaultValue=7\n"
                                "[2700Value]\nNrOfEntries=1\n2=0x20\n");
  EXPECT_TRUE(file.problems.empty());
  EXPECT_EQ(3u, file.value(0x2700, 0, 0));
  EXPECT_FALSE(file.object(0x2700, 0)->writable());
  EXPECT_EQ(5u, file.object(0x2700, 0)->line) << "of its section";
  EXPECT_EQ(5u, file.object(0x2700, 3)->line);
  EXPECT_EQ(7u, file.value(0x2700, 1, 0));
  EXPECT_EQ(0x20u, file.value(0x2700, 2, 0));
  EXPECT_EQ(7u, file.value(0x2700, 3, 0));
  EXPECT_TRUE(file.object(0x2700, 3)->writable());
  EXPECT_EQ(nullptr, file.object(0x2700, 4));
  EXPECT_EQ("6: compactsubobj = \"4000000000\": expected a number of at most 254",
            onlyProblem(parseEds(base + "[2700]\nCompactSubObj=4000000000\nDataType=6\n")));
}

// A DCF: the device's own value beats the default.
TEST(EdsFile, ConfiguredValuesAndNodeIdOfADcf) {
  const EdsFile file = parseEds(std::string{kShort} + "ParameterValue=2\n[DeviceComissioning]\nNodeID=0x32\n");
  EXPECT_EQ(2u, file.device_type);
  EXPECT_EQ(0x32, file.node_id);
  EXPECT_EQ("6: nodeid = \"128\": expected a number of at most 127",
            onlyProblem(parseEds(std::string{kShort} + "[DeviceCommissioning]\nNodeID=128\n")));
}

TEST(EdsFile, NamesAContradictionInTheIdentity) {
  const std::string text =
      "[DeviceInfo]\nVendorNumber=5\n[1000]\nDataType=7\nDefaultValue=1\n[1018sub1]\nDataType=7\nDefaultValue=6\n";
  EXPECT_EQ("6: 1018h:1 and VendorNumber of [DeviceInfo] differ; the latter is taken", onlyProblem(parseEds(text)));
  EXPECT_EQ(5u, parseEds(text).vendor_id);
}

// The node id stands in values of objects only.
TEST(EdsFile, NoNodeIdInTheIdentity) {
  EXPECT_EQ("2: vendornumber = \"$NODEID\": expected a number of at most 4294967295",
            onlyProblem(parseEds("[DeviceInfo]\nVendorNumber=$NODEID\n[1000]\nDataType=7\nDefaultValue=1\n")));
}

TEST(EdsFile, UnknownAccessIsNamed) {
  EXPECT_EQ("5: 1000h: AccessType \"rx\" is none of ro, wo, rw, rwr, rww, const",
            onlyProblem(parseEds(std::string{kShort} + "AccessType=rx\n")));
}

// Whatever is cut, changed or doubled: it is read to the end.
TEST(EdsFile, SurvivesAnyText) {
  const std::string whole = kEds;
  for (std::size_t n = 0; n < whole.size(); n += 31) {
    const EdsFile file = parseEds(whole.substr(0, n));
    ASSERT_LE(file.objects.size(), 40u);
  }
  std::mt19937 random{5};
  for (int i = 0; i < 100; ++i) {
    std::string text = whole;
    for (int change = 0; change < 20; ++change) text[random() % text.size()] = static_cast<char>(random());
    const EdsFile file = parseEds(text);
    for (std::size_t p = 1; p < file.problems.size(); ++p) ASSERT_LE(file.problems[p - 1].line, file.problems[p].line);
  }
}

}  // namespace
}  // namespace nord_driver::canopen
