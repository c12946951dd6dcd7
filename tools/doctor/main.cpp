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
  app.add_option("--lcm-url", options.lcm_url, "The bus, as LCM writes it; the setting lcm.url")
      ->type_name("URL");
  app.add_option("--prefix", options.prefix,
                 "P makes every channel P_PUCK_...; the setting lcm.prefix")
      ->type_name("P");
  app.add_option("--config", options.config_file,
                 "Settings of a service, TOML: [lcm] and camera.packet_bytes count")
      ->type_name("FILE");
  app.add_option("--set", options.settings, "One of these settings; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--seconds", options.seconds, "How long to listen")
      ->check(puck::number_range(0.2, 3600))
      ->capture_default_str();
  app.add_flag("--json", options.json, "For scripts");
  app.set_version_flag("--version", std::string(puck::kDoctorName) + " " + PUCK_VERSION);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Says why nothing arrives: looks at this host's network, listens on the bus, and for what is "
      "wrong says the command that mends it. Exit code 0: nothing is wrong, 1: something is, "
      "2: usage, or no report could be made.",
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
