#include "services/launch/run_service.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <sstream>
#include <utility>

#include <spdlog/fmt/fmt.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "common/messaging/bus_settings.h"
#include "common/messaging/status_check.h"
#include "services/launch/line_writer.h"
#include "services/launch/service_log.h"
#include "services/launch/stop_on_signal.h"

namespace puck {
namespace {

/// A TOML string, so that a prefix of digits stays text.
std::string quoted(const std::string& text) {
  std::string quoted_text = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted_text += '\\';
    quoted_text += c;
  }
  return quoted_text + '"';
}

Config load_config(const CommandLine& line) {
  Config config = line.config_file.empty() ? Config{} : Config::from_file(line.config_file);
  for (const std::string& setting : line.settings) config.override_with(setting);
  if (line.lcm_url) config.override_with("lcm.url=" + quoted(*line.lcm_url));
  if (line.prefix) config.override_with("lcm.prefix=" + quoted(*line.prefix));
  return config;
}

void log_config(spdlog::logger& log, const Config& config) {
  std::istringstream lines(config.effective());
  for (std::string line; std::getline(lines, line);) log.info("setting " + line);
}

// By default the kernel may end a wait 50 µs late, to group wake-ups; that is the whole latency
// budget of an estimate. Threads created later inherit the setting. It needs no permission; without
// it, waits are less exact.
void wait_exactly() {
  constexpr unsigned long kLatestNs = 1'000;
  prctl(PR_SET_TIMERSLACK, kLatestNs, 0UL, 0UL, 0UL);
}

int check(const std::string& name, const BusParams& params, std::stop_token stop) {
  constexpr std::chrono::seconds kTimeout{2};
  const StatusCheck result = check_service(params, name, kTimeout, std::move(stop));
  std::printf("%s\n", result.text.c_str());
  return result.healthy ? 0 : 1;
}

// Counters without room in a frame are left out from the end. So counters of losses come first, and
// those that other services can lengthen come last.
StatusReport report_of(const ServiceContext& context, const Service& service) {
  StatusReport own;
  service.report(own);
  StatusReport report;
  report.latencies = std::move(own.latencies);
  context.bus_watch.report_totals(report);
  std::move(own.counters.begin(), own.counters.end(), std::back_inserter(report.counters));
  context.bus_watch.report_channels(report);
  context.peers.report(report);
  return report;
}

int serve(const ServiceInfo& info, const CommandLine& line, const Config& config,
          const BusParams& params, const MakeService& make, std::stop_token stop) {
  Bus bus(params);
  ServiceLog service_log(info.name, STDERR_FILENO);
  spdlog::logger& log = service_log.logger();
  log.set_level(spdlog::level::from_str(line.log_level));
  log.info("version " PUCK_VERSION);
  log_config(log, config);

  StatusReporter status(bus, info.name);
  RateLimitedLog limited_log(log);
  BusWatch bus_watch(bus, log);
  PeerWatch peers(status, log);
  ServiceContext context{bus, status, log, limited_log, bus_watch, peers};
  const std::unique_ptr<Service> service = make(context);

  const bool started =
      bus.start(stop, [&](const std::string& reason) { log.warn("waiting: " + reason); });
  if (!started) return 0;
  log.info(fmt::format("on the bus: {}, session {}", bus.url().to_string(), bus.session()));

  int exit_code = 0;
  try {
    service->run(stop);
  } catch (const std::exception& error) {
    log.error(error.what());
    exit_code = 1;
  }
  status.stop([&](StatusReport& report) { report = report_of(context, *service); });
  bus_watch.look();
  if (const std::size_t lost = service_log.lost_lines(); lost > 0) {
    log.warn(fmt::format("{} lines of the log were lost", lost));
  }
  log.info("stopped");
  return exit_code;
}

}  // namespace

void poll_status(ServiceContext& context, const Service& service) {
  context.peers.poll();
  context.status.poll([&](StatusReport& report) { report = report_of(context, service); });
  context.bus_watch.poll();
}

int run_service(const ServiceInfo& info, int argc, const char* const* argv,
                const ConfigureService& configure) {
  wait_exactly();
  const StopOnSignal signals;
  CommandLine line;
  if (const auto exit_code =
          parse_command_line(info.name, info.description, argc, argv, info.add_options, line)) {
    return *exit_code;
  }
  try {
    Config config = load_config(line);
    const BusParams params = read_bus_params(config);
    // A check or an operator's stop needs the bus, not the service's own settings.
    if (line.check) return check(info.name, params, signals.token());
    if (info.instead) {
      if (const auto exit_code = info.instead(params, signals.token())) return *exit_code;
    }
    const MakeService make = configure(config);
    config.reject_unknown();
    return serve(info, line, config, params, make, signals.token());
  } catch (const std::exception& error) {
    LineWriter(STDERR_FILENO).put(info.name + ": " + error.what() + "\n");
    return 1;
  }
}

}  // namespace puck
