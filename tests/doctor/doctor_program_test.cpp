// The real program on networks that the tests make, break and repair with its suggested command.
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "tests/doctor/other_machine.h"
#include "tests/support/child_process.h"
#include "tests/support/environment.h"
#include "tests/support/network_namespace.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

using nlohmann::json;

const std::string kUrl = "udpm://239.255.76.67:7667?ttl=1";
const std::string kUrlThisHost = "udpm://239.255.76.67:7667?ttl=0";

struct Diagnosis {
  int exit_code = -1;
  json report;

  std::vector<std::string> wrong() const {
    std::vector<std::string> checks;
    for (const json& finding : report["findings"]) {
      if (finding["verdict"] == "wrong") checks.push_back(finding["check"]);
    }
    return checks;
  }
  /// All text of one check.
  std::string text(const std::string& check) const {
    std::string text;
    for (const json& finding : report["findings"]) {
      if (finding["check"] == check) text += finding["text"].get<std::string>() + "\n";
    }
    return text;
  }
  /// The command of the first finding that contains `part`.
  std::string mend(const std::string& check, const std::string& part = {}) const {
    for (const json& finding : report["findings"]) {
      if (finding["check"] != check || finding["verdict"] != "wrong") continue;
      const std::string mend = finding["mend"];
      if (mend.find(part) != std::string::npos) return mend;
    }
    return {};
  }
};

Finished run_doctor(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), program_path("puck-doctor"));
  return run_program(arguments);
}

/// In this thread's network.
Diagnosis diagnose(std::vector<std::string> arguments = {"--lcm-url", kUrl},
                   const std::string& seconds = "1") {
  arguments.insert(arguments.end(), {"--json", "--seconds", seconds});
  const Finished finished = run_doctor(std::move(arguments));
  INFO(finished.errors);
  REQUIRE(json::accept(finished.output));
  return {finished.exit_code, json::parse(finished.output)};
}

bool shell(const std::string& command) { return std::system(command.c_str()) == 0; }

/// The kernel takes up to a second to notice that a cable was pulled or plugged in.
void await_link(bool is_up) {
  REQUIRE(wait_until([&] { return shell("ip link show cable | grep -q 'state UP'") == is_up; }));
}

/// A cable to another machine, 10.9.8.1 to 10.9.8.2, but no route for the group yet.
void plug_in() {
  REQUIRE(ip("link add cable type veth peer name far_end"));
  REQUIRE(ip("link set far_end up"));
  REQUIRE(ip("addr add 10.9.8.1/24 dev cable"));
  REQUIRE(ip("link set cable up"));
}

/// And the route.
void join_network() {
  plug_in();
  REQUIRE(ip("route add 224.0.0.0/4 dev cable"));
}

/// The part of a command behind an option, without quotes: "--lcm-url \"X\"" gives X.
std::string argument_of(const std::string& command, const std::string& option) {
  const auto at = command.find(option + " ");
  REQUIRE(at != std::string::npos);
  std::string rest = command.substr(at + option.size() + 1);
  std::erase(rest, '"');
  return rest;
}

void check_well(const Diagnosis& diagnosis) {
  CAPTURE(diagnosis.report.dump(1));
  CHECK(diagnosis.exit_code == 0);
}

void check_only_wrong(const Diagnosis& diagnosis, const std::vector<std::string>& checks) {
  CAPTURE(diagnosis.report.dump(1));
  CHECK(diagnosis.exit_code == 1);
  CHECK(diagnosis.wrong() == checks);
}

}  // namespace

TEST_CASE("a missing route is found, and the suggested command adds it") {
  in_network_of_its_own([] {
    plug_in();
    const Diagnosis broken = diagnose();
    check_only_wrong(broken, {"route"});
    REQUIRE(shell(broken.mend("route")));
    const Diagnosis mended = diagnose();
    check_well(mended);
    CHECK(mended.text("route").find("goes by cable, from 10.9.8.1") != std::string::npos);
  });
}

TEST_CASE("a single host needs only a route over its loopback") {
  in_network_of_its_own([] {
    REQUIRE(ip("link set lo down"));
    const Diagnosis broken = diagnose({"--lcm-url", kUrlThisHost});
    check_only_wrong(broken, {"route"});
    REQUIRE(shell(broken.mend("route")));
    check_well(diagnose({"--lcm-url", kUrlThisHost}));
  });
}

TEST_CASE("a group that is routed to the loopback does not reach other machines") {
  in_network_of_its_own([] {
    REQUIRE(ip("route add 224.0.0.0/4 dev lo"));
    const Diagnosis alone = diagnose();
    check_only_wrong(alone, {"route"});
    check_well(diagnose({"--lcm-url", argument_of(alone.mend("route"), "--lcm-url")}));

    plug_in();
    const Diagnosis cabled = diagnose();
    check_only_wrong(cabled, {"route"});
    REQUIRE(shell(cabled.mend("route")));
    check_well(diagnose());
  });
}

TEST_CASE("an interface without multicast is reported, and the suggested command repairs it") {
  in_network_of_its_own([] {
    join_network();
    REQUIRE(ip("link set cable multicast off"));
    const Diagnosis broken = diagnose();
    check_only_wrong(broken, {"interface"});
    REQUIRE(shell(broken.mend("interface")));
    check_well(diagnose());
  });
}

TEST_CASE("an interface without a link is reported") {
  in_network_of_its_own([] {
    join_network();
    REQUIRE(ip("link set far_end down"));
    await_link(false);
    const Diagnosis broken = diagnose();
    CHECK(broken.exit_code == 1);
    CHECK(broken.text("interface").find("no link") != std::string::npos);
    REQUIRE(ip("link set far_end up"));
    await_link(true);
    check_well(diagnose());
  });
}

TEST_CASE("packets above a small MTU are reported, and the suggested setting repairs it") {
  in_network_of_its_own([] {
    join_network();
    REQUIRE(ip("link set cable mtu 1200"));
    const Diagnosis broken = diagnose();
    check_only_wrong(broken, {"mtu"});
    const std::string setting = argument_of(broken.mend("mtu"), "--set");
    CHECK(setting == "camera.packet_bytes=1172");
    check_well(diagnose({"--lcm-url", kUrl, "--set", setting}));
  });
}

TEST_CASE("a receive buffer that the kernel refuses is reported") {
  in_network_of_its_own([] {
    join_network();
    // Above any machine's limit. The remedy changes the host, so no test runs it.
    const Diagnosis broken = diagnose({"--lcm-url", kUrl + "&recv_buf_size=1073741823"});
    check_only_wrong(broken, {"buffer"});
    CHECK(broken.mend("buffer") == "sysctl -w net.core.rmem_max=1073741823");
  });
}

TEST_CASE("a packet filter that drops is named, and the suggested command repairs it") {
  in_network_of_its_own([] {
    if (!shell("nft list ruleset > /dev/null 2>&1")) {
      MESSAGE("skipped: there is no nft");
      return;
    }
    join_network();
    REQUIRE(shell("nft add table inet guard"));
    REQUIRE(
        shell("nft 'add chain inet guard in { type filter hook input priority 0; policy drop; }'"));
    const Diagnosis broken = diagnose();
    check_only_wrong(broken, {"firewall", "self-test"});
    CHECK(broken.text("firewall").find("inet guard in: policy drop") != std::string::npos);
    REQUIRE(shell(broken.mend("firewall")));
    check_well(diagnose());
  });
}

TEST_CASE("packets with ttl 0 from another machine do not arrive, with ttl 1 they do") {
  in_network_of_its_own([] {
    join_network();
    BackgroundWork silent(on_other_machine("far_end", service("puck-arm", kUrlThisHost)));
    CHECK(diagnose().text("services").find("no STATUS of any service") != std::string::npos);
    REQUIRE(ip("link delete cable"));
    silent.stop();

    join_network();
    const BackgroundWork heard(on_other_machine("far_end", service("puck-arm", kUrl)));
    // Time enough for the other machine to answer, also on a busy one.
    const Diagnosis diagnosis = diagnose({"--lcm-url", kUrl}, "3");
    check_well(diagnosis);
    CHECK(diagnosis.text("services").find("puck-arm on ") != std::string::npos);
    CHECK(diagnosis.text("services").find("(10.9.8.2)") != std::string::npos);
    // It answered our pings.
    CHECK(diagnosis.text("clocks").find("(10.9.8.2) is ") != std::string::npos);
    CHECK(diagnosis.text("clocks").find(", to within ") != std::string::npos);
  });
}

TEST_CASE("ttl 0 beside other machines is reported, and the suggested URL repairs it") {
  in_network_of_its_own([] {
    join_network();
    const BackgroundWork there(on_other_machine("far_end", service("puck-tracker", kUrl)));
    const Diagnosis ours = diagnose({"--lcm-url", kUrlThisHost});
    check_only_wrong(ours, {"ttl"});
    CHECK(ours.text("ttl").find("10.9.8.2 is heard") != std::string::npos);
    check_well(diagnose({"--lcm-url", argument_of(ours.mend("ttl"), "--lcm-url")}));

    // The doctor checks the right bus, but a service here is not on it.
    const BackgroundWork here(service("puck-arm", kUrlThisHost));
    const Diagnosis theirs = diagnose();
    check_only_wrong(theirs, {"ttl"});
    CHECK(theirs.text("ttl").find("(pid " + std::to_string(getpid()) + ")") != std::string::npos);
    CHECK(argument_of(theirs.mend("ttl"), "--lcm-url") == kUrl);
  });
}

TEST_CASE("two services of a kind are reported, and the doctor disturbs neither") {
  in_network_of_its_own([] {
    join_network();
    const BackgroundWork there(on_other_machine("far_end", service("puck-arm", kUrl)));
    TransportCounters network;
    ChannelCounters statuses;
    BackgroundWork here(service("puck-arm", kUrl, [&](const Bus& bus) {
      network = bus.network_counters();
      statuses = bus.counters(Channel::kStatus);
    }));
    const Diagnosis broken = diagnose();
    check_only_wrong(broken, {"services"});
    CHECK(broken.text("services").find("two services of one kind") != std::string::npos);
    CHECK(broken.mend("services").find("kill " + std::to_string(getpid())) != std::string::npos);
    here.stop();
    CHECK(statuses.arrivals.received > 0);
    CHECK(statuses.rejected == 0);
    CHECK(network.malformed == 0);
    CHECK(network.foreign == 0);
  });
}

TEST_CASE("an intruder on another machine is named, and the suggested command blocks it") {
  in_network_of_its_own([] {
    if (!shell("iptables -S > /dev/null 2>&1")) {
      MESSAGE("skipped: there is no iptables");
      return;
    }
    join_network();
    const BackgroundWork there(on_other_machine("far_end", intruder(kUrl)));
    const Diagnosis broken = diagnose();
    CHECK(broken.exit_code == 1);
    const std::string text = broken.text("senders");
    for (const char* part : {"10.9.8.2:", "not LCM", "broken", "rejected", "larger than"}) {
      CAPTURE(part);
      CHECK(text.find(part) != std::string::npos);
    }
    // In the order of the sender's ports; for messages that are too large there is another.
    REQUIRE(shell(broken.mend("senders", "iptables")));
    check_well(diagnose());
  });
}

TEST_CASE("a deaf liblcm logger is named, and the suggested command ends it") {
  if (!shell("command -v lcm-logger > /dev/null")) {
    MESSAGE("skipped: there is no lcm-logger");
    return;
  }
  in_network_of_its_own([] {
    join_network();
    const TemporaryFolder folder;
    ChildProcess logger({"lcm-logger", "--lcm-url=" + kUrl, (folder / "log").string()},
                        {.output = folder / "output", .errors = folder / "errors"});
    const auto listens = [] {
      return diagnose().text("port").find("lcm-logger") != std::string::npos;
    };
    for (int i = 0; i < 50 && !listens(); ++i) {
    }
    check_well(diagnose());
    REQUIRE(ip("link delete cable"));
    join_network();
    const Diagnosis broken = diagnose();
    check_only_wrong(broken, {"membership"});
    CHECK(broken.mend("membership") == "kill " + std::to_string(logger.pid()));
    REQUIRE(shell(broken.mend("membership")));
    REQUIRE(logger.wait_for(std::chrono::seconds(10)).has_value());
    check_well(diagnose());
  });
}

TEST_CASE("a wrong command line ends with 2 and a reason") {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--lcm-url", "http://x"},
        {"--lcm-url", "memq://"},
        {"--prefix", "lower"},
        {"--set", "camera.packet_byte=5"},
        {"--config", "/no/such/file"},
        {"--seconds", "nan"},
        {"--no-such-option"}}) {
    CAPTURE(arguments.front());
    const Finished finished = run_doctor(arguments);
    CHECK(finished.exit_code == 2);
    CHECK_FALSE(finished.errors.empty());
  }
  CHECK(run_doctor({"--help"}).exit_code == 0);
}

}  // namespace puck
