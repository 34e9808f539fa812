// The electronic type plate of a PROFIBUS device: identification and maintenance records (I&M), read as records of
// DP-V1 on whichever channel (MS1 or MS2).
//
// BU 0220 8.3.4.8: the modules SK CU4-PBR and SK TU4-PBR support I&M "to a certain extent", NORD's manufacturer number
// is 393. The manual prints no layout; that of the PROFIBUS profile guideline, part 1, is taken from ABB's FPBA-01 user
// manual ("I&M records", pp. 192 to 194).
#pragma once

#include <cstdint>
#include <optional>

#include "nord_driver/core/bytes.h"
#include "nord_driver/core/fixed_text.h"
#include "profibus/record.h"

namespace nord_driver::profibus {

constexpr std::uint16_t kNordManufacturer = 393;
/// I&M0 is the type plate; 1 to 4 are texts a user may write: tag and location, date, descriptor, signature.
constexpr std::uint8_t kLastIdentification = 4;

/// Data behind the ten bytes each device fills as it likes.
struct TypePlate {
  std::uint16_t manufacturer = 0;
  FixedText<20> order_number;
  FixedText<16> serial_number;
  std::uint16_t hardware = 0;
  char software_kind = ' ';  ///< V released, R revision, P prototype, U under test, T trial
  std::uint8_t software[3] = {};
  std::uint16_t revision = 0;      ///< counts changes of the data
  std::uint16_t profile = 0;       ///< 3A00h..3AFFh PROFIdrive
  std::uint16_t profile_type = 0;  ///< 0: none
  std::uint8_t version[2] = {};    ///< of I&M
  std::uint16_t supported = 0;     ///< bit n: I&Mn
};

/// "NORD (manufacturer 393), order number 275271015, serial number ..., hardware 2, software V1.3.0".
Sentence describe(const TypePlate& plate) noexcept;

/// Reads one record of I&M: the call is written to index 255, and its answer read from there. Sans-IO:
/// `pollRecord()` gives the next record to hand to the channel, `handleRecord()` takes its result, until `done()`.
class IdentificationReader {
 public:
  /// `number`: 0..kLastIdentification. `slot`: of the module; 0 the device itself.
  explicit IdentificationReader(std::uint8_t number, std::uint8_t slot = 0) noexcept : number_(number), slot_(slot) {}

  std::optional<RecordRequest> pollRecord() noexcept;
  void handleRecord(const RecordResult& result) noexcept;
  bool done() const noexcept { return step_ == Step::kDone; }

  /// The 64 bytes of the record; empty when it could not be read: see `trouble()`.
  ByteView data() const noexcept { return data_; }
  /// Of I&M0.
  std::optional<TypePlate> typePlate() const noexcept;
  /// Of I&M1 to I&M4: the text behind the device's own ten bytes, without padding.
  FixedText<54> text() const noexcept;
  /// Why not, a clause: "it has no I&M0 record: DP-V1 error B0, invalid index". Empty for a failure of the channel,
  /// which has words of its own.
  const Sentence& trouble() const noexcept { return trouble_; }
  /// Of the record that failed.
  RecordOutcome outcome() const noexcept { return outcome_; }

 private:
  enum class Step : std::uint8_t { kCall, kCalled, kFetch, kFetched, kDone };

  static constexpr std::size_t kLength = 64;

  std::uint8_t number_;
  std::uint8_t slot_;
  Step step_ = Step::kCall;
  RecordOutcome outcome_ = RecordOutcome::kDone;
  FixedBytes<kLength> data_;
  Sentence trouble_;
};

}  // namespace nord_driver::profibus
