#include "devicenet/explicit_message.h"

#include "devicenet/error_codes.h"

namespace nord_driver::devicenet {

ExplicitRequest getAttribute(std::uint32_t id, std::uint16_t class_id, std::uint16_t instance,
                             std::uint8_t attribute) noexcept {
  ExplicitRequest request;
  request.id = id;
  request.class_id = class_id;
  request.instance = instance;
  request.attribute = attribute;
  return request;
}

ExplicitRequest setAttribute(std::uint32_t id, std::uint16_t class_id, std::uint16_t instance, std::uint8_t attribute,
                             ByteView data) noexcept {
  ExplicitRequest request = getAttribute(id, class_id, instance, attribute);
  request.service = service::kSetAttributeSingle;
  for (const std::uint8_t byte : data) request.data.push_back(byte);
  return request;
}

bool encode(const ExplicitRequest& request, BodyFormat format, ExplicitBody& body) noexcept {
  const bool wide_class = format == BodyFormat::k16Over16 || format == BodyFormat::k16Over8;
  const bool wide_instance = format == BodyFormat::k16Over16 || format == BodyFormat::k8Over16;
  if ((!wide_class && request.class_id > 0xFF) || (!wide_instance && request.instance > 0xFF)) return false;
  body.clear();
  ByteWriter<ExplicitBody::capacity()> writer{body};
  writer.u8(request.service);
  const auto number = [&writer](bool wide, std::uint16_t value) {
    wide ? writer.u16le(value) : writer.u8(static_cast<std::uint8_t>(value));
  };
  number(wide_class, request.class_id);
  number(wide_instance, request.instance);
  if (request.attribute) writer.u8(*request.attribute);
  writer.append(ByteView{request.data});
  return writer.ok();
}

std::optional<std::uint32_t> ExplicitAnswer::number() const noexcept {
  if (!ok() || data.empty() || data.size() > 4) return std::nullopt;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < data.size(); ++i) value |= std::uint32_t{data[i]} << 8u * i;
  return value;
}

Sentence explicitText(const ExplicitAnswer& answer, std::uint8_t asked_service) noexcept {
  switch (answer.end) {
    case ExplicitEnd::kDone:
      return "done";
    case ExplicitEnd::kRefused:
      return errorText(asked_service, answer.general, answer.additional);
    case ExplicitEnd::kTimedOut:
      return "gave no answer, asked twice";
    case ExplicitEnd::kTooLong:
      return "the message is longer than one side can take";
    case ExplicitEnd::kNotConnected:
      return "there is no explicit connection with the device";
  }
  return "unknown";
}

}  // namespace nord_driver::devicenet
