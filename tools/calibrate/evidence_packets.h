#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/calibration/evidence_fit.h"
#include "common/io/event_reader.h"

namespace puck {

/// A recording to learn from.
struct EvidenceSource {
  std::filesystem::path recording;
  std::filesystem::path truth;
  std::filesystem::path size_model;
  /// What happens between rows of truth farther apart is not known.
  std::int64_t truth_gap_us = 10'000;
  /// There are other things that look exactly like the puck: only packets of the puck count.
  bool has_lookalikes = false;
};

struct EvidencePackets {
  std::vector<LabelledPacket> packets;
  std::size_t left_out = 0;    ///< Of which nobody knows whether they are of the puck.
  std::size_t wrong_wall = 0;  ///< On the puck, but of the wrong assumption about its side wall.
};

/// Runs the tracker over a recording in search of all that resembles the puck, and labels each
/// packet of events by truth. `file` is for what a recording's header may lack; the sensor's size
/// may also come from the size model. Throws an exception that names the unusable file and the
/// reason, or std::invalid_argument when no packet is of the puck.
EvidencePackets collect_evidence(const EvidenceSource& source, EventFileOptions file);

}  // namespace puck
