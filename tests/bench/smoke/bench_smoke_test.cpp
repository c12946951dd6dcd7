#include <algorithm>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/support/child_process.h"
#include "tests/support/environment.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

using Json = nlohmann::json;

std::string program(const char* name) { return program_path(name); }

Finished run_benchmarks(const std::string& filter, const std::filesystem::path& out) {
  return run_program({program("puck-bench"), "--benchmark_filter=" + filter,
                      "--benchmark_min_time=0.001", "--benchmark_repetitions=7",
                      "--benchmark_enable_random_interleaving=true",
                      "--benchmark_report_aggregates_only=true", "--benchmark_out=" + out.string(),
                      "--benchmark_out_format=json"});
}

}  // namespace

TEST_CASE(
    "the benchmarks' figures are printed under their keys, with a description of the machine") {
  const TemporaryFolder folder;
  const auto benchmarks = folder / "benchmarks.json";
  const auto figures = folder / "figures.json";
  const Finished bench = run_benchmarks("^eros_k3_uniform/|^step_size_(13|91)/", benchmarks);
  CAPTURE(bench.errors);
  REQUIRE(bench.exit_code == 0);

  const Finished report =
      run_program({program("puck-bench-report"), benchmarks.string(), "--json", figures.string()});
  // The others were not measured: they are null, and that is said.
  CHECK(report.exit_code == 1);
  CHECK(report.errors.find("not measured: eros_k3_ratio") != std::string::npos);
  CHECK(report.output.find("NOT MEASURED") != std::string::npos);

  const Json json = Json::parse(read_text(figures));
  CHECK(json.at("eros_k3_ratio").is_null());
  for (const char* key : {"eros_k3_uniform_ratio", "eros_k3_uniform_mev_s",
                          "eros_k3_uniform_opencv_8u_ratio", "eros_k3_uniform_opencv_64f_ratio",
                          "eros_k3_uniform_plain_ratio", "step_size_13_us", "step_size_91_us"}) {
    REQUIRE_MESSAGE(json.contains(key), key);
    CHECK(json.at(key).get<double>() > 0);
  }
  CHECK(json.at("eros_k3_uniform_ratio").get<double>() ==
        std::min(json.at("eros_k3_uniform_opencv_8u_ratio").get<double>(),
                 json.at("eros_k3_uniform_opencv_64f_ratio").get<double>()));
  CHECK(!json.at("cpu_model").get<std::string>().empty());
  CHECK(!json.at("highway_target").get<std::string>().empty());

  // The charts show measured values only.
  const Finished charts =
      run_program({program("charts/bench.py"), figures.string(), folder.path().string()});
  CAPTURE(charts.errors);
  CHECK(charts.exit_code == 0);
  CHECK(std::filesystem::file_size(folder / "step-against-size.png") > 1000);
  CHECK_FALSE(std::filesystem::exists(folder / "surface-against-k.png"));
}

TEST_CASE("unknown benchmarks are an error") {
  const TemporaryFolder folder;
  CHECK(run_benchmarks("^no_such_figure/", folder / "benchmarks.json").exit_code == 1);
}

}  // namespace puck
