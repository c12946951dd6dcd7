#include "common/yarp/port_reader.h"

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/contains.h"
#include "tests/support/test_board_bytes.h"
#include "tests/support/test_event_port.h"
#include "tests/support/wait_until.h"
#include "tests/yarp/wire_bytes.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

PortReaderParams params_for(int name_server) {
  return {.port = "/eye/AE:o", .server_port = name_server, .retry_ms = 10};
}

std::string port_message(long long count, const std::string& content) {
  return carrier_message({stamp_block(count, 100.0 + static_cast<double>(count)), content});
}

/// Reads until `is_done` or for 20 s, and returns the contents of the messages.
template <typename Condition>
std::vector<std::string> read_until(PortReader& reader, const Condition& is_done) {
  std::vector<std::string> contents;
  CHECK(wait_until([&] {
    if (const auto message = reader.next(milliseconds(1))) {
      contents.emplace_back(message->content.begin(), message->content.end());
    }
    return is_done();
  }));
  return contents;
}

}  // namespace

TEST_CASE("a port's messages are read, and their counts show which were lost") {
  TestEventPort camera("/eye/AE:o");
  PortReader reader(params_for(camera.name_server()));
  read_until(reader, [&] { return camera.readers() == 1; });
  CHECK(contains(reader.waiting_for(), "messages from /eye/AE:o"));
  const std::string large(300'000, 'x');
  for (const long long count : {7, 8, 11, 3, 4}) {
    camera.send(port_message(count, count == 8 ? large : std::to_string(count)));
  }
  camera.send(carrier_message({block_without_stamp(), "unstamped"}));
  const auto contents = read_until(reader, [&] { return reader.messages() == 6; });
  CHECK(contents == std::vector<std::string>{"7", large, "11", "3", "4", "unstamped"});
  CHECK(reader.messages_lost() == 2);
  CHECK(reader.connections() == 1);
  CHECK(reader.failures() == 0);
}

TEST_CASE("a port that ends and comes back is found again") {
  TestEventPort camera("/eye/AE:o");
  PortReader reader(params_for(camera.name_server()));
  for (int run = 1; run <= 3; ++run) {
    read_until(reader, [&] { return camera.readers() == 1; });
    camera.send(port_message(run, "m"));
    read_until(reader, [&] { return reader.messages() == run; });
    camera.die();
    read_until(reader, [&] { return !reader.is_connected(); });
    read_until(reader,
               [&] { return contains(reader.waiting_for(), "there is no port /eye/AE:o"); });
    camera.revive();
  }
  CHECK(reader.connections() == 3);
  // A new owner counts from anywhere.
  CHECK(reader.messages_lost() == 0);
}

TEST_CASE("garbage ends the connection, not the reader") {
  TestEventPort camera("/eye/AE:o");
  PortReader reader(params_for(camera.name_server()));
  int failures = 0;
  for (const std::string& garbage :
       {std::string("HTTP/1.1 200 OK\r\n"), carrier_message({"12345678", "x"}),
        carrier_message({"short"}), carrier_message({stamp_block(1, 1).substr(0, 8), "x"})}) {
    read_until(reader, [&] { return camera.readers() == 1; });
    camera.send(garbage);
    ++failures;
    read_until(reader, [&] { return reader.failures() == failures; });
    CHECK(contains(reader.waiting_for(), "a connection to /eye/AE:o: it sent"));
    CHECK(wait_until([&] { return camera.readers() == 0; }));
  }
  read_until(reader, [&] { return camera.readers() == 1; });
  camera.send(port_message(1, "good"));
  CHECK(read_until(reader, [&] { return reader.messages() == 1; }) ==
        std::vector<std::string>{"good"});
}

TEST_CASE("a missing name server is named, and tried again after growing pauses") {
  int port = 0;
  {
    const TestEventPort gone("/eye/AE:o");
    port = gone.name_server();
  }
  PortReader reader(params_for(port));
  const auto begin = SteadyClock::now();
  read_until(reader, [&] { return reader.failures() == 5; });
  // Pauses of 10, 20, 40 and 80 ms.
  CHECK(SteadyClock::now() - begin >= milliseconds(150));
  CHECK(reader.waiting_for() ==
        "a connection to /eye/AE:o: the name server: cannot connect to "
        "127.0.0.1:" +
            std::to_string(port) + ": Connection refused");
  TestEventPort camera("/eye/AE:o", port);
  read_until(reader, [&] { return camera.readers() == 1; });
  CHECK(reader.is_connected());
}

TEST_CASE("an interrupt ends a wait at once") {
  TestEventPort camera("/eye/AE:o");
  PortReader reader(params_for(camera.name_server()));
  read_until(reader, [&] { return camera.readers() == 1; });
  const auto begin = SteadyClock::now();
  std::jthread other([&] {
    std::this_thread::sleep_for(milliseconds(20));
    reader.interrupt();
  });
  CHECK_FALSE(reader.next(milliseconds(10'000)));
  CHECK(SteadyClock::now() - begin < milliseconds(5000));
  CHECK(reader.failures() == 0);
}

TEST_CASE("an unknown host of the name server is refused with its key") {
  PortReaderParams params = params_for(10'000);
  params.server_host = "no such host";
  params.server_key = "camera.yarp_server";
  CHECK_THROWS_WITH_AS(PortReader{params},
                       doctest::Contains("camera.yarp_server \"no such host\" cannot be found"),
                       std::invalid_argument);
}

}  // namespace puck
