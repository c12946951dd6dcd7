// The robot plays with a control board behind puck-arm, as with a real one, and stops when the
// board fails.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/board_posture.h"
#include "tests/support/test_board.h"
#include "tests/system/running_game.h"

namespace puck {
namespace {

const std::string kJointTable = "config/calibration/simulated_arm.toml";

// The board is a thread of this process, and a busy machine delays it longer than a real board ever
// is. So the arm has its longest time limits, and is slow, so that it does not move far meanwhile.
std::vector<std::string> settings_for(const TestBoard& board) {
  return {"arm.back_end=yarp",
          "arm.yarp.port=" + std::to_string(board.port()),
          "arm.joint_table=" + kJointTable,
          "arm.allow_unauthenticated=true",
          "arm.max_speed_m_s=0.3",
          "arm.max_encoder_age_ms=1000",
          "arm.max_tracking_error_deg=90",
          "arm.yarp.silent_ms=1000",
          "arm.yarp.answer_timeout_ms=2000",
          "arm.yarp.max_step_deg=10"};
}

bool moves(RunningGame& game) {
  game.take_arm_span_m();
  return game.until([&, span_m = 0.0]() mutable {
    game.listen(std::chrono::milliseconds(100));
    span_m = std::max(span_m, game.take_arm_span_m());
    return span_m > 0.02;
  });
}

}  // namespace

TEST_CASE("A control board plays, stops on a fault, and plays after a reset") {
  // An iCub's arm, a part that also contains the hand's joints.
  constexpr std::size_t kArmJoints = 7;
  TestBoard board({.axes = 16});
  move_to_the_middle(board, source_folder() / kJointTable);
  for (std::size_t joint = kArmJoints; joint < 16; ++joint) board.move_joint(joint, 30);
  RunningGame game(new_lcm_url());
  for (const char* name : {"puck-tracker", "puck-bridge"}) game.start(name);
  game.start("puck-arm", settings_for(board));
  game.start("puck-camera");
  REQUIRE(game.until([&] { return game.plays(); }));
  CHECK(game.arm()->back_end == "yarp");
  CHECK(moves(game));
  CHECK(board.set_points() > 100);
  CHECK(board.unreadable() == 0);
  const std::vector<std::string> modes = board.modes();
  const std::vector<double> encoders = board.encoders();
  for (std::size_t joint = 0; joint < modes.size(); ++joint) {
    CAPTURE(joint);
    CHECK(modes[joint] == (joint < kArmJoints ? "posd" : "pos"));
    if (joint >= kArmJoints) CHECK(encoders[joint] == 30);
  }

  board.set_trouble(BoardTrouble::kStateFrozen);
  REQUIRE(game.until([&] { return game.arm()->state == arm_state_t::STATE_FAULT; }));
  CHECK(game.arm()->reason.find("stamp") != std::string::npos);
  game.listen(std::chrono::milliseconds(100));
  const std::int64_t sent = board.set_points();
  game.listen(std::chrono::milliseconds(500));
  CHECK(board.set_points() == sent);

  // The operator permits the restart, not the board.
  const std::int64_t mode_requests = board.mode_requests();
  board.set_trouble(BoardTrouble::kNone);
  REQUIRE(game.until([&] { return game.counter("puck-arm", "board_connections") > 1; }));
  game.listen(std::chrono::milliseconds(200));
  CHECK(game.arm()->state == arm_state_t::STATE_FAULT);
  CHECK(board.mode_requests() == mode_requests);
  const std::vector<std::string> reset = {program("puck-arm"), "--lcm-url", game.url(), "--reset"};
  CHECK(run_program(reset, {.folder = source_folder()}).exit_code == 0);
  REQUIRE(game.until([&] { return game.arm()->state != arm_state_t::STATE_FAULT; }));
  CHECK(moves(game));
  CHECK(board.set_points() > sent);
  CHECK(board.mode_requests() > mode_requests);
}

}  // namespace puck
