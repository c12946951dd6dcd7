#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "tools/command_line/flush_stdout.h"
#include "tools/command_line/number_range.h"
#include "tools/doctor/checks.h"
#include "tools/doctor/doctor_name.h"
#include "tools/doctor/gather.h"
#include "tools/doctor/report.h"

namespace {

constexpr int kUsageError = 2;

void add_options(CLI::App& app, puck::DoctorOptions& options) {
  puck::add_bus_options(app, options);
  app.add_option("--prefix", options.prefix,
                 "Channel prefix: every channel is called P_PUCK_...; overrides lcm.prefix")
      ->type_name("P");
  app.get_option("--config")
      ->description("TOML file of a service; its [lcm] section and camera.packet_bytes are used");
  app.add_option("--seconds", options.seconds, "Time to listen, s")
      ->check(puck::number_range(0.2, 3600))
      ->capture_default_str();
  app.add_flag("--json", options.json, "Print JSON for scripts");
  app.set_version_flag("--version", std::string(puck::kDoctorName) + " " + PUCK_VERSION);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Finds out why messages do not arrive: checks this host's network, listens on the bus, "
      "and prints a command that repairs each fault. Exit code 0: no fault, 1: at least one "
      "fault, 2: usage, or no report could be made.",
      puck::kDoctorName);
  puck::DoctorOptions options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kUsageError;
  }
  try {
    const puck::DoctorSettings settings = puck::read_doctor_settings(options);
    const puck::Findings findings = puck::examine(puck::gather(settings));
    const std::string report =
        options.json ? puck::report_json(findings) : puck::report_text(findings);
    std::fputs(report.c_str(), stdout);
    puck::flush_stdout();
    return puck::count(findings, puck::Verdict::kWrong) == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", puck::kDoctorName, error.what());
    return kUsageError;
  }
}
