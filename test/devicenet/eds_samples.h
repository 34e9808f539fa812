// An EDS text written for these tests from BU 0280 4.2.2 and from the form that files of other makers have. NORD's own file
// is not part of this project; vendor and product code are made up.
#pragma once

namespace nord_driver::devicenet {

constexpr const char* kEds = R"($ A module, for tests
[File]
        DescText = "tester; with a [bracket], a comma and a \"quotation\"";
        Revision = 1.0;
[Device]
        VendCode = 389;          $ made up
        VendName = "Tester";
        ProdType = 2;
        ProdTypeStr = "AC Drive";
        ProdCode = 0x0007;
        MajRev = 1; MinRev = 4;
        ProdName = "SK " "CU4-DEV";
[IO_Info]
        Default = 0x0001;
        PollInfo = 0x0003, 2, 2;
        StrobeInfo = 0x0003, 2, 2;
        COSInfo = 0x0004, 2, 2;
        Input1 = 4, 0, 0x000F, "AC drive", 6, "20 04 24 46 30 03", "";
        Input2 =
                5,                      $ bytes
                0,
                0x0007,
                "NORDAC: module, status word, actual value",
                6, "20 04 24 6E 30 03", "";
        Input3 = 33, 0, 0x0001, "four inverters", 6, "20 04 24 70 30 03", "";
        Input4 = 33, 0, 0x0001, "variable", 6, "20 04 24 82 30 03", "";
        Output1 = 4, 0, 0x000F, "AC drive", 6, "20 04 24 14 30 03", "";
        Output2 = 5, 0, 0x0005, "NORDAC", 6, "20 04 24 64 30 03", "";
        Output4 = 33, 0, 0x0001, "variable", 6, "20 04 24 78 30 03", "";
[ParamClass]
        MaxInst = 0;
)";

}  // namespace nord_driver::devicenet
