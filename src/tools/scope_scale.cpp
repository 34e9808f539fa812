#include "tools/scope_scale.h"

#include "tools/first_words.h"

namespace nord_driver::tools {

namespace {

constexpr std::uint16_t kMaxFrequency = 105;

std::optional<double> maxFrequency(DriveParameters& drive, std::optional<double> typed) {
  catalogue::ParameterAddress address;
  address.number = kMaxFrequency;
  const ParameterAnswer answer = drive.read(address);
  return answer.success ? std::optional<double>{answer.value} : typed;
}

}  // namespace

void readScale(DriveParameters& drive, std::optional<double> typed, bool positions, ScopeRecord& record) {
  const DriveIdentity identity = drive.identity();
  record.commands_known = identity.sends_words;
  record.words_known = identity.tells_words;
  record.max_frequency = maxFrequency(drive, typed);
  if (positions) readFirstWords(drive, record);
}

}  // namespace nord_driver::tools
