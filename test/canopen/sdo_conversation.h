// A conversation of an SDO client with the server of node 32h (the node of BU 0060 p. 96), frame by frame.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "canopen/sdo_abort.h"
#include "canopen/sdo_client.h"

namespace nord_driver::canopen {

class SdoConversation : public testing::Test {
 protected:
  static constexpr Duration kTimeout = std::chrono::milliseconds{100};

  void read(std::uint16_t index, std::uint8_t sub_index, bool block = false) {
    SdoRequest request = sdoRead(7, index, sub_index);
    request.block = block;
    ASSERT_TRUE(client.start(request, now));
  }
  void write(std::uint16_t index, std::uint8_t sub_index, const std::string& text, bool block = false) {
    SdoRequest request = sdoRead(7, index, sub_index);
    request.write = true;
    request.block = block;
    const std::vector<std::uint8_t> bytes{text.begin(), text.end()};
    ASSERT_TRUE(client.start(request, bytes, now));
  }
  /// The data of the next frame on 632h; "" when there is none.
  std::string sent() {
    CanFrame frame;
    if (!client.pollTransmit(frame)) return "";
    EXPECT_EQ(0x632u, frame.id);
    EXPECT_FALSE(frame.extended || frame.remote);
    return toHex(frame.bytes());
  }
  void answer(const std::string& hex) { client.handle(dataFrame(0x5B2, fromHex(hex)), now); }
  void pass(Duration span) {
    now += span;
    client.poll(now);
  }
  /// Sends `request` and answers it.
  void exchange(const char* request, const char* response) {
    EXPECT_EQ(request, sent());
    EXPECT_EQ("", sent()) << "sent without waiting for an answer";
    answer(response);
  }
  SdoAnswer taken() {
    const auto answer = client.takeAnswer();
    EXPECT_TRUE(answer);
    EXPECT_FALSE(client.busy());
    return answer.value_or(SdoAnswer{});
  }
  std::string takenText() {
    const SdoAnswer answer = taken();
    EXPECT_TRUE(answer.ok()) << abortText(answer.abort_code);
    return {answer.data.begin(), answer.data.end()};
  }
  void expectAborted(SdoEnd end, std::uint32_t code) {
    const SdoAnswer answer = taken();
    EXPECT_EQ(end, answer.end);
    EXPECT_EQ(code, answer.abort_code) << abortText(answer.abort_code);
    EXPECT_TRUE(answer.data.empty());
    EXPECT_FALSE(answer.number());
  }

  SdoClient client{defaultSdoChannel(0x32), kTimeout};
  Instant now{std::chrono::hours{1}};
};

}  // namespace nord_driver::canopen
