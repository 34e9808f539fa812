// Telegrams as captured on real buses or written by hand in other projects, and bytes that are none.
#pragma once

#include <vector>

namespace nord_driver::profibus {

/// Captured between masters and slaves (a BBB board, a Festo CPV, two more), then hand-written ones, then those derived
/// from the layouts for a NORD module 7531h or 0BA8h (master 1, slave 8).
inline const std::vector<const char*>& validTelegrams() {
  static const std::vector<const char*> kTelegrams{
      // Captured: ident 0CDA, slave 2, master 99.
      "10 02 63 49 AE 16",
      "10 63 02 00 65 16",
      "68 05 05 68 82 E3 6D 3C 3E 4C 16",
      "68 0B 0B 68 E3 82 08 3E 3C 02 05 00 FF 0C DA D3 16",
      "68 0F 0F 68 82 E3 5D 3D 3E B8 05 01 00 0C DA 01 40 00 00 22 16",
      "E5",
      // Captured: Festo CPV 0A35, slave 8, master 2.
      "10 08 02 49 53 16",
      "10 02 08 00 0A 16",
      "68 05 05 68 88 82 6D 3C 3E F1 16",
      "68 0B 0B 68 82 88 08 3E 3C 02 05 00 FF 0A 35 D1 16",
      "68 13 13 68 88 82 5D 3D 3E B8 1E 01 00 0A 35 01 00 00 00 82 00 00 00 7B 16",
      "68 06 06 68 88 82 7D 3E 3E 21 24 16",
      "68 05 05 68 88 82 5D 3C 3E E1 16",
      "68 0B 0B 68 82 88 08 3E 3C 00 0C 00 02 0A 35 D9 16",
      "10 02 08 03 0D 16",
      // Captured: slave 9, master 2; slave 16, master 1.
      "10 09 02 49 54 16",
      "10 02 09 00 0B 16",
      "10 10 01 49 5A 16",
      // Captured: Global_Control Operate.
      "68 07 07 68 FF 81 46 3A 3E 00 00 3E 16",
      // Hand-written elsewhere.
      "10 22 02 49 6D 16",
      "10 02 22 00 24 16",
      "68 05 05 68 94 82 4D 3C 3E DD 16",
      "68 0D 0D 68 94 82 4D 3D 3E 80 01 01 00 06 D1 00 44 7B 16",
      "68 05 05 68 94 82 4D 3B 3E DC 16",
      "68 07 07 68 94 82 6D 3E 3E 01 02 02 16",
      "68 0B 0B 68 82 94 08 3E 3C 02 05 80 FF 06 D1 F5 16",
      "A2 02 14 55 00 00 00 00 00 00 00 00 6B 16",
      "10 02 14 6D 83 16",
      // Derived: token, Clear, Set_Prm, Chk_Cfg, data exchange, DP-V1.
      "DC 01 01",
      "10 08 01 49 52 16",
      "68 07 07 68 FF 81 46 3A 3E 02 00 40 16",
      "68 0C 0C 68 88 81 5D 3D 3E 88 0A 01 0B 75 31 00 25 16",
      "68 0F 0F 68 88 81 5D 3D 3E 88 0A 01 0B 0B A8 00 80 00 00 B2 16",
      "68 07 07 68 88 81 7D 3E 3E F3 F1 E6 16",
      "68 0F 0F 68 08 01 5D 00 00 00 00 00 00 00 00 04 7E 00 00 E8 16",
      "68 0F 0F 68 01 08 08 00 00 00 00 00 00 00 00 0B 31 00 00 4D 16",
      "68 0F 0F 68 01 08 0A 00 00 00 00 00 00 00 00 0B 31 00 00 4F 16",
      "68 07 07 68 08 01 7D 04 7E 00 00 08 16",
      "A2 08 01 7D 04 7E 00 00 00 00 00 00 08 16",
      "68 11 11 68 88 81 5C 33 33 5F 00 65 08 15 E4 00 00 00 00 00 00 90 16",
      "68 05 05 68 88 81 7C 33 33 EB 16",
      "68 09 09 68 81 88 08 33 33 5F 00 65 08 43 16",
      "68 09 09 68 88 81 5C 33 33 5E 00 65 08 96 16",
      "68 11 11 68 81 88 08 33 33 5E 00 65 08 15 E4 00 00 00 00 00 01 3C 16",
      "68 09 09 68 81 88 08 33 33 DE 80 B5 00 8A 16",
      "68 19 19 68 88 81 5C 31 32 57 00 00 00 00 64 01 00 00 00 00 00 00 02 00 02 00 00 00 00 88 16",
      "68 06 06 68 88 81 7C 30 32 48 2F 16",
  };
  return kTelegrams;
}

/// Complete, and wrong.
inline const std::vector<const char*>& invalidTelegrams() {
  static const std::vector<const char*> kTelegrams{
      "68 04 04 68 02 14 08 00 00 00 00 00 00 00 1E 16",  // LE 4, ten octets follow
      "68 03 03 68 94 82 6D 3B 3E FC 16",                 // LE 3
      "68 03 03 68 08 01 49 52 16",                       // LE 3, right for an SD1
      "68 05 06 68 88 82 6D 3C 3E F1 16",                 // LE is not LEr
      "68 05 05 10 88 82 6D 3C 3E F1 16",                 // second start delimiter
      "68 05 05 68 88 82 6D 3C 3E F2 16",                 // FCS
      "68 05 05 68 88 82 6D 3C 3E F1 17",                 // end delimiter
      "68 FA FA 68 88 82 6D 3C 3E F1 16",                 // LE 250
      "68 00 00 68 88 82 6D 3C 3E F1 16",                 // LE 0
      "10 02 63 49 AF 16",                                // FCS
      "10 02 63 49 AE 15",                                // end delimiter
      "10 82 01 49 CC 16",                                // DA announces an access point SD1 cannot hold
      "10 02 81 49 CC 16",                                // SA does
      "68 04 04 68 82 81 6D 3C AC 16",                    // both do, and one octet is there
      "10 02 7F 49 CA 16",                                // the broadcast address as a source
      "A2 02 14 55 00 00 00 00 00 00 00 00 6C 16",        // FCS
      "A2 02 14 55 00 00 00 00 00 6B 16 00 00 00",        // SD3 of eleven octets
      "DC 7F 01",                                         // token to everybody
      "DC 01 81",                                         // token from an address with extension
      "68 00 08 68 00 00 00 00 00 00 00 00 00 00",        // a Siemens LOGO! panel: 16-bit length
      "E7 A7 DA",                                         // noise as captured
      "00",
      "FF FF FF",
  };
  return kTelegrams;
}

}  // namespace nord_driver::profibus
