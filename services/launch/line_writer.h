#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <thread>

namespace puck {

/// Writes lines to a descriptor on its own thread, so that callers never wait for the reader. Up to
/// kMostLines wait; beyond that the oldest are dropped and counted. A closed reader costs only the
/// lines. Safe from any thread.
class LineWriter {
 public:
  static constexpr std::size_t kMostLines = 1024;
  /// Longest time that the destructor waits for the reader.
  static constexpr std::chrono::milliseconds kPatience{200};

  /// The descriptor must stay open during this object's life and during a write that hangs.
  explicit LineWriter(int descriptor);
  /// Writes the waiting lines; gives up after kPatience.
  ~LineWriter();
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  /// `line`: with its newline.
  void put(std::string line);
  std::size_t lost() const;

 private:
  struct Lines;
  static void write_lines(Lines& lines, int descriptor);

  std::shared_ptr<Lines> lines_;  // shared with the thread, which is left behind if it hangs
  std::thread thread_;
};

}  // namespace puck
