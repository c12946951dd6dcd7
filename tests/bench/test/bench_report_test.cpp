#include <stdexcept>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/bench/report/bars.h"
#include "tests/bench/report/benchmark_output.h"
#include "tests/bench/report/figures.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

// What Google Benchmark writes of a benchmark: the median and other aggregates.
class Output {
 public:
  void add(const std::string& name, double cpu_us, const Json& more = Json::object()) {
    Json median{{"name", name + "_median"}, {"run_name", name},  {"run_type", "aggregate"},
                {"repetitions", 7},         {"threads", 1},      {"aggregate_name", "median"},
                {"iterations", 7},          {"real_time", 77e3}, {"cpu_time", cpu_us * 1e3},
                {"time_unit", "ns"},        {"family_index", 3}};
    median.update(more);
    Json mean = median;
    mean["aggregate_name"] = "mean";
    mean["cpu_time"] = 1;
    Json cv = median;
    cv["aggregate_name"] = "cv";
    cv["cpu_time"] = 0.125;
    for (const Json& run : {mean, median, cv}) json_["benchmarks"].push_back(run);
  }
  void add_failure(const std::string& name) {
    json_["benchmarks"].push_back({{"run_name", name},
                                   {"run_type", "iteration"},
                                   {"error_occurred", true},
                                   {"error_message", "no input"}});
  }
  BenchmarkOutput read() const {
    return read_benchmark_output(folder_.write("out.json", json_.dump()));
  }
  BenchFigures figures() const { return figures_of(read()); }

 private:
  TemporaryFolder folder_;
  Json json_{{"context", {{"num_cpus", 2}, {"cpu_model", "a machine"}}},
             {"benchmarks", Json::array()}};
};

const Bar& bar(const std::string& key) {
  for (const Bar& each : bars()) {
    if (each.key == key) return each;
  }
  throw std::runtime_error("no bar is called " + key);
}

}  // namespace

TEST_CASE("a ratio compares medians, with the fastest form in OpenCV") {
  Output output;
  output.add("step_far/ours", 2);
  output.add("step_far/opencv", 60);
  output.add("step_far/opencv_dense", 90);
  output.add("step_far/plain", 5);
  output.add("step_far/plain_slow", 8);
  const BenchFigures figures = output.figures();
  CHECK(*figures.find("step_far_us") == doctest::Approx(2));
  CHECK(*figures.find("step_far_ratio") == doctest::Approx(30));
  CHECK(*figures.find("step_far_opencv_dense_ratio") == doctest::Approx(45));
  CHECK(*figures.find("step_far_plain_ratio") == doctest::Approx(2.5));
  CHECK(*figures.find("step_far_plain_slow_ratio") == doctest::Approx(4));
  CHECK(*figures.find("step_far_spread_percent") == doctest::Approx(12.5));
  CHECK(!figures.find("step_far_mev_s"));
  CHECK(figures.words.at("cpu_model") == "a machine");
  CHECK(*figures.find("cores") == 2);
}

TEST_CASE("where items are counted, a ratio is a ratio of times per item") {
  Output output;
  output.add("eros_k3_scene/ours", 10, {{"items_per_second", 200e6}});
  output.add("eros_k3_scene/opencv_8u", 5, {{"items_per_second", 8e6}});
  output.add("eros_k3_scene/opencv_64f", 5, {{"items_per_second", 10e6}});
  output.add("eros_k3_uniform/ours", 10, {{"items_per_second", 100e6}});
  const BenchFigures figures = output.figures();
  CHECK(*figures.find("eros_k3_mev_s") == doctest::Approx(200));
  CHECK(*figures.find("eros_k3_ratio") == doctest::Approx(20));
  CHECK(*figures.find("eros_k3_opencv_8u_ratio") == doctest::Approx(25));
  CHECK(*figures.find("eros_k3_uniform_mev_s") == doctest::Approx(100));
  CHECK(!figures.find("eros_k3_uniform_ratio"));
}

TEST_CASE("steps, counters and a benchmark's own clock are understood") {
  Output output;
  output.add("step_mid/ours", 40, {{"steps", 4}, {"match_percent", 99.5}});
  output.add("step_mid/opencv", 300, {{"steps", 1}});
  output.add("writer_slowdown/ours/manual_time", 1, {{"percent", 7}});
  const BenchFigures figures = output.figures();
  CHECK(*figures.find("step_mid_us") == doctest::Approx(10));
  CHECK(*figures.find("step_mid_ratio") == doctest::Approx(30));
  CHECK(*figures.find("step_mid_match_percent") == doctest::Approx(99.5));
  CHECK(!figures.find("step_mid_steps"));
  CHECK(*figures.find("writer_slowdown_us") == doctest::Approx(77));
  CHECK(*figures.find("writer_slowdown_percent") == doctest::Approx(7));
}

TEST_CASE("a benchmark's description of its input is kept") {
  Output output;
  output.add("evt3_decode/ours", 1, {{"items_per_second", 300e6}, {"label", "the scene"}});
  output.add("packet_decode/ours", 1, {{"items_per_second", 700e6}});
  const BenchFigures figures = output.figures();
  CHECK(figures.words.at("evt3_decode_note") == "the scene");
  CHECK(!figures.words.contains("packet_decode_note"));
}

TEST_CASE("a failed benchmark is reported with its reason and has no figure") {
  Output output;
  output.add("step_far/ours", 2);
  output.add_failure("step_near/ours");
  const BenchmarkOutput read = output.read();
  REQUIRE(read.failures.size() == 1);
  CHECK(read.failures.front() == "step_near/ours: no input");
  CHECK(read.find("step_near", "ours") == nullptr);
}

TEST_CASE("ambiguous or unreadable names of benchmarks are refused") {
  Output twice;
  twice.add("packet_decode/ours/1472", 1);
  twice.add("packet_decode/ours/60000", 2);
  CHECK_THROWS_AS(twice.read(), std::runtime_error);
  Output nameless;
  nameless.add("packet_decode", 1);
  CHECK_THROWS_AS(nameless.read(), std::runtime_error);
}

TEST_CASE("a file without medians is refused with its name") {
  const TemporaryFolder folder;
  const auto path = folder.write("out.json", R"({"context":{"num_cpus":2},"benchmarks":[]})");
  CHECK_THROWS_WITH_AS(
      read_benchmark_output(path),
      (path.string() + ": holds no medians; puck-bench must repeat each benchmark").c_str(),
      std::runtime_error);
  CHECK_THROWS_AS(read_benchmark_output(folder / "nothing.json"), std::runtime_error);
  CHECK_THROWS_AS(read_benchmark_output(folder.write("cut.json", "{")), std::runtime_error);
}

TEST_CASE("a goal is reached at its limit, and missed beyond it") {
  CHECK(bar("eros_k3_ratio").is_met_by(20));
  CHECK(!bar("eros_k3_ratio").is_met_by(19.9));
  CHECK(bar("packet_to_estimate_p50_us").is_met_by(50));
  CHECK(!bar("packet_to_estimate_p50_us").is_met_by(51));
  CHECK(!bar("lcm_lost").is_met_by(1));
  CHECK(bar("step_far_us").is_met_by(1e9));
  CHECK(bar("eros_k3_ratio").text() == ">= 20 (33 seen)");
}

TEST_CASE("the JSON holds every key of the goals, null without a measurement") {
  const TemporaryFolder folder;
  BenchFigures figures;
  figures.values["eros_k3_ratio"] = 21;
  figures.words["cpu_model"] = "a machine";
  add_flat_json(folder.write("live.json", R"({"lcm_lost": 0, "recording": "a game",
                                              "estimate_rate_hz": null})"),
                figures);
  write_json(figures, folder / "figures.json");
  const Json json = Json::parse(read_text(folder / "figures.json"));
  for (const Bar& each : bars()) CHECK(json.contains(each.key));
  CHECK(json.at("eros_k3_ratio") == 21);
  CHECK(json.at("lcm_lost").dump() == "0");
  CHECK(json.at("estimate_rate_hz").is_null());
  CHECK(json.at("recording") == "a game");
  CHECK(json.at("cpu_model") == "a machine");
  CHECK(missing_keys(figures).size() == bars().size() - 2);
}

}  // namespace puck
