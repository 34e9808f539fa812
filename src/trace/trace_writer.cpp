#include "trace/trace_writer.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <regex>
#include <set>
#include <system_error>
#include <utility>

#include "trace/pcap.h"

namespace nord_driver::trace {

namespace {

namespace fs = std::filesystem;

/// "20261121T170503.123Z": sorts by time and holds no colon.
std::string fileTime(std::chrono::microseconds since_1970) {
  std::string text;
  for (const char c : utcText(since_1970).substr(0, sizeof "2026-11-21 17:05:03.123" - 1)) {
    if (c == ' ') {
      text += 'T';
    } else if (c != '-' && c != ':') {
      text += c;
    }
  }
  return text + "Z";
}

/// What the names of files begin with; in the order of time.
std::string timedName(std::chrono::microseconds since_1970) {
  return "nord_driver_" + fileTime(since_1970);
}

constexpr const char* kUnfinished = ".part";

/// Two threads may write in another order than they read the clock, which is adjusted a little at any time.
constexpr std::chrono::microseconds kAheadOfTheClock = std::chrono::seconds{10};

/// Empty when all is on the disk; otherwise why not, and no file is left. Whatever ends the program meanwhile, a file of
/// this name is whole: it gets the name when it is.
std::string writeFile(const std::string& path, const std::string& bytes) {
  const std::string unfinished = path + kUnfinished;
  errno = 0;
  std::FILE* file = std::fopen(unfinished.c_str(), "wbx");
  if (file == nullptr) return std::strerror(errno);
  bool done = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  int error = errno;
  if (std::fclose(file) != 0 && done) {
    done = false;
    error = errno;
  }
  if (done && std::rename(unfinished.c_str(), path.c_str()) == 0) return {};
  if (done) error = errno;
  std::remove(unfinished.c_str());
  return std::strerror(error);
}

/// By a trace, or by what is left of one that was ended while it was written.
bool isTaken(const std::string& stem) {
  std::error_code ignored;
  for (const char* ending : {".txt", ".pcap"}) {
    if (fs::exists(stem + ending, ignored) || fs::exists(stem + ending + kUnfinished, ignored)) return true;
  }
  return false;
}

}  // namespace

TraceWriter::TraceWriter(TraceConfig config, std::vector<TracedDrive> drives, const TelegramTrace* telegrams,
                         const ProcessDataHistory& history)
    : config_(std::move(config)), drives_(std::move(drives)), telegrams_(telegrams), history_(history) {}

std::string TraceWriter::whyNotWritable() const {
  std::error_code error;
  if (!fs::is_directory(config_.directory, error)) {
    return "no trace can be written: trace_directory " + config_.directory + " is no directory";
  }
  if (::access(config_.directory.c_str(), W_OK | X_OK) != 0) {
    return "no trace can be written: trace_directory " + config_.directory + ": " + std::strerror(errno);
  }
  return {};
}

TraceResult TraceWriter::write(const TraceCause& cause, const TraceClock& clock) {
  const std::lock_guard<std::mutex> lock(mutex_);
  TracePage page;
  page.reasons = cause.reasons;
  page.time = cause.time;
  page.process_data = history_.upTo(cause.cycle);
  if (telegrams_ != nullptr) page.telegrams = telegrams_->copy();

  TraceResult result;
  result.message = whyNotWritable();
  if (!result.message.empty()) return result;
  const std::string stem = freeStem(cause, clock);
  std::string error;
  if (telegrams_ != nullptr) error = writeFile(stem + ".pcap", pcapBytes(page.telegrams, clock));
  if (error.empty()) {
    error = writeFile(stem + ".txt", traceText(page, drives_, telegrams_, clock));
    if (!error.empty()) std::remove((stem + ".pcap").c_str());
  }
  result.written = error.empty();
  result.message =
      error.empty() ? stem + ".txt" : "no trace can be written: trace_directory " + config_.directory + ": " + error;
  if (result.written) result.warning = removeOldest(fs::path(stem).filename().string(), clock.wallTime(clock.bus));
  return result;
}

TraceResult TraceWriter::writeNow(const TraceClock& clock) {
  const std::uint64_t cycles = history_.cycles();
  return write({"request", {"asked for by ~write_trace"}, clock.bus, cycles == 0 ? 0 : cycles - 1}, clock);
}

// Two within a millisecond: the later one is named a millisecond later.
std::string TraceWriter::freeStem(const TraceCause& cause, const TraceClock& clock) const {
  std::string stem;
  std::chrono::microseconds time = clock.wallTime(cause.time);
  do {
    stem = (fs::path(config_.directory) / (timedName(time) + "_" + cause.tag)).string();
    time += std::chrono::milliseconds{1};
  } while (isTaken(stem));
  return stem;
}

// The link type promises packets from start to end delimiter: bytes that are no telegram stand in the text only.
std::string TraceWriter::pcapBytes(const std::vector<TraceRecord>& telegrams, const TraceClock& clock) const {
  Pcap pcap{telegrams_->linkType()};
  for (const TraceRecord& record : telegrams) {
    if (record.kind != TraceKind::kNoise) pcap.add(clock.wallTime(record.time), record.view());
  }
  return pcap.bytes();
}

// Only what bears our own names is ever removed.
std::string TraceWriter::removeOldest(const std::string& newest, std::chrono::microseconds now) const {
  static const std::regex kOwn(R"((nord_driver_\d{8}T\d{6}\.\d{3}Z_\w+)\.(txt|pcap)(\.part)?)");
  std::set<std::string> stems;
  std::error_code error;
  for (fs::directory_iterator at{config_.directory, error}, end; !error && at != end; at.increment(error)) {
    std::smatch match;
    const std::string name = at->path().filename().string();
    if (std::regex_match(name, match, kOwn) && match[1] != newest) stems.insert(match[1]);
  }
  std::string warning;
  // What bears a time that has yet to come is of before the clock was set back: older than all others.
  auto stem = stems.upper_bound(timedName(now + kAheadOfTheClock));
  for (; stems.size() + 1 > config_.keep; stem = stems.erase(stem)) {
    if (stem == stems.end()) stem = stems.begin();
    for (const char* ending : {".txt", ".pcap", ".txt.part", ".pcap.part"}) {
      const fs::path path = fs::path(config_.directory) / (*stem + ending);
      fs::remove(path, error);
      if (error)
        warning = "old traces cannot be removed: trace_directory " + config_.directory + ": " + error.message();
    }
  }
  return warning;
}

}  // namespace nord_driver::trace
