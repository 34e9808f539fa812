// One drive as the rules see it: what the configuration asks, what was read, and what is known of its parameters.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "catalogue/drive_catalogue.h"
#include "commissioning/asked_drive.h"
#include "commissioning/facts.h"
#include "commissioning/finding.h"

namespace nord_driver::commissioning {

class DriveUnderCheck {
 public:
  /// `known`: of this drive, lives as long as this. `set_in_force`: 1..4.
  DriveUnderCheck(AskedDrive asked, const catalogue::DriveCatalogue& known, CommissioningFacts facts,
                  std::uint8_t set_in_force)
      : asked_(std::move(asked)), known_(&known), facts_(std::move(facts)), set_(set_in_force) {}

  const AskedDrive& asked() const noexcept { return asked_; }
  const CommissioningFacts& facts() const noexcept { return facts_; }
  std::uint8_t setInForce() const noexcept { return set_; }
  /// SK 1x0E and 2xxE, whose bus modules sit on the system bus.
  bool isDecentral() const noexcept;
  /// SK 300E, 700E and 750E.
  bool isOlderSeries() const noexcept;

  /// As the series has the parameter: without set or element where it has none. `set` 0: the set in force.
  ParameterKey key(std::uint16_t number, std::uint8_t set = 0, std::uint8_t index = 1) const;
  /// Of setpoint or actual value `place` (0..2): P546 [-01].. or P546, P547, P548 as the series has them; `first` 546 or
  /// 543.
  ParameterKey functionKey(std::uint16_t first, std::uint8_t place, std::uint8_t set = 0) const;

  /// The raw value as the drive means it, its sign spread; nothing where it is not known.
  std::optional<std::int32_t> raw(const ParameterKey& key) const;
  /// In the parameter's unit.
  std::optional<double> value(const ParameterKey& key) const;
  /// "4 PROFIBUS", "50.0 Hz".
  std::string valueText(const ParameterKey& key, std::int32_t raw) const;
  /// "P546[-02] set 1 Bus setpoint 2".
  std::string nameOf(const ParameterKey& key) const;
  /// Of the parameter's entry in the catalogue: the first manual it names.
  std::string sourceOf(const ParameterKey& key) const;

  /// A finding on this value, without remedy. `source`: what says why; the place that describes the parameter is added.
  Finding finding(const ParameterKey& key, Severity severity, const std::string& why,
                  const std::string& source = {}) const;
  /// Of a value in the parameter's unit, the nearest there is.
  Remedy remedy(const ParameterKey& key, double value) const;

 private:
  AskedDrive asked_;
  const catalogue::DriveCatalogue* known_;
  CommissioningFacts facts_;
  std::uint8_t set_;
};

}  // namespace nord_driver::commissioning
