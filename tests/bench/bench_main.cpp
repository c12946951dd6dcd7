// All benchmarks of this folder; see docs/speed.md for the names and run.sh for the flags.

#include <fstream>
#include <string>

#include <benchmark/benchmark.h>
#include <hwy/highway.h>
#include <opencv2/core.hpp>

namespace {

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

// The best compiled instruction set of this machine, as HWY_DYNAMIC_DISPATCH chooses.
std::string instruction_set() {
  const std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
  return hwy::TargetName(targets & -targets);
}

}  // namespace

int main(int argc, char** argv) {
  // Ratios compare one core with one core.
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::AddCustomContext("cpu_model", cpu_model());
  benchmark::AddCustomContext("highway_target", instruction_set());
  benchmark::AddCustomContext("opencv_version", CV_VERSION);
  const std::size_t run = benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return run > 0 ? 0 : 1;
}
