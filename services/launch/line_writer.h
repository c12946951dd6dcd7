#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <thread>

namespace puck {

/// Writes lines to a descriptor with a thread of its own, so that nobody who has something to say
/// waits for whoever reads it: up to kMostLines wait, and of more the oldest are lost and counted.
/// A reader that is gone costs the lines alone. Safe from any thread.
class LineWriter {
 public:
  static constexpr std::size_t kMostLines = 1024;
  /// So long it waits at its end for a reader to take what is left.
  static constexpr std::chrono::milliseconds kPatience{200};

  /// The descriptor stays open for as long as this, and as a write that hangs.
  explicit LineWriter(int descriptor);
  /// Writes what waits; within kPatience, or never.
  ~LineWriter();
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  /// `line`: with its end.
  void put(std::string line);
  std::size_t lost() const;

 private:
  struct Lines;
  static void write_lines(Lines& lines, int descriptor);

  std::shared_ptr<Lines> lines_;  // the thread's as well: one that hangs is left behind
  std::thread thread_;
};

}  // namespace puck
