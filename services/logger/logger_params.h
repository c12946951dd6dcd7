#pragma once

#include <cstdint>
#include <string>

#include "common/io/config.h"

namespace puck {

struct LoggerParams {
  /// Key logger.path. May contain conversions of strftime(3) for the local time of the start.
  std::string path = "puck-%Y-%m-%d-%H-%M-%S.lcm";
  bool overwrite = false;         ///< Key logger.overwrite: overwrite an existing file.
  std::int64_t max_bytes = 0;     ///< Key logger.max_bytes: size at which it stops; 0: no limit.
  std::int64_t rotate_bytes = 0;  ///< Key logger.rotate_bytes: largest file; 0: no limit.
  std::int64_t rotate_s = 0;      ///< Key logger.rotate_s: longest file; 0: no limit.
  std::int64_t quota_bytes = 0;   ///< Key logger.quota_bytes: all rotated files; 0: no limit.
  /// Key logger.min_free_bytes: free space below which writing pauses.
  std::int64_t min_free_bytes = std::int64_t{64} << 20;
  /// Key logger.queue_bytes: size of the queue for a slow disk.
  std::int64_t queue_bytes = std::int64_t{128} << 20;

  bool rotates() const { return rotate_bytes > 0 || rotate_s > 0; }
};

/// Throws ConfigError.
LoggerParams read_logger_params(Config& config);

}  // namespace puck
