#include "tools/spy/spy_view.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/spy/spy_bench.h"
#include "tests/support/random_message.h"

namespace puck {
namespace {

/// A game's snapshot: every channel, and five services.
Snapshot game() {
  SpyBench spy;
  std::mt19937_64 random(1);
  for (const Channel channel : kAllChannels) {
    if (channel == Channel::kStatus) continue;
    spy.hear_bytes(std::string(base_name(channel)), random_message(channel, random).bytes, 900'000);
  }
  std::int64_t session = 1;
  for (const char* service :
       {"puck-camera", "puck-tracker", "puck-bridge", "puck-arm", "puck-logger"}) {
    service_status_t status = status_of(service);
    status.counter_name = {"packets_received", "packets_lost"};
    status.counter_value = {12, 3};
    status.latency_name = {"backlog", "packet_to_estimate"};
    status.latency_p50_us = {1, 75};
    status.latency_p99_us = {2, 671};
    status.latency_max_us = {3, 24'111};
    status.latency_samples = {500, 500};
    spy.hear(status, session++, 0, 950'000);
  }
  return spy.model.snapshot(1'000'000);
}

std::vector<std::string> text_of(const Screen& screen) {
  std::vector<std::string> lines;
  for (const ScreenLine& line : screen) lines.push_back(line.text);
  return lines;
}

bool has(const Screen& screen, const std::string& text) {
  return std::any_of(screen.begin(), screen.end(), [&](const ScreenLine& line) {
    return line.text.find(text) != std::string::npos;
  });
}

using Cells = std::vector<std::string>;

/// The cells with text of the line that begins with this word.
Cells cells_of(const Screen& screen, const std::string& word) {
  for (const ScreenLine& line : screen) {
    std::istringstream words(line.text);
    const Cells cells{std::istream_iterator<std::string>(words), {}};
    if (!cells.empty() && cells.front() == word) return cells;
  }
  return {};
}

std::string selected(const Screen& screen) {
  for (const ScreenLine& line : screen) {
    if (line.selected) return line.text.substr(2, line.text.find(' ', 2) - 2);
  }
  return {};
}

SpyView view_on(Snapshot snapshot) {
  SpyView view("239.255.76.67:7667 ttl 0");
  view.show(std::move(snapshot));
  return view;
}

}  // namespace

TEST_CASE("every page fills a screen of any size exactly, without text beyond its edge") {
  for (const SpyKey page : {SpyKey::kFirst, SpyKey::kShow, SpyKey::kHelp}) {
    for (const int columns : {0, 1, 7, 59, 60, 80, 100, 160, 300}) {
      for (const int rows : {0, 1, 2, 3, 4, 5, 15, 24, 50, 100}) {
        SpyView view = view_on(game());
        view.press(page);
        const Screen screen = view.draw({columns, rows});
        CHECK(screen.size() == static_cast<std::size_t>(rows));
        for (const ScreenLine& line : screen) {
          CHECK(line.text.size() == static_cast<std::size_t>(columns));
        }
      }
    }
  }
}

TEST_CASE("the smallest screen shows the channels and services, with the most important columns") {
  SpyView view = view_on(game());
  const Screen screen = view.draw({60, 15});
  CHECK(text_of(screen)[0].starts_with("puck-spy  239.255.76.67:7667 ttl 0"));
  CHECK(has(screen, "MSG/S   B/S  LOST"));
  CHECK(has(screen, "PUCK_EVENTS"));
  CHECK(has(screen, "1-7 of 10"));
  CHECK(has(screen, "1-4 of 5"));
  CHECK(has(screen, "puck-arm     running"));
  CHECK(has(screen, "75/671/24111"));
  CHECK(has(screen, "q quit  enter show  s sort  r reverse  p pause  h help"));
}

TEST_CASE("a large screen shows all channels, all services and all columns") {
  SpyView view = view_on(game());
  const Screen screen = view.draw({160, 50});
  for (const Channel channel : kAllChannels) CHECK(has(screen, std::string(base_name(channel))));
  for (const char* title :
       {"MSG/S", "EV/S", "RECVD", "LATE", "DUP", "BAD", "RUNS", "AGE", "FROM", "SERVICE", "STATE",
        "UP", "PID", "HOST", "VERSION", "STATE TEXT", "us p50/p99/max", "COUNTERS"}) {
    CHECK_MESSAGE(has(screen, title), title);
  }
  CHECK(has(screen, "5 services"));
  CHECK(has(view.draw({200, 50}), "packets_lost 3, packets_received 12"));
}

TEST_CASE("the selection moves through channels and services, and stays visible") {
  SpyView view = view_on(game());
  const ScreenSize small{60, 15};
  CHECK(selected(view.draw(small)) == "PUCK_EVENTS");
  view.press(SpyKey::kUp);
  CHECK(selected(view.draw(small)) == "PUCK_EVENTS");
  for (int i = 0; i < 9; ++i) view.press(SpyKey::kDown);
  CHECK(selected(view.draw(small)) == "PUCK_STATUS");
  view.press(SpyKey::kDown);
  CHECK(selected(view.draw(small)) == "puck-arm");
  view.press(SpyKey::kLast);
  CHECK(selected(view.draw(small)) == "puck-tracker");
  view.press(SpyKey::kDown);
  CHECK(selected(view.draw(small)) == "puck-tracker");
  for (int i = 0; i < 2; ++i) view.press(SpyKey::kPageUp);
  CHECK(selected(view.draw(small)) == "PUCK_EVENTS");
  for (int i = 0; i < 2; ++i) view.press(SpyKey::kPageDown);
  CHECK(selected(view.draw(small)) == "puck-tracker");
  view.press(SpyKey::kFirst);
  CHECK(selected(view.draw(small)) == "PUCK_EVENTS");
}

TEST_CASE("the selection stays with its channel when rows are added or move") {
  SpyBench spy;
  spy.hear(head_state_t{}, 7, 0, 1000);
  SpyView view = view_on(spy.model.snapshot(2000));
  CHECK(selected(view.draw({80, 24})) == "PUCK_HEAD");
  spy.hear(packet_of(1), 7, 0, 3000);
  view.show(spy.model.snapshot(4000));
  CHECK(selected(view.draw({80, 24})) == "PUCK_HEAD");
  CHECK(text_of(view.draw({80, 24}))[2].substr(2, 11) == "PUCK_EVENTS");
}

TEST_CASE("the channels are sorted by the selected column, and reversed") {
  SpyBench spy;
  spy.hear(packet_of(500), 7, 0, 1000);
  for (int i = 0; i < 3; ++i) spy.hear(head_state_t{}, 7, i, 1000);
  SpyView view = view_on(spy.model.snapshot(1'000'000));
  const auto first = [&] { return text_of(view.draw({80, 24}))[2].substr(2, 11); };
  CHECK(first() == "PUCK_EVENTS");
  view.press(SpyKey::kSort);
  CHECK(has(view.draw({80, 24}), "sorted by msg/s"));
  CHECK(first() == "PUCK_HEAD  ");
  view.press(SpyKey::kSort);
  CHECK(has(view.draw({80, 24}), "sorted by B/s"));
  CHECK(first() == "PUCK_EVENTS");
  view.press(SpyKey::kReverse);
  CHECK(has(view.draw({80, 24}), "sorted by B/s reversed"));
  CHECK(first() == "PUCK_HEAD  ");
  view.press(SpyKey::kReverse);
  CHECK(first() == "PUCK_EVENTS");
}

TEST_CASE("a paused view is constant, and shows the newest values again afterwards") {
  SpyBench spy;
  spy.hear(head_state_t{}, 7, 0, 1000);
  SpyView view = view_on(spy.model.snapshot(2000));
  view.press(SpyKey::kPause);
  spy.hear(packet_of(1), 7, 0, 3000);
  view.show(spy.model.snapshot(4000));
  CHECK(has(view.draw({80, 24}), "PAUSED"));
  CHECK_FALSE(has(view.draw({80, 24}), "PUCK_EVENTS"));
  view.press(SpyKey::kPause);
  view.show(spy.model.snapshot(5000));
  CHECK_FALSE(has(view.draw({80, 24}), "PAUSED"));
  CHECK(has(view.draw({80, 24}), "PUCK_EVENTS"));
}

TEST_CASE("a channel's live page has its publishers and its newest message, below if it fits") {
  SpyBench spy;
  head_state_t head{};
  head.yaw_deg = 12.5;
  spy.hear(head, 7, 3, 1000);
  spy.hear_bytes("PUCK_HEAD", {1}, 1500);
  SpyView view = view_on(spy.model.snapshot(2000));
  view.press(SpyKey::kShow);
  const Screen screen = view.draw({80, 40});
  CHECK(has(screen, "head_state_t, 88 bytes"));
  CHECK(has(screen, "yaw_deg                  12.5"));
  CHECK(has(screen, "seq                      3"));
  CHECK(has(screen, "no STATUS"));
  CHECK(has(screen, "last bad message         head_state_t is cut off before its fingerprint"));
  head.yaw_deg = -4;
  spy.hear(head, 7, 4, 3000);
  view.show(spy.model.snapshot(4000));
  CHECK(has(view.draw({80, 40}), "yaw_deg                  -4"));
  view.press(SpyKey::kBack);
  CHECK(has(view.draw({80, 24}), "yaw_deg"));
  CHECK_FALSE(has(view.draw({80, 12}), "yaw_deg"));
}

TEST_CASE("states, modes and phases are shown by name") {
  SpyBench spy;
  puck_estimate_t estimate{};
  estimate.state = puck_estimate_t::STATE_LOST;
  spy.hear(estimate, 7, 0, 1000);
  SpyView view = view_on(spy.model.snapshot(2000));
  view.press(SpyKey::kShow);
  CHECK(has(view.draw({80, 60}), "state                    lost"));
}

TEST_CASE("a page longer than the screen scrolls to its last line and no further") {
  SpyView view = view_on(game());
  view.press(SpyKey::kDown);
  view.press(SpyKey::kShow);
  const ScreenSize small{60, 15};
  CHECK_FALSE(has(view.draw(small), "events_dropped"));
  CHECK(has(view.draw(small), "1-13 of "));
  view.press(SpyKey::kPageDown);
  CHECK(has(view.draw(small), "14-26 of "));
  view.press(SpyKey::kLast);
  CHECK(text_of(view.draw(small))[13].starts_with("events_dropped"));
  view.press(SpyKey::kDown);
  CHECK(text_of(view.draw(small))[13].starts_with("events_dropped"));
  view.press(SpyKey::kUp);
  CHECK_FALSE(has(view.draw(small), "events_dropped"));
  view.press(SpyKey::kFirst);
  CHECK(has(view.draw(small), "1-13 of "));
}

TEST_CASE("the events of a packet are shown as events") {
  SpyBench spy;
  spy.hear(packet_of(300), 7, 0, 1000);
  SpyView view = view_on(spy.model.snapshot(2000));
  view.press(SpyKey::kShow);
  const Screen screen = view.draw({80, 400});
  CHECK(has(screen, "event[0]                 +0 us  x 3  y 4  brighter"));
  CHECK(has(screen, "event[255]"));
  CHECK_FALSE(has(screen, "event[256]"));
  CHECK(has(screen, "... and 44 more events"));
}

TEST_CASE("counters left out by a service are shown before its good ones") {
  SpyBench spy;
  service_status_t status = status_of("puck-tracker");
  status.counter_name = {"packets_received", "counters_left_out"};
  status.counter_value = {12, 3};
  spy.hear(status, 1, 0, 950'000);
  SpyView view = view_on(spy.model.snapshot(1'000'000));
  CHECK(has(view.draw({200, 50}), "counters_left_out 3, packets_received 12"));
}

TEST_CASE("a service is shown with its words in full, its latencies and all counters") {
  SpyBench spy;
  service_status_t status = status_of("puck-logger");
  status.state = service_status_t::STATE_DEGRADED;
  status.state_text = "nothing more is written: " + std::string(100, 'x') + " the end";
  status.counter_name = {"messages_written", "messages_not_written"};
  status.counter_value = {1'234'567, 0};
  status.latency_name = {"to_disk", "never_measured"};
  status.latency_p50_us = {10, 0};
  status.latency_p99_us = {20, 0};
  status.latency_max_us = {30, 0};
  status.latency_samples = {40, 0};
  spy.hear(status, 7, 0, 1000);
  SpyView view = view_on(spy.model.snapshot(2000));
  view.press(SpyKey::kDown);
  view.press(SpyKey::kShow);
  const Screen screen = view.draw({60, 40});
  CHECK(has(screen, "the end"));
  CHECK(has(screen, "messages_written         1234567"));
  CHECK(has(screen, "messages_not_written     0"));
  CHECK(cells_of(screen, "to_disk") == Cells{"to_disk", "10", "20", "30", "40"});
  CHECK(cells_of(screen, "never_measured") == Cells{"never_measured", "0"});
  CHECK(has(screen, "! puck-logger  degraded"));
}

TEST_CASE("simultaneous publishers and a silent service are marked, and drawn as an alarm") {
  SpyBench spy;
  spy.hear(status_of("puck-tracker", "one", 11), 7, 0, 0);
  spy.hear(status_of("puck-tracker", "two", 12), 8, 0, 900'000);
  for (int i = 0; i < 3; ++i) {
    spy.hear(puck_estimate_t{}, 7, i, 900'000 + 2 * i);
    spy.hear(puck_estimate_t{}, 8, i, 900'001 + 2 * i);
  }
  SpyView view = view_on(spy.model.snapshot(1'000'000));
  const Screen screen = view.draw({160, 24});
  CHECK(screen[2].text.starts_with("!  PUCK_ESTIMATE"));
  CHECK(has(screen, "2 AT ONCE, puck-tracker 11 one, puck-tracker 12 two"));
  CHECK(screen[2].style == LineStyle::kAlarm);
  CHECK(screen[6].text.starts_with("!  puck-tracker  silent"));
  CHECK(screen[6].style == LineStyle::kAlarm);
  CHECK(screen[7].text.starts_with("   puck-tracker  running"));
}

TEST_CASE("a silent bus is reported with the expected prefix and group") {
  SpyView view = view_on({});
  view.set_notice("no multicast route");
  CHECK(has(view.draw({60, 15}), "no message received yet"));
  CHECK(has(view.draw({60, 15}), "no multicast route"));
  view.press(SpyKey::kShow);
  view.press(SpyKey::kDown);
  CHECK(has(view.draw({60, 15}), "no message received yet"));
}

TEST_CASE("messages without our key are shown if there are no others") {
  SpyBench spy;
  spy.model.set_unauthenticated(Channel::kGame, 5, "is not sealed, from 10.9.8.2:40000", 1'000'000);
  SpyView view = view_on(spy.model.snapshot(1'000'000));
  CHECK_FALSE(has(view.draw({160, 24}), "no message received yet"));
  CHECK(has(view.draw({160, 24}), "PUCK_GAME"));
  view.press(SpyKey::kShow);
  CHECK(has(view.draw({160, 24}), "is not sealed, from 10.9.8.2:40000"));
}

TEST_CASE("foreign datagrams at the port are counted in a line, and shown on a page of their own") {
  Snapshot snapshot = game();
  snapshot.network.foreign = 12;
  snapshot.network.foreign_traffic = {{"channel \"RIGHT_PUCK_EVENTS\"", {0xac120003, 40'000}, 11},
                                      {"a fragment", {}, 1}};
  SpyView view = view_on(snapshot);
  for (const ScreenSize size : {ScreenSize{60, 15}, ScreenSize{80, 24}, ScreenSize{160, 50}}) {
    CHECK(has(view.draw(size), "12 foreign datagrams (press o)"));
    CHECK(has(view.draw(size), "puck-camera"));
  }
  view.press(SpyKey::kOthers);
  const Screen screen = view.draw({80, 24});
  CHECK(has(screen, "channel \"RIGHT_PUCK_EVENTS\""));
  CHECK(has(screen, "172.18.0.3:40000"));
  CHECK(has(screen, "a fragment"));
  view.press(SpyKey::kShow);
  CHECK(has(view.draw({80, 24}), "PUCK_EVENTS"));

  Snapshot silent;
  silent.network = snapshot.network;
  CHECK(has(view_on(silent).draw({80, 24}), "12 foreign datagrams"));
}

TEST_CASE("the first line counts all marked rows, even those outside the screen") {
  CHECK_FALSE(has(view_on(game()).draw({60, 15}), "!"));
  Snapshot snapshot = game();
  snapshot.channels[8].in_trouble = true;
  snapshot.services[4].silent = true;
  CHECK(text_of(view_on(snapshot).draw({60, 15}))[0].find(" !2 ") != std::string::npos);
}

TEST_CASE("a selected channel stays after it falls silent, and the view returns") {
  SpyBench spy;
  spy.hear(status_of("puck-arm"), 7, 0, 0);
  SpyView view = view_on(spy.model.snapshot(1000));
  view.press(SpyKey::kLast);
  view.press(SpyKey::kShow);
  view.show(spy.model.snapshot(120'000'000));
  CHECK(has(view.draw({80, 24}), "it is no longer received"));
  view.press(SpyKey::kBack);
  view.show(spy.model.snapshot(120'000'000));
  CHECK(selected(view.draw({80, 24})) == "PUCK_STATUS");
}

TEST_CASE("every type of message can be shown at any width") {
  std::mt19937_64 random(2);
  for (const Channel channel : kAllChannels) {
    for (int i = 0; i < 20; ++i) {
      SpyBench spy;
      spy.hear_bytes(std::string(base_name(channel)), random_message(channel, random).bytes, 1000);
      SpyView view = view_on(spy.model.snapshot(2000));
      view.press(SpyKey::kShow);
      for (const int columns : {1, 30, 60, 160}) {
        CHECK(view.draw({columns, 24}).size() == 24);
        view.press(SpyKey::kLast);
      }
    }
  }
}

}  // namespace puck
