#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/bench/live/live_system.h"

namespace puck {

/// A recording for the camera.
struct Recording {
  std::filesystem::path file;
  std::string name;
};

/// The densest real recording in the folder `recordings`; where there is none, the simulated one.
Recording dense_recording(const std::filesystem::path& recordings, const Recording& simulated);

/// Writes a game on the simulated table, seen by a camera whose head moves (about 1 Mev/s), to
/// `folder`. Throws std::runtime_error.
Recording simulate_game(const LiveSetup& setup, const std::filesystem::path& folder);

/// Writes a scene in which nothing moves to `folder`: a puck glides in and comes to rest, meanwhile
/// and for `seconds` afterwards 10,000 events a second come from pixels at random.
Recording write_still_scene(const LiveSetup& setup, const std::filesystem::path& folder,
                            double seconds);

/// Time at which the puck of that scene comes to rest, s.
inline constexpr double kStillSceneRests_s = 1.5;

/// Writes 2 s of a game at its own speed with so many events (tests/bench/busy_game.h) to `folder`.
Recording write_busy_game(const Recording& game, double rate_mev_s,
                          const std::filesystem::path& folder);

/// Settings of a camera that plays a recording over and over, with its times stretched.
std::vector<std::string> looped_at(const Recording& recording, double rate_mev_s);

}  // namespace puck
