#include "node/tracing.h"

#include <boost/function.hpp>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace nord_driver::node {

namespace {

constexpr Duration kPollPeriod = std::chrono::milliseconds{50};

trace::TraceClock clockNow() {
  return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
}

}  // namespace

Tracing::Tracing(ros::NodeHandle& private_node, const trace::TraceConfig& config,
                 const std::vector<trace::TracedDrive>& drives, const TelegramTrace* telegrams)
    : feed_(drives.size()) {
  const trace::TraceConfig by_hand = trace::byHand(config, std::getenv("ROS_HOME"), std::getenv("HOME"));
  writer_ = std::make_unique<trace::TraceWriter>(by_hand, drives, telegrams, feed_.history());
  if (config.withFaults()) {
    tracer_ = std::make_unique<trace::FaultTracer>(feed_, *writer_);
    told_ = writer_->whyNotWritable();
    if (!told_.empty()) ROS_WARN("nord_driver: %s", told_.c_str());
    thread_ = std::thread([this] { run(); });
  } else {
    by_hand_ = by_hand.directory;
  }
  boost::function<bool(std_srvs::Trigger::Request&, std_srvs::Trigger::Response&)> callback =
      [this](std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
        answer(response);
        return true;
      };
  server_ = private_node.advertiseService("write_trace", callback);
}

Tracing::~Tracing() {
  server_.shutdown();
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void Tracing::run() {
  while (!stop_) {
    if (const auto result = tracer_->poll(clockNow())) log(*result);
    std::this_thread::sleep_for(kPollPeriod);
  }
  if (const auto result = tracer_->finish(clockNow())) log(*result);
}

void Tracing::answer(std_srvs::Trigger::Response& response) {
  if (!tracer_) {
    if (by_hand_.empty()) {
      response.message =
          "there is nowhere to write to: neither trace_directory nor ROS_HOME nor HOME is set; give trace_directory an "
          "absolute path and start the node again";
      return;
    }
    std::error_code told_by_the_writer;
    std::filesystem::create_directories(by_hand_, told_by_the_writer);
  }
  const trace::TraceResult result = writer_->writeNow(clockNow());
  response.success = result.written;
  response.message = result.message;
  if (!result.warning.empty()) response.message += " (" + result.warning + ")";
}

void Tracing::log(const trace::TraceResult& result) {
  if (result.written) ROS_WARN("nord_driver: a trace is written: %s", result.message.c_str());
  const std::string& trouble = result.written ? result.warning : result.message;
  if (trouble != told_ && !trouble.empty()) ROS_ERROR("nord_driver: %s", trouble.c_str());
  told_ = trouble;
}

}  // namespace nord_driver::node
