// puck-intruder: sends invalid data to test the receivers. Only for networks without a robot.
#include <cinttypes>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tests/intruder/attacks.h"
#include "tools/command_line/run_tool.h"

namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  std::string lcm_url = puck::kDefaultLcmUrl;
  std::string prefix;
  double seconds = 1;
  std::string attack;
  std::uint64_t seed = 1;
};

void carry_out(const puck::Attack& attack, const Options& options) {
  puck::RawSender sender(puck::parse_lcm_url(options.lcm_url), options.prefix,
                         attack.datagrams_per_s, options.seed);
  const auto begin = Clock::now();
  const auto elapsed_s = [begin] {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  for (int round = 0; elapsed_s() < options.seconds; ++round) attack.attack(sender, round);
  std::printf("%-13s %8" PRId64 " datagrams %10" PRId64 " bytes in %5.2f s: %s\n",
              std::string(attack.name).c_str(), sender.datagrams(), sender.bytes(), elapsed_s(),
              std::string(attack.sends).c_str());
  std::fflush(stdout);
}

int intrude(const Options& options) {
  puck::check_prefix(options.prefix);
  for (const puck::Attack& attack : puck::all_attacks()) {
    if (options.attack.empty() || options.attack == attack.name) carry_out(attack, options);
  }
  return 0;
}

std::string attacks_in_words() {
  std::string text = "Attacks:\n";
  for (const puck::Attack& attack : puck::all_attacks()) {
    text += "  " + std::string(attack.name) + ": " + std::string(attack.sends) + "\n";
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  constexpr double kLongestS = 600;
  CLI::App app(
      "Sends malformed datagrams and messages to the group of a bus, bounded in time and rate, and "
      "says what it sent. A test tool: never where a real robot listens.");
  Options options;
  app.add_option("--lcm-url", options.lcm_url, "where to")->capture_default_str();
  app.add_option("--prefix", options.prefix, "of the channels, as the services have it");
  app.add_option("--seconds", options.seconds, "for each attack")
      ->check(CLI::Range(0.01, kLongestS))
      ->capture_default_str();
  app.add_option("--attack", options.attack, "only this one")->check([](const std::string& name) {
    return puck::find_attack(name) != nullptr ? "" : "there is no attack " + name;
  });
  app.add_option("--seed", options.seed, "of what is random")->capture_default_str();
  app.footer(attacks_in_words());
  return puck::run_tool(app, argc, argv, "puck-intruder", [&] { return intrude(options); });
}
