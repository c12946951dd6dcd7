#include "services/launch/service_log.h"

#include <utility>

#include <spdlog/async.h>

namespace puck {

ServiceLog::ServiceLog(const std::string& name, spdlog::sink_ptr sink, bool is_real_time) {
  constexpr std::size_t kLines = 256;
  if (!is_real_time) {
    logger_ = std::make_shared<spdlog::logger>(name, std::move(sink));
    return;
  }
  writers_ = std::make_shared<spdlog::details::thread_pool>(kLines, 1);
  logger_ = std::make_shared<spdlog::async_logger>(name, std::move(sink), writers_,
                                                   spdlog::async_overflow_policy::overrun_oldest);
}

std::size_t ServiceLog::lost_lines() const { return writers_ ? writers_->overrun_counter() : 0; }

}  // namespace puck
