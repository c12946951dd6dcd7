#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace puck {

/// The medians of one benchmark over its repetitions.
struct Measurement {
  double time_us = 0;  ///< Of an iteration: CPU time, or what the benchmark measured itself.
  std::optional<double> items_per_s;       ///< Where a benchmark counts items.
  double spread_percent = 0;               ///< Standard deviation of the time over its mean.
  std::map<std::string, double> counters;  ///< Of the benchmark's own.
  std::string note;  ///< A benchmark's description of its input; mostly empty.

  /// Time of a fixed amount of work, for any number of items in an iteration.
  double time_of_work_us() const;
};

/// What puck-bench wrote. A benchmark is called FIGURE/VARIANT.
struct BenchmarkOutput {
  std::map<std::string, std::map<std::string, Measurement>> figures;
  std::map<std::string, std::string> machine;  ///< cpu_model, highway_target …, date.
  int cores = 0;
  std::vector<std::string> failures;  ///< One line each.

  /// Nothing when it was not measured.
  const Measurement* find(const std::string& figure, const std::string& variant) const;
  /// The fastest of the variants whose name begins with the prefix.
  const Measurement* fastest(const std::string& figure, const std::string& beginning) const;
};

/// Reads the JSON of Google Benchmark, which must hold medians. Throws std::runtime_error with the
/// file's name when it is not there or is something else.
BenchmarkOutput read_benchmark_output(const std::filesystem::path& path);

}  // namespace puck
