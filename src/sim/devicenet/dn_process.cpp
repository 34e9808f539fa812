#include "sim/devicenet/dn_process.h"

#include "sim/devicenet/dn_config.h"

namespace nord_driver::sim {

namespace {

/// Behind control or status word.
unsigned valuesIn(unsigned bytes) noexcept {
  return bytes < 4 ? 0 : bytes / 2 - 1;
}

}  // namespace

void DnProcess::connect(std::size_t place, DriveUnit& drive) noexcept {
  places_[place].drive = &drive;
  places_[place].third_before_second = dnThirdBeforeSecond(drive.config());
}

bool DnProcess::present(std::size_t place) const noexcept {
  const DriveUnit* drive = places_[place].drive;
  return drive != nullptr && drive->inverterLink() && drive->inverter().powered();
}

// Control word, then setpoints 1 to 3, little endian; a shorter area leaves the rest 0.
DnProcess::Taken DnProcess::take(ByteView outputs, const DnLayout& layout, bool locked) noexcept {
  Taken taken;
  outputs_.clear();
  for (const std::uint8_t byte : outputs) outputs_.push_back(byte);
  std::size_t offset = 0;
  if (layout.output_byte && !outputs.empty()) output_byte_ = outputs[offset++];
  for (std::size_t i = 0; i < kInverters; ++i) {
    const DnArea& area = layout.areas[i];
    if (area.control_length == 0) continue;
    const ByteView bytes = outputs.sub(offset, area.control_length);
    offset += area.control_length;
    Place& place = places_[i];
    if (area.profile == DnProfile::kNord) {
      ByteReader reader{bytes};
      place.data.control = reader.u16le();
      place.data.carried = valuesIn(area.control_length);
      for (unsigned n = 0; n < 3; ++n) place.data.setpoints[place.valueAt(n, place.data.carried)] = reader.u16le();
    } else {
      place.ac.take(bytes, area.profile);
      if (place.drive == nullptr) continue;
      place.data = place.ac.words(*place.drive);
    }
    const Taken one = hand(place, present(i), locked);
    taken.valid = taken.valid || one.valid;
    // "Net control" off is no slip: it says that somebody else drives.
    taken.zero = taken.zero || (one.zero && area.profile == DnProfile::kNord);
  }
  return taken;
}

DnProcess::Taken DnProcess::commit(std::size_t i, bool locked) noexcept {
  Place& place = places_[i];
  if (place.drive == nullptr) return {};
  place.data = place.ac.words(*place.drive);
  Taken taken = hand(place, present(i), locked);
  taken.zero = false;
  return taken;
}

DnProcess::Taken DnProcess::hand(Place& place, bool there, bool locked) noexcept {
  Taken taken;
  taken.valid = (place.data.control & stw::kDataValid) != 0;
  taken.zero = !taken.valid && place.valid_seen && there;
  place.valid_seen = there && (place.valid_seen || taken.valid);  // one that comes back begins anew
  if (!there) return taken;
  DriveUnit& drive = *place.drive;
  // In its time-out the module lets through what an acknowledgement needs, and nothing that would start a motor.
  if (locked && drive.inverter().faultNumber() == 0) return taken;
  drive.inverter().receive(place.data);
  drive.parameters().show(740, 0, place.data.control);
  for (unsigned n = 0; n < 3; ++n) drive.parameters().show(740, 1 + n, place.data.setpoints[n]);
  return taken;
}

// The data of an inverter that is off are zero.
DnProcessBytes DnProcess::inputs(const DnLayout& layout) const noexcept {
  DnProcessBytes bytes;
  ByteWriter<DnProcessBytes::capacity()> writer{bytes};
  if (layout.input_byte) writer.u8(module_inputs_);
  for (std::size_t i = 0; i < kInverters; ++i) {
    const DnArea& area = layout.areas[i];
    const std::size_t end = bytes.size() + area.status_length;
    if (area.status_length > 0 && present(i)) {
      const DriveUnit& drive = *places_[i].drive;
      FixedBytes<8> all;
      ByteWriter<8> words{all};
      if (area.profile == DnProfile::kNord) {
        words.u16le(drive.inverter().statusWord());
        const std::size_t count = valuesIn(area.status_length);
        for (unsigned n = 0; n < 3; ++n) words.u16le(drive.inverter().actualValue(places_[i].valueAt(n, count)));
      } else {
        words.append(places_[i].ac.status(drive, area.profile));
      }
      writer.append(ByteView{all}.sub(0, area.status_length));
    }
    bytes.resize(end);
  }
  return bytes;
}

void DnProcess::beginExchange() noexcept {
  for (Place& place : places_) place.valid_seen = false;
}

void DnProcess::forget() noexcept {
  for (Place& place : places_) {
    place.ac.forget();
    place.data = ProcessData{};
    place.valid_seen = false;
  }
  outputs_.clear();
  output_byte_ = 0;
}

}  // namespace nord_driver::sim
