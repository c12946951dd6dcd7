#include "tests/bench/report/benchmark_output.h"

#include <fstream>
#include <set>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

double us_of(const std::string& unit) {
  if (unit == "ns") return 1e-3;
  if (unit == "us") return 1;
  if (unit == "ms") return 1e3;
  if (unit == "s") return 1e6;
  throw std::runtime_error("unknown time unit " + unit);
}

// What Google Benchmark writes about every benchmark; other numbers are counters.
const std::set<std::string> kOwnFields{"family_index",     "per_family_instance_index",
                                       "repetitions",      "repetition_index",
                                       "threads",          "iterations",
                                       "real_time",        "cpu_time",
                                       "items_per_second", "bytes_per_second"};

// Facts for a comparison of two runs.
constexpr const char* kToldOfMachine[] = {"cpu_model", "highway_target", "opencv_version", "date"};

struct Name {
  std::string figure;
  std::string variant;
  bool times_itself = false;
};

// FIGURE/VARIANT, followed by Google Benchmark's flags.
Name parse_name(const std::string& run_name) {
  const auto slash = run_name.find('/');
  if (slash == std::string::npos) {
    throw std::runtime_error("benchmark " + run_name + " is not called FIGURE/VARIANT");
  }
  const auto flags = run_name.find('/', slash + 1);
  return {run_name.substr(0, slash), run_name.substr(slash + 1, flags - slash - 1),
          flags != std::string::npos && run_name.find("/manual_time", flags) != std::string::npos};
}

void take_median(const Json& run, const char* time_field, Measurement& measurement) {
  measurement.time_us =
      run.at(time_field).get<double>() * us_of(run.at("time_unit").get<std::string>());
  if (run.contains("items_per_second")) measurement.items_per_s = run.at("items_per_second");
  measurement.note = run.value("label", "");
  for (const auto& [key, value] : run.items()) {
    if (value.is_number() && !kOwnFields.contains(key)) measurement.counters[key] = value;
  }
}

void take(const Json& run, BenchmarkOutput& output) {
  const std::string run_name = run.at("run_name");
  if (run.value("error_occurred", false)) {
    output.failures.push_back(run_name + ": " + run.value("error_message", "failed"));
    return;
  }
  const std::string aggregate = run.value("aggregate_name", "");
  const Name name = parse_name(run_name);
  const char* const time_field = name.times_itself ? "real_time" : "cpu_time";
  if (aggregate == "median") {
    if (output.find(name.figure, name.variant) != nullptr) {
      throw std::runtime_error("two benchmarks are called " + name.figure + "/" + name.variant);
    }
    take_median(run, time_field, output.figures[name.figure][name.variant]);
  } else if (aggregate == "cv") {
    // Google Benchmark writes it after the median.
    output.figures[name.figure][name.variant].spread_percent =
        100 * run.at(time_field).get<double>();
  }
}

BenchmarkOutput parse(const Json& json) {
  BenchmarkOutput output;
  const Json& context = json.at("context");
  for (const char* key : kToldOfMachine) {
    if (context.contains(key)) output.machine[key] = context.at(key);
  }
  output.cores = context.at("num_cpus");
  for (const Json& run : json.at("benchmarks")) take(run, output);
  if (output.figures.empty() && output.failures.empty()) {
    throw std::runtime_error("holds no medians; puck-bench must repeat each benchmark");
  }
  return output;
}

}  // namespace

double Measurement::time_of_work_us() const {
  if (items_per_s) return 1e6 / *items_per_s;
  const auto steps = counters.find("steps");
  return steps == counters.end() ? time_us : time_us / steps->second;
}

const Measurement* BenchmarkOutput::find(const std::string& figure,
                                         const std::string& variant) const {
  const auto variants = figures.find(figure);
  if (variants == figures.end()) return nullptr;
  const auto found = variants->second.find(variant);
  return found == variants->second.end() ? nullptr : &found->second;
}

const Measurement* BenchmarkOutput::fastest(const std::string& figure,
                                            const std::string& beginning) const {
  const auto variants = figures.find(figure);
  if (variants == figures.end()) return nullptr;
  const Measurement* fastest = nullptr;
  for (const auto& [variant, measurement] : variants->second) {
    if (!variant.starts_with(beginning)) continue;
    if (fastest == nullptr || measurement.time_of_work_us() < fastest->time_of_work_us()) {
      fastest = &measurement;
    }
  }
  return fastest;
}

BenchmarkOutput read_benchmark_output(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  try {
    return parse(Json::parse(file));
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace puck
