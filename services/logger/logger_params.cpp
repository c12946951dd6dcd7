#include "services/logger/logger_params.h"

#include <limits>

namespace puck {
namespace {

constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
// Both hold the largest PUCK message.
constexpr std::int64_t kSmallestFile = std::int64_t{64} << 10;
constexpr std::int64_t kSmallestQueue = std::int64_t{1} << 20;
constexpr std::int64_t kLargestQueue = std::int64_t{16} << 30;
constexpr std::int64_t kLongest_s = 366LL * 24 * 3600;

void check_quota(const Config& config, const LoggerParams& params) {
  if (params.quota_bytes == 0) return;
  if (params.rotate_bytes == 0) {
    config.fail("logger.quota_bytes", "needs logger.rotate_bytes: whole files are removed");
  }
  if (params.quota_bytes / 2 < params.rotate_bytes) {
    config.fail(
        "logger.quota_bytes",
        "must be at least 2 * logger.rotate_bytes, for the file being written and one more");
  }
  const std::size_t name = params.path.rfind('/');
  if (name != std::string::npos && params.path.find('%') < name) {
    config.fail("logger.quota_bytes",
                "applies to one folder, so the folder in logger.path must not contain %");
  }
}

}  // namespace

LoggerParams read_logger_params(Config& config) {
  LoggerParams params;
  config.read("logger.path", params.path);
  config.read("logger.overwrite", params.overwrite);
  config.read("logger.max_bytes", params.max_bytes, 0, kMost);
  config.read("logger.rotate_bytes", params.rotate_bytes, 0, kMost);
  config.read("logger.rotate_s", params.rotate_s, 0, kLongest_s);
  config.read("logger.quota_bytes", params.quota_bytes, 0, kMost);
  config.read("logger.min_free_bytes", params.min_free_bytes, 0, kMost);
  config.read("logger.queue_bytes", params.queue_bytes, kSmallestQueue, kLargestQueue);
  if (params.rotate_bytes > 0 && params.rotate_bytes < kSmallestFile) {
    config.fail("logger.rotate_bytes", "must be 0 or at least " + std::to_string(kSmallestFile) +
                                           ", got " + std::to_string(params.rotate_bytes));
  }
  check_quota(config, params);
  return params;
}

}  // namespace puck
