#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "common/messaging/event_packing.h"
#include "services/launch/stop_on_signal.h"
#include "tests/bench/live/live_figures.h"
#include "tests/bench/live/live_measurements.h"

namespace puck {
namespace {

struct Options {
  int seconds = 0;  // 0: as --quick or not says
  bool quick = false;
  std::vector<std::string> only;
  std::vector<double> rates{10, 15, 20, 30, 40};
  std::filesystem::path source = ".";
  std::filesystem::path recordings;
  std::filesystem::path json;
  std::string key_file;

  bool wants(const char* part) const {
    return only.empty() || std::find(only.begin(), only.end(), part) != only.end();
  }
};

void measure(const LiveSetup& setup, const Options& options) {
  const std::chrono::seconds sustained(options.seconds > 0 ? options.seconds
                                       : options.quick     ? 10
                                                           : 60);
  const std::chrono::seconds brief(options.quick ? 5 : 10);
  const TemporaryFolder folder;
  LiveFigures figures;
  std::printf("simulating a game\n");
  const Recording game = simulate_game(setup, folder.path());
  const Recording dense = dense_recording(options.recordings, game);
  figures.recording = dense.name;
  if (options.wants("transport")) {
    for (const double rate : options.rates) {
      const auto time = rate == options.rates.front() ? sustained : brief;
      std::printf("transport at %.0f Mev/s for %lld s\n", rate,
                  static_cast<long long>(time.count()));
      figures.transport.push_back(measure_transport(setup, dense, rate, time));
      if (!figures.transport.back().carried_all()) break;
    }
  }
  if (options.wants("busy")) {
    for (const double rate : {10.0, 20.0}) {
      const auto time = rate > 10 ? sustained : brief;
      std::printf("busy game of %.0f Mev/s for %lld s\n", rate,
                  static_cast<long long>(time.count()));
      const Recording busy = write_busy_game(game, rate, folder.path());
      figures.busy.push_back(measure_transport(setup, busy, rate, time));
    }
  }
  if (options.wants("network")) {
    std::printf("transport between two machines\n");
    try {
      const auto rates = options.quick ? std::vector{options.rates.front()} : options.rates;
      measure_network(setup, dense, game, rates, sustained, brief, figures);
    } catch (const NoNetwork& error) {
      std::fprintf(stderr, "puck-bench-live: %s\n", error.what());
    }
  }
  if (options.wants("key")) {
    for (const int packet_bytes : {EventPackerParams::kMaxBytes, EventPackerParams::kOneFrame}) {
      std::printf("cost of a key, packets of %d bytes\n", packet_bytes);
      figures.key.push_back(measure_key(setup, dense, options.rates.front(), packet_bytes, brief,
                                        options.quick ? 1 : 2));
    }
  }
  if (options.wants("latency")) {
    std::printf("latency at 1 Mev/s\n");
    measure_latency(setup, game, 2 * brief, figures);
    std::printf("rate of estimates\n");
    figures.estimate_rate_hz = measure_rate(setup, game, 5'000, brief);
    figures.estimate_rate_unlimited_hz = measure_rate(setup, game, 100'000, brief);
  }
  if (options.wants("still")) {
    std::printf("still scene\n");
    // Not less than 10 s, even when quick: there is little to measure.
    const std::chrono::seconds time(std::max<std::int64_t>(10, brief.count()));
    const Recording scene =
        write_still_scene(setup, folder.path(), static_cast<double>(time.count() + 5));
    measure_still_scene(setup, scene, time, figures);
  }
  if (options.wants("flood")) {
    std::printf("flood\n");
    measure_flood(setup, std::chrono::seconds(10), figures);
  }
  std::printf("\n");
  print(figures);
  if (!options.json.empty()) write_json(figures, options.json);
}

int run(int argc, char** argv) {
  const StopOnSignal signals;
  Options options;
  if (const char* named = std::getenv("PUCK_RECORDINGS")) options.recordings = named;
  CLI::App app(
      "Runs the five services on this machine and measures what they carry, how soon they "
      "answer and what they cost.",
      "puck-bench-live");
  app.add_flag("--quick", options.quick, "Seconds instead of minutes");
  app.add_option("--seconds", options.seconds, "Of the sustained run (default 60, quick 10)")
      ->check(CLI::Range(1, 3600));
  app.add_option("--rates", options.rates,
                 "Mev/s: the sustained run's, then as long as nothing is "
                 "lost the next ones, briefly")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--only", options.only,
                 "Parts to measure: transport, busy, network, key, latency, still, flood")
      ->check(CLI::IsMember({"transport", "busy", "network", "key", "latency", "still", "flood"}))
      ->delimiter(',');
  app.add_option("--source", options.source, "Root of the project, where config/ is")
      ->capture_default_str();
  app.add_option("--recordings", options.recordings,
                 "Folder of real recordings (default: PUCK_RECORDINGS); without, a simulated one");
  app.add_option("--key-file", options.key_file, "Seal all messages with this key (lcm.key_file)");
  app.add_option("--json", options.json, "Write the figures there");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  // Each part takes a while, so its figures appear at once, even in a pipe.
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  try {
    options.source = std::filesystem::absolute(options.source);
    if (!std::filesystem::exists(options.source / "config" / "tracker.toml")) {
      throw std::runtime_error(options.source.string() +
                               ": no config/tracker.toml here; --source takes the project's root");
    }
    if (!options.recordings.empty())
      options.recordings = std::filesystem::absolute(options.recordings);
    measure({.bin = std::filesystem::read_symlink("/proc/self/exe").parent_path(),
             .source = options.source,
             .key_file = options.key_file,
             .stop = signals.token()},
            options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-bench-live: %s\n", error.what());
    return 1;
  }
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) { return puck::run(argc, argv); }
