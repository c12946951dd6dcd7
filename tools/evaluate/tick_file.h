#pragma once

#include <filesystem>
#include <fstream>

#include "tools/evaluate/runs.h"

namespace puck {

/// The rows of `--csv`: t_us,x,y,width,height,score,state,latency_us; unknown values stay empty.
class TickFile {
 public:
  /// Throws std::runtime_error when the file cannot be written.
  explicit TickFile(const std::filesystem::path& path);

  void add(const EvaluatedTick& tick);
  /// Throws std::runtime_error if a write failed.
  void close();

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace puck
