#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "puck/ground_truth_t.hpp"
#include "puck/service_status_t.hpp"

namespace puck {

/// Progress of a running game, from TRUTH and the tracker's STATUS. One thread.
class LiveGame {
 public:
  void take(const ground_truth_t& truth);
  void take(const service_status_t& status);

  /// One line; the estimates' rate is that since the previous line. A dash is a value that no
  /// service has published yet.
  std::string line(double elapsed_s);

 private:
  std::optional<ground_truth_t> truth_;
  std::optional<std::int64_t> estimates_;
  std::optional<std::int64_t> latency_p50_us_;
  std::int64_t estimates_before_ = 0;
  double line_before_s_ = 0;
};

/// Prints such a line for `seconds`: rewritten every second on a terminal, a new one every five
/// seconds elsewhere. Throws BusError for a malformed URL, std::runtime_error when the bus cannot
/// be joined.
void watch_game(const std::string& url, int seconds);

}  // namespace puck
