// Any bytes as the answer to Slave_Diag and to Get_Cfg: every byte is in one block, everything has its words.
#include "fuzz.h"
#include "profibus/configuration_bytes.h"
#include "profibus/diagnosis.h"
#include "profibus/diagnosis_blocks.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nord_driver;
  using namespace nord_driver::profibus;
  const ByteView bytes{data, size};
  if (const auto diagnosis = Diagnosis::from(bytes)) {
    fuzz::require(diagnosis->bytes() == bytes);
    std::size_t seen = 0;
    bool broken = false;
    DiagnosisBlocks blocks{diagnosis->extendedBytes()};
    while (const auto block = blocks.next()) {
      fuzz::require(!block->bytes.empty() && !describe(*block).empty());
      broken = broken || block->isInverterLinkBroken();
      seen += block->bytes.size();
    }
    fuzz::require(seen == diagnosis->extendedBytes().size() && broken == diagnosis->inverterLinkBroken());
  }
  const auto lengths = ioLengths(bytes);
  fuzz::require(!lengths || lengths->outputs <= 128 * size);
  fuzz::require(!compareConfigurations(bytes, bytes.sub(size / 2)).empty());
  return 0;
}
