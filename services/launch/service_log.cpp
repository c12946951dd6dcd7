#include "services/launch/service_log.h"

#include <mutex>
#include <string_view>

#include <spdlog/sinks/base_sink.h>
#include <unistd.h>

namespace puck {
namespace {

std::string_view colour_of(spdlog::level::level_enum level) {
  switch (level) {
    case spdlog::level::critical:
    case spdlog::level::err:
      return "\033[31m\033[1m";
    case spdlog::level::warn:
      return "\033[33m\033[1m";
    case spdlog::level::info:
      return "\033[32m";
    default:
      return "\033[36m";
  }
}

class LineSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  LineSink(LineWriter& writer, bool is_coloured) : writer_(writer), is_coloured_(is_coloured) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t text;
    formatter_->format(message, text);
    std::string line(text.data(), text.size());
    if (is_coloured_ && message.color_range_end > message.color_range_start) {
      line.insert(message.color_range_end, "\033[m");
      line.insert(message.color_range_start, colour_of(message.level));
    }
    writer_.put(std::move(line));
  }
  void flush_() override {}

  LineWriter& writer_;
  bool is_coloured_;
};

}  // namespace

ServiceLog::ServiceLog(const std::string& name, int descriptor)
    : writer_(descriptor),
      logger_(name, std::make_shared<LineSink>(writer_, isatty(descriptor) == 1)) {
  logger_.set_pattern("%H:%M:%S.%e %n %^%l%$: %v");
}

}  // namespace puck
