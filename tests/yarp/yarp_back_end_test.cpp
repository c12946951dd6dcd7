#include "common/yarp/yarp_back_end.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "common/yarp/text_connection.h"
#include "tests/support/test_board.h"
#include "tests/support/wait_until.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

std::int64_t now_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// Long time limits for the board, short intervals between attempts.
YarpParams params_for(const TestBoard& board, std::vector<int> joints = {0, 1, 2, 3, 4, 5, 6}) {
  YarpParams params;
  params.port = board.port();
  params.lowest_deg.assign(joints.size(), -80);
  params.highest_deg.assign(joints.size(), 80);
  params.joints = std::move(joints);
  params.silent_ms = 1000;
  params.answer_timeout_ms = 5000;
  params.connect_timeout_ms = 5000;
  params.check_modes_ms = 20;
  params.retry_ms = 10;
  return params;
}

JointAngles all(double deg, std::size_t joints = 7) {
  return JointAngles(std::vector<double>(joints, deg));
}

// The part of an arm's loop that uses the back end.
class Loop {
 public:
  explicit Loop(const YarpParams& params) : back_end(params) {}

  std::string fault() { return back_end.fault(now_us()); }
  std::optional<JointReading> reading() { return back_end.reading(now_us()); }
  YarpCounters counters() const { return back_end.board_counters(now_us()); }
  bool is_connected() {
    return wait_until([&] { return reading().has_value(); });
  }
  void command(const JointAngles& set_point) {
    ++commands_;
    back_end.command(set_point, now_us());
  }
  // Until no set-point is under way; not across a lost connection.
  bool settles() {
    return wait_until([&] {
      const YarpCounters now = counters();
      return now.set_points_sent + now.set_points_replaced + now.set_points_refused +
                 now.set_points_unheard + now.set_points_withdrawn + now.set_points_expired ==
             commands_;
    });
  }
  // Moves there in steps, at the rate of the encoders.
  bool moves_to(double deg) {
    return wait_until([&] {
      fault();
      const auto now = reading();
      if (!now) return false;
      JointAngles next = now->position;
      bool is_there = true;
      for (std::size_t i = 0; i < next.size(); ++i) {
        is_there = is_there && std::abs(next[i] - deg) < 1e-9;
        next[i] += std::clamp(deg - next[i], -1.9, 1.9);
      }
      command(next);
      return is_there;
    });
  }
  // Like a loop that ignores the answers.
  bool insists_until(const JointAngles& set_point, const std::function<bool()>& condition) {
    return wait_until([&] {
      command(set_point);
      return condition();
    });
  }
  bool fails_with(
      const std::string& part_of_reason, const std::function<void()>& meanwhile = [] {}) {
    std::string last;
    const bool fails = wait_until([&] {
      // Before the first connection it is no fault, but the awaited condition.
      std::string reason = fault();
      if (reason.empty()) reason = back_end.awaited();
      if (!reason.empty()) last = reason;
      if (reason.find(part_of_reason) != std::string::npos) return true;
      meanwhile();
      return false;
    });
    INFO(last);
    CHECK(fails);
    return fails;
  }
  // Commanded once, and again only after it expired because the board's thread was delayed.
  bool is_refused(const JointAngles& set_point, const std::string& part_of_reason) {
    std::int64_t expired = counters().set_points_expired;
    command(set_point);
    return fails_with(part_of_reason, [&] {
      const std::int64_t expired_now = counters().set_points_expired;
      if (std::exchange(expired, expired_now) < expired_now) command(set_point);
    });
  }

  YarpBackEnd back_end;

 private:
  std::int64_t commands_ = 0;
};

// A board's failure, and the beginning of the fault's text.
struct BoardFailure {
  BoardTrouble trouble;
  const char* reason;
};

// With the failures that are the same from the beginning and in a game.
std::vector<BoardFailure> with_lasting(std::vector<BoardFailure> failures) {
  const std::vector<BoardFailure> lasting{
      {BoardTrouble::kRequestsGarbage, "rpc:i: it sent a line that is not text"},
      {BoardTrouble::kRequestsClose, "rpc:i: "},
      {BoardTrouble::kCommandClose, "command:i: "},
      {BoardTrouble::kStateClose, "state:o: "},
      {BoardTrouble::kStateNan, "state:o: the encoder of joint 6 is not a finite number"},
      {BoardTrouble::kStateTruncated, "state:o: it sent a list of encoders of an impossible size"},
      {BoardTrouble::kStateHuge, "state:o: it sent an invalid message"},
      {BoardTrouble::kStateGarbage, "state:o: it sent an invalid message"},
      {BoardTrouble::kStateStampless, "state:o: it sends encoders without a stamp"}};
  failures.insert(failures.end(), lasting.begin(), lasting.end());
  return failures;
}

}  // namespace

TEST_CASE("The back end finds the board, takes its joints and moves them") {
  TestBoard board;
  board.move_joint(3, 7);
  Loop loop(params_for(board));
  REQUIRE(loop.is_connected());
  CHECK(loop.reading()->position[3] == 7);
  CHECK(loop.moves_to(15));
  CHECK(board.modes() == std::vector<std::string>(7, "posd"));
  CHECK(board.encoders() == std::vector<double>(7, 15));
  CHECK(loop.fault().empty());
  const YarpCounters counters = loop.counters();
  CHECK(counters.connections == 1);
  CHECK(counters.failures == 0);
  CHECK(wait_until([&] { return board.set_points() == loop.counters().set_points_sent; }));
  CHECK(counters.set_points_refused == 0);
  CHECK(counters.encoders_received > 5);
  CHECK(counters.round_trip_us > 0);
  CHECK(counters.encoder_age_us.has_value());
  CHECK(board.unreadable() == 0);
}

TEST_CASE("The back end drives some joints of a part and leaves the others alone") {
  TestBoard board({.axes = 16});
  for (std::size_t i = 0; i < 16; ++i) board.move_joint(i, static_cast<double>(i));
  Loop loop(params_for(board, {1, 5}));
  REQUIRE(loop.is_connected());
  CHECK(loop.reading()->position[1] == 5);
  CHECK(loop.moves_to(-20));
  const auto encoders = board.encoders();
  CHECK(encoders[1] == -20);
  CHECK(encoders[5] == -20);
  CHECK(encoders[2] == 2);
  CHECK(encoders[15] == 15);
  CHECK(board.modes()[1] == "posd");
  CHECK(board.modes()[2] == "pos");
  CHECK(board.unreadable() == 0);
}

TEST_CASE("The back end understands a board that sends single bytes") {
  TestBoard board;
  board.set_trouble(BoardTrouble::kByteAtATime);
  Loop loop(params_for(board));
  CHECK(loop.moves_to(4));
  CHECK(loop.counters().failures == 0);
}

TEST_CASE("The back end waits for late answers within its time limit") {
  TestBoard board({.late_ms = 5});
  board.set_trouble(BoardTrouble::kRequestsLate);
  Loop loop(params_for(board));
  CHECK(loop.moves_to(4));
  CHECK(loop.counters().failures == 0);
  CHECK(loop.counters().round_trip_us >= 5000);

  TestBoard later({.late_ms = 1'000'000});
  later.set_trouble(BoardTrouble::kRequestsLate);
  YarpParams impatient = params_for(later);
  impatient.answer_timeout_ms = 20;
  Loop other(impatient);
  other.fails_with("/icub/right_arm/rpc:i: no answer in time, asked \"get axes\"");
}

TEST_CASE("An arm that stands still is no fault") {
  TestBoard board({.period_ms = 2});
  YarpParams params = params_for(board);
  Loop loop(params);
  REQUIRE(loop.is_connected());
  const auto enough = loop.counters().encoders_received + 100;
  std::string fault;
  CHECK(wait_until([&] {
    fault += loop.fault();
    return loop.counters().encoders_received > enough;
  }));
  CHECK(fault.empty());
  CHECK(loop.counters().failures == 0);
}

TEST_CASE("Every failure of the name server is a fault with its reason, and ends by itself") {
  for (const BoardFailure& each :
       {BoardFailure{BoardTrouble::kNamesMute, "the name server: no answer in time"},
        BoardFailure{
            BoardTrouble::kNamesUnknown,
            "the name server: there is no port /icub/right_arm/rpc:i: is the robot running?"},
        BoardFailure{BoardTrouble::kNamesGarbage,
                     "the name server: it sent a line that is not text"},
        BoardFailure{BoardTrouble::kNamesNoAddress, "which is not an address"}}) {
    CAPTURE(each.reason);
    TestBoard board;
    board.set_trouble(each.trouble);
    YarpParams params = params_for(board);
    params.answer_timeout_ms = 300;
    Loop loop(params);
    loop.fails_with(each.reason);
    CHECK(!loop.reading());
    board.set_trouble(BoardTrouble::kNone);
    CHECK(loop.moves_to(3));
  }
}

TEST_CASE("A board that fails from the beginning is a fault with its reason, and is never moved") {
  for (const BoardFailure& each : with_lasting(
           {{BoardTrouble::kRequestsFail, "rpc:i: it refused \"get axes\" with [fail]"},
            {BoardTrouble::kRequestsNak, "rpc:i: it refused \"get axes\" with [nak]"},
            {BoardTrouble::kRequestsMute, "rpc:i: no answer in time, asked \"get axes\""},
            {BoardTrouble::kRequestsEndless, "rpc:i: it sent a line without an end"},
            {BoardTrouble::kRequestsDrip, "rpc:i: no answer in time"},
            {BoardTrouble::kHelloWrong, "state:o: it does not answer in the binary carrier"},
            {BoardTrouble::kStateFrozen, "state:o: its stamp stands still"},
            {BoardTrouble::kStateMute, "state:o: no answer in time"}})) {
    CAPTURE(each.reason);
    TestBoard board;
    board.set_trouble(each.trouble);
    YarpParams params = params_for(board);
    params.answer_timeout_ms = 300;
    Loop loop(params);
    loop.fails_with(each.reason);
    CHECK(board.set_points() == 0);
    CHECK(board.encoders() == std::vector<double>(7, 0));
  }
}

TEST_CASE("A board that fails in a game is a fault with its reason, and is reconnected") {
  for (const BoardFailure& each : with_lasting(
           {{BoardTrouble::kRequestsFail, "rpc:i: it refused \"get icmd cmds\" with [fail]"},
            {BoardTrouble::kRequestsMute, "rpc:i: no answer in time, asked \"get icmd cmds\""},
            {BoardTrouble::kModeLost,
             "rpc:i: joint 0 \"joint0\" is in mode \"hwf\", not in \"posd\""},
            {BoardTrouble::kAxesChange, "state:o: it sent the encoders of 6 joints: there were 7"},
            {BoardTrouble::kStateFrozen, "state:o: its stamp stands still for 1000 ms"},
            {BoardTrouble::kStateMute, "state:o: no encoders for 1000 ms"}})) {
    CAPTURE(each.reason);
    TestBoard board;
    YarpParams params = params_for(board);
    params.answer_timeout_ms = 2000;
    Loop loop(params);
    REQUIRE(loop.moves_to(5));
    board.set_trouble(each.trouble);
    loop.fails_with(each.reason);
    CHECK(board.encoders() == std::vector<double>(7, 5));
    CHECK(wait_until([&] { return !loop.reading() || loop.counters().connections > 1; }));
    board.set_trouble(BoardTrouble::kNone);
    // As the robot's own tools do.
    if (each.trouble == BoardTrouble::kModeLost) board.put_into_mode("pos");
    CHECK(loop.moves_to(8));
    CHECK(loop.counters().failures > 0);
  }
}

TEST_CASE("A connection only reads until the first set-point, and a refused one takes no joints") {
  TestBoard board;
  {
    Loop loop(params_for(board));
    REQUIRE(loop.is_connected());
    const auto enough = loop.counters().encoders_received + 5;
    CHECK(wait_until([&] { return loop.counters().encoders_received > enough; }));
    loop.is_refused(all(2.5),
                    "the set-point of joint 0, 2.5 deg, does not begin at its encoder, 0 deg");
    CHECK(loop.counters().failures == 0);
  }
  CHECK(wait_until([&] { return board.connections() == 0; }));
  CHECK(board.mode_requests() == 0);
}

TEST_CASE("An emergency stop lasts until set-points are sent again") {
  TestBoard board;
  {
    Loop loop(params_for(board));
    REQUIRE(loop.moves_to(5));
    const std::int64_t requests = board.mode_requests();
    CHECK(requests == 7);
    board.set_trouble(BoardTrouble::kModeLost);
    const auto stopped = board.modes();
    loop.fails_with("is in mode \"hwf\", not in \"posd\"");
    // The button is released: neither that nor set-points alone take a joint.
    board.set_trouble(BoardTrouble::kNone);
    loop.fails_with("a hardware fault: bring it back into mode \"pos\"");
    loop.command(all(5));
    const auto enough = loop.counters().failures + 2;
    CHECK(wait_until([&] { return loop.counters().failures > enough; }));
    CHECK(!loop.reading());
    CHECK(board.modes() == stopped);
    CHECK(board.mode_requests() == requests);
    // As the robot's own tools do: that takes no joint either.
    board.put_into_mode("pos");
    REQUIRE(loop.is_connected());
    const auto more = loop.counters().encoders_received + 5;
    CHECK(wait_until([&] { return loop.counters().encoders_received > more; }));
    CHECK(board.modes() == std::vector<std::string>(7, "pos"));
    CHECK(board.mode_requests() == requests);
    // As a controller does after a reset.
    CHECK(loop.moves_to(8));
    CHECK(board.modes() == std::vector<std::string>(7, "posd"));
    CHECK(board.mode_requests() == requests + 7);
    board.set_trouble(BoardTrouble::kModeLost);
    loop.fails_with("is in mode \"hwf\", not in \"posd\"");
  }
  CHECK(wait_until([&] { return board.connections() == 0; }));
  CHECK(board.modes()[0] == "hwf");
  CHECK(board.mode_requests() == 14);
}

TEST_CASE("Joints that do not change their mode are a fault, and are never moved") {
  TestBoard board;
  board.set_trouble(BoardTrouble::kModesStay);
  Loop loop(params_for(board));
  REQUIRE(loop.is_connected());
  CHECK(loop.insists_until(all(1), [&] {
    return loop.fault().find("is in mode \"pos\", not in \"posd\"") != std::string::npos;
  }));
  CHECK(board.set_points() == 0);
}

TEST_CASE("Joints that move while they are taken are not moved back") {
  TestBoard board;
  board.set_trouble(BoardTrouble::kModesStay);
  Loop loop(params_for(board));
  REQUIRE(loop.is_connected());
  REQUIRE(loop.insists_until(all(1), [&] { return board.mode_requests() == 7; }));
  // The first one sags during its change of mode.
  board.move_joint(0, 20);
  REQUIRE(loop.insists_until(all(1),
                             [&] { return loop.reading() && loop.reading()->position[0] == 20; }));
  board.set_trouble(BoardTrouble::kNone);
  board.put_into_mode("posd");
  CHECK(loop.insists_until(all(1), [&] {
    return loop.fault().find(
               "the set-point of joint 0, 1 deg, does not begin at its encoder, 20 deg") !=
           std::string::npos;
  }));
  CHECK(board.set_points() == 0);
}

TEST_CASE("A set-point expires with its loop's silence while joints are taken") {
  for (const bool withdraws : {false, true}) {
    CAPTURE(withdraws);
    bool was_in_time = false;
    for (int attempt = 0; attempt < 10 && !was_in_time; ++attempt) {
      TestBoard board({.late_ms = 40});
      YarpParams params = params_for(board);
      Loop loop(params);
      REQUIRE(loop.is_connected());
      board.set_trouble(BoardTrouble::kRequestsLate);
      REQUIRE(loop.insists_until(all(1), [&] { return board.mode_requests() > 0; }));
      if (withdraws) loop.back_end.withdraw();
      // A delayed thread may have been silent for too long before it withdrew: repeat then.
      was_in_time = !withdraws || loop.counters().set_points_expired == 0;
      if (!was_in_time) continue;
      const auto later = loop.counters().encoders_received + 30;
      REQUIRE(wait_until([&] { return loop.counters().encoders_received > later; }));
      // The last joints were no longer wanted.
      CHECK(board.mode_requests() < 7);
      CHECK(board.set_points() == 0);
      const YarpCounters counters = loop.counters();
      CHECK((counters.set_points_withdrawn > 0) == withdraws);
      CHECK((counters.set_points_expired > 0) == !withdraws);
      board.set_trouble(BoardTrouble::kNone);
      CHECK(loop.moves_to(5));
      CHECK(loop.fault().empty());
    }
    CHECK(was_in_time);
  }
}

TEST_CASE("Delayed set-points do not make the arm jump") {
  TestBoard board;
  Loop loop(params_for(board));
  REQUIRE(loop.moves_to(5));
  REQUIRE(loop.settles());
  loop.is_refused(all(10.5), "joint 0, 10.5 deg, is too far from the one before, 5 deg");
  CHECK(board.encoders() == std::vector<double>(7, 5));
  CHECK(loop.counters().connections == 1);
  CHECK(loop.moves_to(8));
}

TEST_CASE(
    "A board that reads no set-points is a fault, and the newest set-point replaces the others") {
  TestBoard board;
  YarpParams params = params_for(board);
  params.silent_ms = 150;
  Loop loop(params);
  REQUIRE(loop.moves_to(5));
  board.set_trouble(BoardTrouble::kCommandDeaf);
  std::string reason;
  CHECK(wait_until([&] {
    loop.reading();
    for (int i = 0; i < 100; ++i) loop.command(all(5));
    reason = loop.fault();
    return reason.find("command:i: it takes no set-points for 150 ms") != std::string::npos;
  }));
  CHECK(loop.counters().set_points_replaced > 0);
}

TEST_CASE("A board that dies and restarts at another address is found again") {
  TestBoard board;
  Loop loop(params_for(board));
  REQUIRE(loop.moves_to(5));
  board.die();
  loop.fails_with("Connection refused");
  CHECK(!loop.reading());
  board.revive();
  CHECK(loop.moves_to(7));
}

TEST_CASE("Nothing is sent after a failure until the loop restarts at the encoders") {
  TestBoard board;
  Loop loop(params_for(board));
  REQUIRE(loop.moves_to(5));
  board.die();
  loop.fails_with("Connection refused");
  // Meanwhile a person moved the arm.
  for (std::size_t i = 0; i < 7; ++i) board.move_joint(i, 40);
  board.revive();
  REQUIRE(wait_until([&] {
    loop.command(all(5));
    return loop.counters().connections == 2;
  }));
  loop.command(all(5));
  CHECK(loop.reading()->position[0] == 40);
  while (!loop.fault().empty()) {
  }
  const auto before = loop.counters().set_points_sent;
  // A loop that continues its old trajectory.
  loop.is_refused(all(5.5),
                  "the set-point of joint 0, 5.5 deg, does not begin at its encoder, 40 deg");
  CHECK(loop.counters().set_points_sent == before);
  CHECK(board.encoders() == std::vector<double>(7, 40));
  CHECK(loop.counters().set_points_refused == 1);
  CHECK(loop.moves_to(38));
}

TEST_CASE(
    "Set-points that are not finite, outside the limits or of other joints never leave the host") {
  TestBoard board;
  Loop loop(params_for(board));
  REQUIRE(loop.moves_to(5));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::int64_t refused = 0;
  for (const JointAngles& wrong : {all(nan), all(std::numeric_limits<double>::infinity()),
                                   all(80.01), all(-1e300), all(5, 6)}) {
    CHECK(loop.fault().empty());
    loop.reading();
    REQUIRE(loop.settles());
    const auto before = loop.counters().set_points_sent;
    loop.is_refused(wrong, "set-point of ");
    CHECK(loop.counters().set_points_refused == ++refused);
    CHECK(loop.counters().set_points_sent == before);
    CHECK(loop.moves_to(5 + static_cast<double>(refused)));
  }
  CHECK(wait_until([&] { return board.set_points() == loop.counters().set_points_sent; }));
  CHECK(loop.counters().connections == 1);
}

TEST_CASE("A board that starts later, and then calibrates, is waited for and left alone") {
  TestBoard board;
  board.die();
  Loop loop(params_for(board));
  CHECK(wait_until([&] { return !loop.back_end.awaited().empty(); }));
  CHECK(loop.fault().empty());
  CHECK(!loop.reading());
  board.revive();
  board.put_into_mode("cal");
  CHECK(wait_until([&] {
    return loop.back_end.awaited().find("is not ready yet: it is in mode \"cal\"") !=
           std::string::npos;
  }));
  CHECK(loop.fault().empty());
  CHECK(board.mode_requests() == 0);
  board.put_into_mode("pos");
  REQUIRE(loop.is_connected());
  CHECK(loop.fault().empty());
  CHECK(loop.moves_to(5));
}

TEST_CASE("Joints that leave position mode before they are taken are waited for, and not taken") {
  for (const char* mode : {"cal", "cald", "cfgy", "velo", "idl", "unheard"}) {
    // With the request of the first set-point, and with those before it at short intervals.
    for (const int check_modes_ms : {10'000, 10}) {
      CAPTURE(mode);
      CAPTURE(check_modes_ms);
      TestBoard board;
      YarpParams params = params_for(board);
      params.check_modes_ms = check_modes_ms;
      Loop loop(params);
      REQUIRE(loop.is_connected());
      board.put_into_mode(mode);
      std::string faults;
      CHECK(wait_until([&] {
        faults += loop.fault();
        loop.reading();
        loop.command(all(0));
        return loop.back_end.awaited().find(
                   "joint 0 \"joint0\" is not ready yet: it is in mode \"" + std::string(mode)) !=
               std::string::npos;
      }));
      CHECK(!loop.reading());
      CHECK(faults.empty());
      CHECK(board.mode_requests() == 0);
      CHECK(board.set_points() == 0);
      board.put_into_mode("pos");
      CHECK(loop.moves_to(5));
    }
  }
}

// With any answer under way, joints that another program puts into `cal` are not taken.
void check_not_taken_from_cal(TestBoard& board, Loop& loop) {
  board.put_into_mode("cal");
  CHECK(loop.insists_until(all(0), [&] {
    loop.reading();
    return !loop.back_end.awaited().empty();
  }));
  CHECK(loop.fault().empty());
  CHECK(board.mode_requests() == 0);
  CHECK(board.set_points() == 0);
}

TEST_CASE("Answers from before the joints were wanted do not allow taking them") {
  TestBoard board({.late_ms = 1000});
  YarpParams params = params_for(board);
  params.check_modes_ms = 10;
  Loop loop(params);
  REQUIRE(loop.is_connected());
  // The next answer is an old one: it gives `pos`, and comes after the first set-point.
  board.set_trouble(BoardTrouble::kRequestsLate);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  check_not_taken_from_cal(board, loop);
}

TEST_CASE("Nor do answers from before they were withdrawn and wanted again") {
  TestBoard board({.late_ms = 1000});
  YarpParams params = params_for(board);
  params.check_modes_ms = 10'000;
  Loop loop(params);
  REQUIRE(loop.is_connected());
  board.set_trouble(BoardTrouble::kRequestsLate);
  // The first set-point sends the request; its withdrawal is noticed with the next encoders.
  loop.command(all(0));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  loop.back_end.withdraw();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  check_not_taken_from_cal(board, loop);
}

TEST_CASE("A hardware fault before the first set-point is a fault, and only a person ends it") {
  for (const char* mode : {"hwf", "hwfa"}) {
    for (const bool is_from_the_start : {true, false}) {
      CAPTURE(mode);
      CAPTURE(is_from_the_start);
      TestBoard board;
      if (is_from_the_start) board.put_into_mode(mode);
      Loop loop(params_for(board));
      if (!is_from_the_start) {
        REQUIRE(loop.is_connected());
        board.put_into_mode(mode);
      }
      CHECK(wait_until([&] {
        loop.reading();
        loop.command(all(0));
        const std::string reason = loop.fault();
        return reason.find("joint 0 \"joint0\" is in mode \"" + std::string(mode)) !=
                   std::string::npos &&
               reason.find("puck-arm --reset") != std::string::npos;
      }));
      CHECK(loop.back_end.awaited().empty());
      CHECK(!loop.reading());
      CHECK(board.mode_requests() == 0);
      board.put_into_mode("pos");
      CHECK(loop.moves_to(5));
    }
  }
}

TEST_CASE("An incompatible board is a fault before the first connection, and stays one") {
  TestBoard board;
  YarpParams wide = params_for(board);
  wide.highest_deg[2] = 91;
  for (const auto& unfit :
       {std::pair{params_for(board, {0, 7}), "there is no joint 7 of arm.yarp.joints among its 7"},
        std::pair{wide,
                  "joint 2 \"joint2\" may go from -90 deg to 90 deg: our limits are wider, from "
                  "-80 deg to 91 deg"}}) {
    const std::string reason = unfit.second;
    CAPTURE(reason);
    Loop loop(unfit.first);
    std::string fault;
    CHECK(wait_until([&] { return !(fault = loop.fault()).empty(); }));
    CHECK(fault.find(reason) != std::string::npos);
    CHECK(loop.back_end.awaited().empty());
    CHECK(!loop.reading());
    CHECK(!loop.fault().empty());
  }
  CHECK(board.mode_requests() == 0);
  CHECK(board.modes() == std::vector<std::string>(7, "pos"));
}

// Whether an arm left its joints correctly, and the time that it took to end.
struct Leaving {
  bool is_right = false;
  milliseconds took{};
};

// Repeats after a delay only: an arm that ends gives its board 50 ms for all joints, and after that
// leaves the rest unchanged.
bool leaves_rightly(const std::function<Leaving()>& leave) {
  Leaving leaving = leave();
  for (int i = 0; i < 10 && !leaving.is_right && leaving.took >= milliseconds(50); ++i) {
    leaving = leave();
  }
  return leaving.is_right;
}

milliseconds time_to_end(std::optional<Loop>& loop) {
  const auto began = std::chrono::steady_clock::now();
  loop.reset();
  return std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - began);
}

TEST_CASE("An arm that ends leaves its joints in place, in position mode") {
  CHECK(leaves_rightly([] {
    TestBoard board({.axes = 8});
    std::optional<Loop> loop(std::in_place, params_for(board));
    REQUIRE(loop->moves_to(5));
    CHECK(board.modes()[6] == "posd");
    const milliseconds took = time_to_end(loop);
    const std::vector<std::string> modes = board.modes();
    CHECK(board.encoders()[0] == 5);
    CHECK(wait_until([&] { return board.connections() == 0; }));
    return Leaving{modes == std::vector<std::string>(8, "pos"), took};
  }));
}

TEST_CASE("An arm that ends does not undo an unnoticed emergency stop") {
  CHECK(leaves_rightly([] {
    TestBoard board;
    YarpParams params = params_for(board);
    params.check_modes_ms = 10'000;
    std::optional<Loop> loop(std::in_place, params);
    REQUIRE(loop->moves_to(5));
    board.set_trouble(BoardTrouble::kModeLost);
    board.set_trouble(BoardTrouble::kNone);
    const milliseconds took = time_to_end(loop);
    const std::vector<std::string> modes = board.modes();
    CHECK(modes[0] == "hwf");
    return Leaving{modes[1] == "pos", took};
  }));
}

TEST_CASE("A stop does not wait for a board, in any state of its requests") {
  constexpr int kTooLongMs = 60'000;
  const auto stops = [](BoardTrouble trouble, BoardTrouble later) {
    TestBoard board;
    board.set_trouble(trouble);
    YarpParams params = params_for(board);
    params.answer_timeout_ms = params.connect_timeout_ms = kTooLongMs;
    auto loop = std::make_unique<Loop>(params);
    if (trouble == BoardTrouble::kNone || trouble == BoardTrouble::kModesStay) {
      REQUIRE(loop->is_connected());
      REQUIRE(loop->insists_until(all(0), [&] { return board.mode_requests() == 7; }));
    } else {
      REQUIRE(wait_until([&] { return board.connections() > 0; }));
    }
    board.set_trouble(later);
    const auto begin = now_us();
    loop.reset();
    CHECK(now_us() - begin < 1000 * kTooLongMs / 2);
  };
  stops(BoardTrouble::kNamesMute, BoardTrouble::kNamesMute);
  stops(BoardTrouble::kRequestsMute, BoardTrouble::kRequestsMute);
  stops(BoardTrouble::kStateMute, BoardTrouble::kStateMute);
  stops(BoardTrouble::kModesStay, BoardTrouble::kModesStay);
  stops(BoardTrouble::kNone, BoardTrouble::kRequestsMute);
}

TEST_CASE("An unknown host ends the start with its name") {
  TestBoard board;
  YarpParams params = params_for(board);
  params.host = "no such host";
  CHECK_THROWS_WITH_AS(YarpBackEnd{params}, doctest::Contains("arm.yarp.host \"no such host\""),
                       std::invalid_argument);
  params.host = "127.0.0.1";
  params.port = 0;
  CHECK_THROWS_AS(YarpBackEnd{params}, std::invalid_argument);
}

TEST_CASE(
    "The test board drops text set-points and dies of text on its state port, like a real one") {
  TestBoard board;
  Waker waker;
  const Waiter waiter({}, waker);
  const auto in_a_while = [] { return SteadyClock::now() + std::chrono::seconds(10); };
  const PortAddress names{"127.0.0.1", static_cast<std::uint16_t>(board.port())};
  TextConnection name_server(names, "test", waiter, in_a_while());
  const auto find = [&](const std::string& name) {
    name_server.send("query " + name, waiter, in_a_while());
    const PortAddress address = parse_registration(name_server.receive(waiter, in_a_while()), name);
    name_server.receive(waiter, in_a_while());
    return address;
  };
  const PortAddress requests = find("/icub/right_arm/rpc:i");
  const PortAddress command = find("/icub/right_arm/command:i");
  const PortAddress state = find("/icub/right_arm/state:o");

  TextConnection rpc(requests, "test", waiter, in_a_while());
  rpc.send("set pos 0 nan", waiter, in_a_while());
  CHECK(rpc.receive(waiter, in_a_while()) == "[ok]");
  CHECK(std::isnan(board.encoders()[0]));

  TextConnection text(command, "test", waiter, in_a_while());
  text.send("dpos (1 2 3)", waiter, in_a_while());
  CHECK(wait_until([&] { return board.text_dropped() == 2; }));
  CHECK(board.set_points() == 0);

  CHECK_THROWS(TextConnection(state, "test", waiter, in_a_while()));
  CHECK(board.is_dead());
}

}  // namespace puck
