#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/containers/bus_log.h"
#include "tests/containers/verdict.h"
#include "tools/demo_report/demo_figures.h"

namespace puck {

/// A game between containers, as its log has it.
struct GameRecord {
  BusLog log;
  DemoFigures figures;
};

/// What every game owes: all five services spoke, the puck was tracked, the arm was commanded, no
/// message but STATUS was larger than a frame.
void judge_game(const GameRecord& game, Verdict& verdict);

/// Each event that was sent was received, and all services ended when they were asked to.
void judge_nothing_lost(const GameRecord& game, Verdict& verdict);

/// About so many of the packets to the tracker were lost, and the tracker knows it.
void judge_frame_loss(const GameRecord& game, double percent, Verdict& verdict);

/// Events went through a link that carries them, so none was lost.
void judge_narrow_link(const GameRecord& game, Verdict& verdict);

/// The tracker was killed and started again: its second life is part of the game, and the other
/// services have lived one life.
void judge_killed_tracker(const GameRecord& game, Verdict& verdict);

/// The bridge stood still for a while: so did the arm, and then all went on.
void judge_frozen_bridge(const GameRecord& game, Verdict& verdict);

/// The tracker's network went away and came back: so did the tracker, in one life.
void judge_cut_off_tracker(const GameRecord& game, Verdict& verdict);

/// Another robot played on the same network: nothing of it was taken for this one's.
void judge_neighbour(const GameRecord& game, Verdict& verdict);

/// Resident memory of a service.
struct MemoryUse {
  std::string service;
  std::int64_t before_kb = 0;
  std::int64_t after_kb = 0;
};
/// Somebody sent malformed messages, which every service counted; nobody died of it or grew.
void judge_intruder(const GameRecord& game, const std::vector<MemoryUse>& memory, Verdict& verdict);

/// A fresh tracker was fed with the recorded events and sees the same: `figures` compare the two.
void judge_replay(const GameRecord& game, Verdict& verdict);

}  // namespace puck
