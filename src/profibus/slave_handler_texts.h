// What a technician reads of a slave: sentences without their subject ("PROFIBUS station 8 ...").
#pragma once

namespace nord_driver::profibus::texts {

constexpr const char* kNoAnswer =
    "does not answer: check its power, its address, the baud rate, the cable and its termination";
constexpr const char* kStarting = "answers, and is being parameterised";
constexpr const char* kMayRun =
    "answers, and may be in data exchange still: it is parameterised when its watchdog has run out";
constexpr const char* kWaiting = "has its parameters, and reports that it is not ready yet";
constexpr const char* kNoValidData = "reports that it has no valid data for the moment (Stat_Diag)";
constexpr const char* kMasterThere = "is a master, not a slave: check the addresses";
constexpr const char* kFellSilent = "fell silent: check its power and the cable";
constexpr const char* kGarbled =
    "answered with telegrams that are no answer: check the cable, and that no other station has its address";
constexpr const char* kRefusesExchange =
    "answers, but refuses data exchange: it takes no outputs, or gives no inputs; its watchdog is left to run out";
constexpr const char* kLeft = "left data exchange by itself: its watchdog ran out, or it was switched off and on";
constexpr const char* kAsksAgain = "asks for its parameters again: it was restarted, or another master took it";
constexpr const char* kLinkOpened = "was lost with the bus device, which is opened anew";
constexpr const char* kGivenWay =
    "is left to another master, which leads this segment: nothing is sent for as long as that one is heard";
constexpr const char* kTaken = "was set up by another master meanwhile: a watchdog runs that is not ours";
constexpr const char* kWrongLength =
    "exchanges data of another length than configured: the PPO type or module list set at the device differs";
constexpr const char* kWrongIdent = "is another device than configured: its ident number differs";
constexpr const char* kLocked = "is locked by another master";
constexpr const char* kLeftRunning =
    "was left in data exchange by its master, and its watchdog runs: wait until that has run out";
constexpr const char* kWatchdogUnasked =
    "shows a running watchdog (WD_On) though it was told none: another master has our address (bus/master_address), or "
    "the module brings its own: ask it through the running driver";
constexpr const char* kPrmFault =
    "refuses its parameters (Prm_Fault): the ident number, the user parameters or the watchdog do not suit it";
constexpr const char* kPrmNotSupported =
    "refuses its parameters (Prm_Fault, Not_Supported): they ask for what it does not know, such as SYNC or FREEZE "
    "(bus/sync, bus/freeze)";
constexpr const char* kCfgFault =
    "refuses its configuration (Cfg_Fault): the PPO type or module list set at the device differs from the configured "
    "one";
constexpr const char* kOtherConfiguration =
    "has another configuration than configured: the PPO type or module list set at the device differs";
constexpr const char* kNoConfiguration = "did not tell its configuration (Get_Cfg)";
constexpr const char* kServiceRefused =
    "refuses a service of its start-up: it is no DP slave, or is busy with another master";
constexpr const char* kNotReady = "has its parameters, but does not become ready for data exchange";
constexpr const char* kForgot = "was given its parameters, and asks for them again (Prm_Req)";

}  // namespace nord_driver::profibus::texts
