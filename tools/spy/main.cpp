#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <sys/ioctl.h>
#include <unistd.h>

#include "tools/command_line/bus_options.h"
#include "tools/command_line/flush_stdout.h"
#include "tools/command_line/number_range.h"
#include "tools/spy/listen.h"
#include "tools/spy/spy_report.h"

namespace puck {
namespace {

struct Options {
  BusOptions bus;
  bool once = false;
  double seconds = 2;
  bool json = false;
};

/// Width of the terminal on stdout; unlimited for a file or a pipe.
std::size_t output_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return std::numeric_limits<std::uint16_t>::max();
}

/// Ending for the message that nothing was received; empty: unknown.
std::string reason_of(const Heard& heard) {
  if (!heard.problem.empty()) return ": " + heard.problem;
  std::int64_t unauthenticated = heard.snapshot.unknown_unauthenticated;
  std::string last;
  for (const ChannelRow& channel : heard.snapshot.channels) {
    unauthenticated += channel.unauthenticated;
    if (channel.unauthenticated > 0)
      last = ", the last on " + channel.name + ' ' + channel.last_rejection;
  }
  if (unauthenticated > 0) {
    return "; but " + std::to_string(unauthenticated) + " messages without our key" + last;
  }
  const TransportCounters& network = heard.snapshot.network;
  if (network.foreign_traffic.empty()) return {};
  const ForeignTraffic& first = network.foreign_traffic.front();
  return "; but " + std::to_string(network.foreign) + " foreign datagrams: " + first.what +
         " from " + to_string(first.sender);
}

int report_once(const Options& options, const BusParams& params, StopSignal& stop) {
  const Heard heard = listen(params, options.seconds, stop);
  if (options.json) {
    std::fputs(json_report(heard.snapshot, params.url, params.prefix).c_str(), stdout);
  } else {
    std::fputs(text_report(heard.snapshot, output_width()).c_str(), stdout);
  }
  flush_stdout();
  if (heard.snapshot.messages > 0) return 0;
  std::fprintf(stderr, "puck-spy: no message was received on %s%s\n", params.url.c_str(),
               reason_of(heard).c_str());
  return 1;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("Shows every channel and every service on the bus. Press h for the keys.",
               "puck-spy");
  app.set_version_flag("--version", PUCK_VERSION);
  add_bus_options(app, options.bus);
  app.add_option("--prefix", options.bus.prefix,
                 "Channel prefix: shows P_PUCK_... only; overrides lcm.prefix")
      ->type_name("P");
  CLI::Option* once =
      app.add_flag("--once", options.once,
                   "Listen, print one report and exit; exit code 1: no message was received");
  app.add_option("--seconds", options.seconds, "Time to listen with --once, s")
      ->check(number_range(0.1, 86'400))
      ->capture_default_str()
      ->needs(once);
  app.add_flag("--json", options.json, "Print JSON instead of tables")->needs(once);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  StopSignal stop;
  try {
    const BusParams params = bus_params(options.bus);
    if (options.once) return report_once(options, params, stop);
    watch(params, stop);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-spy: %s\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) { return puck::run(argc, argv); }
