#include "sim_node/bus_client.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <stdexcept>

#include "sim/profibus/conversation.h"

namespace nord_driver::sim_node {

using sim::Conversation;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

BusClient::BusClient(const std::string& device) : file_(::open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  if (file_ < 0) throw std::runtime_error("cannot open " + device);
}

BusClient::~BusClient() {
  ::close(file_);
}

std::string BusClient::ask(const std::vector<std::uint8_t>& telegram, milliseconds limit) {
  ::tcflush(file_, TCIFLUSH);  // what came too late for the question before is no answer to this one
  if (::write(file_, telegram.data(), telegram.size()) != static_cast<ssize_t>(telegram.size())) return "not written";
  const auto end = steady_clock::now() + limit;
  std::vector<std::uint8_t> answer;
  const auto complete = [&] {
    if (answer.empty()) return false;
    if (answer[0] == 0xE5) return true;
    return answer[0] == 0x10 ? answer.size() >= 6 : answer.size() > 4 && answer.size() >= answer[1] + 6u;
  };
  while (!complete()) {
    const auto rest = std::chrono::duration_cast<milliseconds>(end - steady_clock::now());
    pollfd readable{file_, POLLIN, 0};
    if (rest.count() <= 0 || ::poll(&readable, 1, static_cast<int>(rest.count())) <= 0) break;
    std::uint8_t byte = 0;
    if (::read(file_, &byte, 1) == 1) answer.push_back(byte);
  }
  return toHex(answer);
}

std::string BusClient::askStatus(milliseconds limit) {
  return ask(fromHex("10 08 01 49 52 16"), limit);
}

void BusClient::startUp() {
  first_ = true;
  for (const char* unit : {"3C 3E", "3D 3E 80 00 00 0B 75 31 00", "3E 3E F3 F1", "3C 3E"}) {
    ask(Conversation::variable(0x88, 0x81, frameCount(), fromHex(unit)));
  }
}

std::string BusClient::exchange(const std::string& pkw, const std::string& words) {
  const std::string answer = ask(Conversation::variable(0x08, 0x01, frameCount(), fromHex(pkw + words)));
  // 68 LE LE 68 DA SA FC data FCS 16
  return answer.size() > 27 ? answer.substr(21, answer.size() - 27) : answer;
}

std::string BusClient::pzd(const std::string& words) {
  const std::string answer = exchange("0000 0000 0000 0000", words);
  return answer.size() == 35 ? answer.substr(24) : answer;
}

std::string BusClient::pzdUntil(const std::string& words, const std::string& expected) {
  const auto end = steady_clock::now() + std::chrono::seconds(10);
  std::string answer;
  do {
    answer = pzd(words);
  } while (answer != expected && steady_clock::now() < end);
  return answer;
}

unsigned BusClient::frameCount() {
  const unsigned function = first_ ? 0x6D : fcb_ ? 0x7D : 0x5D;
  fcb_ = !first_ && !fcb_;
  first_ = false;
  return function;
}

}  // namespace nord_driver::sim_node
