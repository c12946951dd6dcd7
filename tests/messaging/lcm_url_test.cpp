#include "common/messaging/lcm_url.h"

#include <string>

#include <doctest/doctest.h>

#include "common/messaging/bus_error.h"
#include "common/messaging/channels.h"

namespace puck {
namespace {

std::string problem_with(const std::string& url) {
  try {
    parse_lcm_url(url);
    return {};
  } catch (const BusError& error) {
    return error.what();
  }
}

std::string problem_with_prefix(const std::string& prefix) {
  try {
    check_prefix(prefix);
    return {};
  } catch (const BusError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("an LCM URL is parsed and composed again") {
  const LcmUrl url = parse_lcm_url("udpm://239.1.2.3:7668?ttl=1&recv_buf_size=4096");
  CHECK(url.group == "239.1.2.3");
  CHECK(url.port == 7668);
  CHECK(url.ttl == 1);
  CHECK(url.recv_buf_size == 4096);
  CHECK(url.to_string() == "udpm://239.1.2.3:7668?ttl=1&recv_buf_size=4096");
  CHECK(parse_lcm_url(kDefaultLcmUrl).to_string() == kDefaultLcmUrl);
}

TEST_CASE("parts missing from an LCM URL take LCM's defaults") {
  CHECK(parse_lcm_url("udpm://").to_string() == "udpm://239.255.76.67:7667?ttl=0");
  CHECK(parse_lcm_url("udpm://:9000").to_string() == "udpm://239.255.76.67:9000?ttl=0");
  CHECK(parse_lcm_url("udpm://239.0.0.1").to_string() == "udpm://239.0.0.1:7667?ttl=0");
  CHECK(parse_lcm_url("memq://").in_memory);
}

TEST_CASE("a malformed LCM URL is refused with one line that gives the expected form") {
  CHECK(problem_with("239.255.76.67:7667").find("must begin with udpm://") != std::string::npos);
  CHECK(problem_with("") ==
        "lcm.url \"\": must begin with udpm://, as in "
        "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304");
  CHECK(problem_with("udpm://192.168.0.1:7667") ==
        "lcm.url \"udpm://192.168.0.1:7667\": the address must be a multicast group, 224.0.0.0 to "
        "239.255.255.255, got \"192.168.0.1\"");
  CHECK(problem_with("udpm://host:7667").find("got \"host\"") != std::string::npos);
  CHECK(problem_with("udpm://:0").find("the port must be 1 to 65535, got \"0\"") !=
        std::string::npos);
  CHECK(problem_with("udpm://:65536").find("the port must be") != std::string::npos);
  CHECK(problem_with("udpm://:76x").find("the port must be") != std::string::npos);
  CHECK(problem_with("udpm://:").find("the port must be") != std::string::npos);
  CHECK(problem_with("udpm://:7667?ttl=256").find("ttl must be 0 to 255") != std::string::npos);
  CHECK(problem_with("udpm://:7667?ttl").find("ttl must be 0 to 255, got \"\"") !=
        std::string::npos);
  CHECK(problem_with("udpm://:7667?recv_buf_size=1").find("recv_buf_size must be 2048") !=
        std::string::npos);
  CHECK(problem_with("udpm://:7667?tll=1") ==
        "lcm.url \"udpm://:7667?tll=1\": unknown option \"tll\"; expected ttl or recv_buf_size");
  CHECK(problem_with("udpm://239.255.76.67:7667\n").find("the port must be") != std::string::npos);
}

TEST_CASE("a prefix has up to 16 capitals, digits and underscores") {
  CHECK(problem_with_prefix("").empty());
  CHECK(problem_with_prefix("LEFT_EYE_2").empty());
  CHECK(problem_with_prefix("ABCDEFGHIJKLMNOP").empty());
  CHECK(problem_with_prefix("ABCDEFGHIJKLMNOPQ") ==
        "lcm.prefix must be up to 16 of A-Z, 0-9 and _, got \"ABCDEFGHIJKLMNOPQ\"");
  CHECK(!problem_with_prefix("left").empty());
  CHECK(!problem_with_prefix("A.*").empty());
}

TEST_CASE("channels are named with their prefix and found by their name") {
  CHECK(channel_name(Channel::kEvents, "") == "PUCK_EVENTS");
  CHECK(channel_name(Channel::kArmCommand, "LEFT") == "LEFT_PUCK_ARM_COMMAND");
  CHECK(find_channel("LEFT_PUCK_EVENTS", "LEFT") == Channel::kEvents);
  CHECK(find_channel("PUCK_EVENTS", "LEFT") == std::nullopt);
  CHECK(find_channel("PUCK_STATUS", "") == Channel::kStatus);
  CHECK(find_channel("PUCK_STATUS2", "") == std::nullopt);
}

}  // namespace puck
