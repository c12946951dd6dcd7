#pragma once

#include <array>

#include "common/vision/hypotheses/evidence.h"

namespace puck {

/// One of EvidenceParams' numbers: its name in a file, the range in which it makes sense, and what
/// it is.
struct EvidenceNumber {
  const char* name = nullptr;
  double EvidenceParams::*value = nullptr;
  double lowest = 0;
  double highest = 0;
  const char* meaning = nullptr;
};

inline constexpr std::array<EvidenceNumber, 15> kEvidenceNumbers{{
    {"place_puck", &EvidenceParams::place_puck, 1e-3, 1e5, "place, puck: concentration"},
    {"place_puck_lift", &EvidenceParams::place_puck_lift, -10, 10,
     "log odds of ring over inside, above those of their areas"},
    {"place_puck_outside", &EvidenceParams::place_puck_outside, -10, 10,
     "log odds of outside over inside, above those of their areas"},
    {"place_other", &EvidenceParams::place_other, 1e-3, 1e5, "place, anything else: concentration"},
    {"place_other_lift", &EvidenceParams::place_other_lift, -10, 10,
     "log odds of ring over inside, likewise"},
    {"place_other_outside", &EvidenceParams::place_other_outside, -10, 10,
     "log odds of outside over inside, likewise"},
    {"sector_puck", &EvidenceParams::sector_puck, 1e-3, 1e5, "sectors, puck: concentration"},
    {"sector_puck_even", &EvidenceParams::sector_puck_even, 1e-3, 1,
     "share that is spread evenly, not by the area that is swept"},
    {"sector_other", &EvidenceParams::sector_other, 1e-3, 1e5,
     "sectors, anything else: concentration"},
    {"sector_other_even", &EvidenceParams::sector_other_even, 1e-3, 1,
     "share that is spread evenly"},
    {"sign_puck", &EvidenceParams::sign_puck, 1e-3, 1e3,
     "sign, puck: concentration of dark and of bright each"},
    {"sign_other", &EvidenceParams::sign_other, 1e-3, 1e3,
     "sign, anything else: concentration of each"},
    {"place_worth", &EvidenceParams::place_worth, 0, 10, "worth of a nat of place"},
    {"sector_worth", &EvidenceParams::sector_worth, 0, 10, "worth of a nat of sector"},
    {"sign_worth", &EvidenceParams::sign_worth, 0, 10, "worth of a nat of sign"},
}};

}  // namespace puck
