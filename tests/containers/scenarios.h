#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/containers/bus_log.h"
#include "tests/containers/verdict.h"
#include "tools/demo_report/demo_figures.h"

namespace puck {

/// A game between containers, from its log.
struct GameRecord {
  BusLog log;
  DemoFigures figures;
};

/// Demands of every game: all five services published, the puck was tracked, the arm was commanded,
/// and no message but STATUS was larger than a frame.
void judge_game(const GameRecord& game, Verdict& verdict);

/// Every sent event was received, and all services ended on request.
void judge_nothing_lost(const GameRecord& game, Verdict& verdict);

/// About so many percent of the packets to the tracker were lost, and the tracker counted them.
void judge_frame_loss(const GameRecord& game, double percent, Verdict& verdict);

/// Events passed through a sufficient link, so none was lost.
void judge_narrow_link(const GameRecord& game, Verdict& verdict);

/// The tracker was killed and restarted: its second session rejoined the game, and the other
/// services had one session each.
void judge_killed_tracker(const GameRecord& game, Verdict& verdict);

/// The bridge was frozen for a while: the arm stopped, and then all continued.
void judge_frozen_bridge(const GameRecord& game, Verdict& verdict);

/// The tracker's network was cut and restored: the tracker continued, in one session.
void judge_cut_off_tracker(const GameRecord& game, Verdict& verdict);

/// Another robot played on the same network: none of its messages was accepted here.
void judge_neighbour(const GameRecord& game, Verdict& verdict);

/// Resident memory of a service.
struct MemoryUse {
  std::string service;
  std::int64_t before_kb = 0;
  std::int64_t after_kb = 0;
};
/// An intruder sent malformed messages, which every service counted; none died or grew.
void judge_intruder(const GameRecord& game, const std::vector<MemoryUse>& memory, Verdict& verdict);

/// A fresh tracker on the recorded events gives the same: `figures` compare the two.
void judge_replay(const GameRecord& game, Verdict& verdict);

}  // namespace puck
