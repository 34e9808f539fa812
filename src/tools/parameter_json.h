// Parameters as JSON: one shape in every command of nord_param.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "catalogue/drive_catalogue.h"
#include "tools/comparison.h"
#include "tools/drive_parameters.h"
#include "tools/json_text.h"
#include "tools/parameter_dump.h"

namespace nord_driver::tools {

/// The keys that name a parameter: parameter ("P102 set 1"), number, and index, set and name where there are any.
void writeAddress(JsonText& json, const catalogue::ParameterAddress& address, const catalogue::DriveCatalogue& known);

/// raw, and where the parameter is known value, unit and text ("2.50 s").
void writeValue(JsonText& json, const catalogue::ParameterAddress& address, std::int32_t raw,
                const catalogue::DriveCatalogue& known);

/// The answer to a read or write that was successful.
std::string answerJson(const catalogue::ParameterAddress& address, const ParameterAnswer& answer,
                       const DriveParameters& drive);

/// `missing`: what else to name, by its key.
std::string dumpJson(const Dump& dump, const DriveParameters& drive, const std::string& missing_key,
                     const std::vector<catalogue::ParameterAddress>& missing);

std::string differencesJson(const Differences& differences, const catalogue::DriveCatalogue& known,
                            const std::string& first, const std::string& second);

}  // namespace nord_driver::tools
