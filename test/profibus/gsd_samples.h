// GSD texts written for these tests from what the manuals say of the two kinds of NORD modules. NORD's own files are
// not part of this project.
#pragma once

namespace nord_driver::profibus {

/// SK TUx-PBR: ident number 7531h, PPO 1 to 4 (BU 0020 7.2, 10.1), up to 1.5 Mbit/s.
constexpr const char* kGsd7531 = R"(; for tests
#Profibus_DP
GSD_Revision = 1
Vendor_Name = "Tester"      ; a comment; with two semicolons
Model_Name = 'PBR ; 1.5M'
Ident_Number = 0x7531
9.6_supp = 1
19.2_supp = 1
500_supp = 1
1.5M_supp = 1
3M_supp = 0
MaxTsdr_9.6 = 60
MaxTsdr_500 = 100
MaxTsdr_1.5M = 150
Auto_Baud_supp = 1
Freeze_Mode_supp = 1
Sync_Mode_supp = 1
Min_Slave_Intervall = 6
Modular_Station = 0
Max_Diag_Data_Len = 8
Module = "PPO 1" 0xF3, 0xF1
EndModule
Module = "PPO 2" 0xF3, \
                 0xF5        ; continued
EndModule
Module = "PPO 3" 0xF1
EndModule
Module = "PPO 4" 0xF5
EndModule
)";

/// SK CU4/TU4-PBR: ident number 0BA8h, modular, DP-V1 (BU 0220 4.2, 8.2, 8.3.4.5).
constexpr const char* kGsd0ba8 = R"(#Profibus_DP
GSD_Revision=3
Vendor_Name="Tester"
Model_Name="CU4"
Ident_Number=0x0BA8
12M_supp=1
MaxTsdr_12M=800
Modular_Station=1
Max_Module=5
Max_Input_Len=65
Max_Output_Len=65
Max_Data_Len=130
Max_Diag_Data_Len=16
Max_User_Prm_Data_Len=11
DPV1_Slave=1
C1_Read_Write_supp=1
C1_Max_Data_Len=8
C1_Response_Timeout=100
User_Prm_Data_Len=3
User_Prm_Data=0,0,0
Ext_User_Prm_Data_Const(0)=0x80
PrmText=1
Text(0)="Ident_Number=0x1234"
Ident_Number=0x1234
EndPrmText
ExtUserPrmData=1 "nothing"
Bit(0) 0 0-1
EndExtUserPrmData
Module="Bus I/O" 0x30
1
EndModule
Module="Empty" 0x00
2
EndModule
Module="PPO 1" 0xF5
3
Ext_Module_Prm_Data_Len=2
Ext_User_Prm_Data_Const(0)=0x11,0x22
EndModule
Module="PPO 2" 0xF7
4
EndModule
)";

}  // namespace nord_driver::profibus
