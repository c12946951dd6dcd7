// puck-test-board: a YARP name server and a control board, to try puck-arm's back end `yarp`
// without a robot, and to see what it does when the board fails.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <map>
#include <thread>

#include <CLI/CLI.hpp>

#include "tests/support/board_posture.h"
#include "tests/support/test_board.h"

namespace {

volatile std::sig_atomic_t stopped = 0;

void print(const puck::TestBoard& board) {
  for (const double deg : board.encoders()) std::printf("%8.2f", deg);
  std::printf("  set-points %lld\n", static_cast<long long>(board.set_points()));
  std::fflush(stdout);
}

void run(const puck::TestBoardParams& params, const std::string& joint_table,
         const std::string& trouble, double after_s, double for_s) {
  using Clock = std::chrono::steady_clock;
  puck::TestBoard board(params);
  if (!joint_table.empty()) puck::move_to_the_middle(board, joint_table);
  std::printf("board %s/%s of %zu joints, name server on 127.0.0.1:%d\n", params.robot.c_str(),
              params.part.c_str(), params.axes, board.port());
  const auto begin = Clock::now();
  auto next = begin;
  bool is_troubled = false;
  while (stopped == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const double now_s = std::chrono::duration<double>(Clock::now() - begin).count();
    const bool should_be = now_s >= after_s && (for_s <= 0 || now_s < after_s + for_s);
    if (should_be != is_troubled) {
      is_troubled = should_be;
      board.set_trouble(should_be ? *puck::board_trouble(trouble) : puck::BoardTrouble::kNone);
      std::printf("trouble: %s\n", should_be ? trouble.c_str() : "none");
    }
    if (Clock::now() < next) continue;
    next += std::chrono::seconds(1);
    print(board);
  }
}

}  // namespace

int main(int argc, char** argv) {
  puck::TestBoardParams params;
  params.port = 10000;
  std::string joint_table;
  std::string trouble = "none";
  double after_s = 5;
  double for_s = 0;
  CLI::App app("A YARP name server and a robot's control board, without a robot.");
  app.add_option("--port", params.port, "Of the name server; 0: any")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  app.add_option("--robot", params.robot, "What its ports begin with")->capture_default_str();
  app.add_option("--part", params.part, "Of the robot")->capture_default_str();
  app.add_option("--axes", params.axes, "Joints")->check(CLI::Range(1, 64))->capture_default_str();
  app.add_option("--lowest", params.lowest_deg, "Limit of all joints, deg")->capture_default_str();
  app.add_option("--highest", params.highest_deg, "Limit of all joints, deg")
      ->capture_default_str();
  app.add_option("--joint-table", joint_table,
                 "File that arm.joint_table names: begin with its mallet in the middle of the line")
      ->check(CLI::ExistingFile);
  app.add_option("--period", params.period_ms, "Of its encoders, ms")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--trouble", trouble, "What it does wrong")
      ->check(CLI::IsMember(puck::board_trouble_names()))
      ->capture_default_str();
  app.add_option("--after", after_s, "When the trouble begins, s")->capture_default_str();
  app.add_option("--for", for_s, "How long it lasts, s; 0: to the end")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::signal(SIGINT, [](int) { stopped = 1; });
  std::signal(SIGTERM, [](int) { stopped = 1; });
  try {
    run(params, joint_table, trouble, after_s, for_s);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-test-board: %s\n", error.what());
    return 1;
  }
  return 0;
}
