// A module 0BA8h (SK CU4/TU4-PBR) with its acyclic channel at address 8, in the conversation of the tests.
#pragma once

#include "profibus/nord_wire.h"

namespace nord_driver::profibus {

constexpr const char* kReady0ba8 = "68 0B 0B 68 81 88 08 3E 3C 00 0C 00 01 0B A8 4B 16";

// To and from its access point 51, with either frame count: the answer to readAnswer() and its way.
constexpr const char* kReadRequest = "68 09 09 68 88 81 5C 33 33 5E 00 65 08 96 16";
constexpr const char* kReadRequest7C = "68 09 09 68 88 81 7C 33 33 5E 00 65 08 B6 16";
constexpr const char* kPoll5C = "68 05 05 68 88 81 5C 33 33 CB 16";
constexpr const char* kPoll7C = "68 05 05 68 88 81 7C 33 33 EB 16";
constexpr const char* kReadResponse = "68 11 11 68 81 88 08 33 33 5E 00 65 08 15 E4 00 00 00 00 00 01 3C 16";

/// Slot 1 empty, one inverter in PPO 1 (BU 0220 4.2.2.4): 12 bytes each way.
inline SlaveConfig modularModule(int address) {
  SlaveConfig slave = nordModule(address);
  slave.ident_number = 0x0BA8;
  slave.configuration = {0x00, 0xF5};
  slave.user_parameters = {0x80, 0x00, 0x00};
  slave.dpv1 = true;
  slave.record_timeout = std::chrono::milliseconds{500};
  return slave;
}

class RecordWire : public NordWire {
 public:
  explicit RecordWire(const SlaveConfig& slave = modularModule(8)) : NordWire(quietBus(), slave) {}

  /// The whole start-up; the next exchange carries FC 7D.
  void startsUpModular() {
    isFound();
    cycle(kDiag6D, "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 0B A8 44 16");
    cycle("68 0F 0F 68 88 81 5D 3D 3E 88 0A 01 0B 0B A8 00 80 00 00 B2 16", kShortAcknowledge);
    cycle("68 07 07 68 88 81 7D 3E 3E 00 F5 F7 16", kShortAcknowledge);
    cycle(kDiag5D, kReady0ba8);
    EXPECT_EQ(SlavePhase::kDataExchange, status().phase);
    forgetEvents();
  }

  /// One exchange (FC 7D) and one acyclic telegram in one cycle.
  void cycleWith(const std::string& request, const std::string& answer, const char* file = __builtin_FILE(),
                 int line = __builtin_LINE()) {
    startCycle();
    sends(kExchange7D, file, line);
    receives(kInputs);
    sends(request, file, line);
    receives(answer);
    cycleEnds(file, line);
    EXPECT_TRUE(status().exchanged_this_cycle);
  }
  /// With a diagnosis between, which turns the frame count of the acyclic telegram.
  void cycleWithDiagnosis(bool odd, const std::string& request, const std::string& answer,
                          const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    startCycle();
    sends(odd ? kExchange7D : kExchange5D, file, line);
    receives(kInputsDh);
    sends(odd ? kDiag5D : kDiag7D, file, line);
    receives(kReady0ba8);
    sends(request, file, line);
    receives(answer);
    cycleEnds(file, line);
  }
  void plainCycle(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    cycle(kExchange7D, kInputs, file, line);
  }

  RecordResult result(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    testing::ScopedTrace trace(file, line, "result");
    const auto found = master.pollRecord();
    EXPECT_TRUE(found) << "no result";
    return found.value_or(RecordResult{});
  }
};

/// Reads P508: order label 1, number 1508 (BU 2700 6.5).
inline RecordRequest writeOrder() {
  RecordRequest request;
  request.index = 101;
  request.write = true;
  for (const std::uint8_t byte : fromHex("15 E4 00 00 00 00 00 00")) request.data.push_back(byte);
  return request;
}
inline RecordRequest readAnswer() {
  RecordRequest request;
  request.index = 101;
  request.length = 8;
  return request;
}

}  // namespace nord_driver::profibus
