#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/report/benchmark_output.h"

namespace puck {

/// All figures of a run, by their keys in the JSON.
struct BenchFigures {
  std::map<std::string, double> values;
  std::map<std::string, std::string> words;  ///< Of the machine, and what else is no number.

  std::optional<double> find(const std::string& key) const;
};

/// The keys that follow from the benchmarks' names; docs/speed.md lists the rules.
BenchFigures figures_of(const BenchmarkOutput& output);

/// Adds the keys of a flat JSON object, such as puck-bench-live writes; null is nothing. Throws
/// std::runtime_error with the file's name when it is not there or is something else.
void add_flat_json(const std::filesystem::path& path, BenchFigures& figures);

/// Keys of bars() without a value.
std::vector<std::string> missing_keys(const BenchFigures& figures);

/// What is held to a bar: value, bar, and whether it is met.
void print(const BenchFigures& figures);

/// One flat object: the keys of bars() first, null where there is no value, then all others. Throws
/// std::runtime_error when it cannot be written.
void write_json(const BenchFigures& figures, const std::filesystem::path& path);

}  // namespace puck
