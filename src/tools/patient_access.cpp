#include "tools/patient_access.h"

namespace nord_driver::tools {

namespace {

constexpr int kPatientTries = 5;
constexpr Duration kPatientPause = std::chrono::milliseconds{250};

}  // namespace

ParameterAnswer askPatiently(DriveParameters& drive, const std::function<ParameterAnswer()>& access) {
  ParameterAnswer answer = access();
  for (int tries = 1; tries < kPatientTries && answer.passing; ++tries) {
    drive.pass(kPatientPause);
    answer = access();
  }
  if (answer.passing) answer.refused = false;
  return answer;
}

}  // namespace nord_driver::tools
