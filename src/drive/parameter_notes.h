// What the parameter session tells its user beside the outcome: clauses.
#pragma once

namespace nord_driver::drive {

constexpr char kSame[] = "the inverter has this value already: nothing was written";
constexpr char kNotRead[] = "the present value could not be read, so nothing was written";
constexpr char kWriteUnanswered[] = "whether the inverter carried the write out is not known";
constexpr char kWithdrawn[] = "nothing was written, and nothing will be";
constexpr char kDiffers[] = "the inverter accepted the value, but reads back another one";
constexpr char kNotReadBack[] = "the inverter accepted the value, but it could not be read back";
constexpr char kToggled[] =
    "this inverter has no order that spares the EEPROM: P560 was set to 0 for the write and put back to 1 (counted as "
    "two EEPROM writes)";
constexpr char kWasOff[] = "P560 = 0 was found and left so: this inverter saves nothing in its EEPROM, whoever writes";
constexpr char kNotPutBack[] =
    "P560 could not be put back to 1: until it is, this inverter saves nothing in its EEPROM, whoever writes";
constexpr char kNotSet[] = "P560 could not be set to 0, so the value was not written";
constexpr char kSwitchUnread[] = "P560 could not be read, so nothing was written";
constexpr char kNothingSpares[] =
    "this inverter has neither an order that spares the EEPROM nor P560: it can only be written persistently";
constexpr char kModuleSaves[] =
    "it is a parameter of the module, which has no order here that spares its EEPROM, and P560 is the inverter's: it "
    "can only be "
    "written persistently";
constexpr char kSwitchItself[] = "P560 itself can only be written persistently in this inverter";
constexpr char kWouldBeLost[] =
    "P560 = 0: the inverter would not save the value in its EEPROM; write P560 = 1 first, persistently";
constexpr char kNoSwitch[] = "the inverter has no P560: whether it saved the value in its EEPROM is not known";

}  // namespace nord_driver::drive
