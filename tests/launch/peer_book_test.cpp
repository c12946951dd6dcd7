#include "services/launch/peer_book.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace puck {
namespace {

/// Services with a STATUS every 100 ms, and a puck-tracker that checks them every 20 ms.
class PeerBench {
 public:
  struct Speaker {
    std::int64_t session = 0;
    std::string service;
    std::string host;
    std::int32_t pid = 0;
    bool speaks = true;
    bool answers = true;
  };

  explicit PeerBench(std::vector<Speaker> those) : speakers(std::move(those)) {
    book.need({"puck-camera"});
  }

  void pass(std::int64_t us) {
    for (const std::int64_t end_us = now_us + us; now_us < end_us;) {
      now_us += 20'000;
      if (now_us % 100'000 == 0) {
        for (const Speaker& speaker : speakers) {
          if (speaker.speaks) say(speaker, ServiceState::kRunning);
        }
      }
      look();
    }
  }
  void say(const Speaker& speaker, ServiceState state) {
    book.hear({speaker.session, speaker.service, speaker.host, speaker.pid, state}, speaker.answers,
              now_us);
  }
  void look() {
    for (const PeerNews& item : book.look(now_us)) news.push_back(item.text);
  }

  std::int64_t now_us = 1'000'000'000;
  std::vector<Speaker> speakers;
  PeerBook book{"puck-tracker"};
  std::vector<std::string> news;
};

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("silence of a needed service is reported within 500 ms, once, and so is its return") {
  PeerBench bench({{1, "puck-camera", "eye", 11}, {2, "puck-arm", "robot", 12}});
  bench.pass(1'000'000);
  CHECK(bench.news.empty());
  CHECK(bench.book.trouble().silent.empty());

  bench.speakers[0].speaks = false;
  bench.pass(300'000);
  CHECK(bench.news.empty());
  bench.pass(200'000);
  CHECK(bench.news == Texts{"puck-camera on eye, pid 11, is silent"});
  bench.pass(60'000'000);
  CHECK(bench.news.size() == 1);
  CHECK(bench.book.trouble().silent == "puck-camera on eye, pid 11, is silent");

  bench.speakers[0].speaks = true;
  bench.pass(200'000);
  CHECK(bench.news.back() == "puck-camera on eye, pid 11, is heard again");
  CHECK(bench.book.trouble().silent.empty());
  CHECK(bench.news.size() == 2);
}

TEST_CASE("services that are not needed, or not heard yet, are not missed") {
  PeerBench bench({{2, "puck-arm", "robot", 12}});
  bench.pass(1'000'000);
  bench.speakers[0].speaks = false;
  bench.pass(5'000'000);
  CHECK(bench.news.empty());
  CHECK(bench.book.trouble().silent.empty());
}

TEST_CASE("a service's stop is reported at once, and so is its successor") {
  PeerBench bench({{1, "puck-camera", "eye", 11}});
  bench.pass(1'000'000);
  bench.say(bench.speakers[0], ServiceState::kStopping);
  bench.speakers.clear();
  bench.look();
  CHECK(bench.news == Texts{"puck-camera on eye, pid 11, has stopped"});
  bench.pass(1'000'000);
  bench.speakers.push_back({3, "puck-camera", "eye", 13});
  bench.pass(200'000);
  CHECK(bench.news.back() == "puck-camera on eye, pid 13, is heard again");
  CHECK(bench.book.trouble().silent.empty());
}

TEST_CASE("a service killed and restarted at once is neither silent nor duplicated") {
  PeerBench bench({{1, "puck-camera", "eye", 11}});
  bench.pass(1'000'000);
  bench.speakers[0] = {3, "puck-camera", "eye", 13};
  bench.pass(2'000'000);
  CHECK(bench.news.empty());
  CHECK(bench.book.trouble().twice.empty());
}

TEST_CASE("two services of a kind are reported once, by host and pid, while both publish") {
  PeerBench bench({{1, "puck-camera", "eye", 11}, {2, "puck-arm", "robot", 12}});
  bench.pass(1'000'000);
  bench.speakers.push_back({3, "puck-camera", "lab", 13});
  bench.pass(500'000);
  const std::string both =
      "two services of one kind: puck-camera on eye, pid 11, and puck-camera on lab, pid 13";
  CHECK(bench.news == Texts{both});
  CHECK(bench.book.trouble().twice == both);
  CHECK(bench.book.name_of(3) == "puck-camera on lab, pid 13");
  bench.pass(5'000'000);
  CHECK(bench.news.size() == 1);
  bench.say(bench.speakers[2], ServiceState::kStopping);
  bench.speakers[2].speaks = false;
  bench.pass(1'000'000);
  CHECK(bench.book.trouble().twice.empty());
  CHECK(bench.book.trouble().silent.empty());
  CHECK(bench.news == Texts{both, "every service is unique again"});
}

TEST_CASE("another service of this service's kind is reported; two loggers are allowed") {
  PeerBench bench({{1, "puck-tracker", "lab", 11},
                   {2, "puck-logger", "lab", 12},
                   {3, "puck-logger", "eye", 13}});
  bench.pass(1'000'000);
  CHECK(bench.news == Texts{"a second service of this kind is running: puck-tracker on lab, "
                            "pid 11"});
}

TEST_CASE("a peer that does not answer is ignored: a replayed log contains no services") {
  PeerBench bench({{1, "puck-camera", "eye", 11}, {3, "puck-camera", "past", 13, true, false}});
  bench.pass(1'000'000);
  CHECK(bench.news.empty());
  bench.speakers[0].speaks = false;
  bench.pass(1'000'000);
  CHECK(bench.book.trouble().silent == "puck-camera on eye, pid 11, is silent");
  CHECK(bench.book.name_of(31) == "session 31");
}

TEST_CASE("silence during a pause of this service itself is not reported") {
  PeerBench bench({{1, "puck-camera", "eye", 11}});
  bench.pass(1'000'000);
  bench.now_us += 3'000'000;
  bench.look();
  CHECK(bench.news.empty());
  bench.pass(1'000'000);
  CHECK(bench.news.empty());
}

TEST_CASE("a flood of services takes no more than 64 places") {
  PeerBench bench({{1, "puck-camera", "eye", 11}});
  bench.pass(1'000'000);
  for (int i = 0; i < 20'000; ++i) {
    bench.say({1000 + i, "puck-x", "h", i}, ServiceState::kRunning);
    bench.now_us += 10;
    if (i % 30 == 0) bench.say(bench.speakers[0], ServiceState::kRunning);
  }
  CHECK(bench.book.peers().size() == 64);
  CHECK(bench.book.name_of(1) == "puck-camera on eye, pid 11");
}

}  // namespace puck
