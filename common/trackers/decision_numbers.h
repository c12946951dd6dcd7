#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "common/vision/hypotheses/decision_params.h"

namespace puck {

/// One of DecisionParams' numbers by its name, to see how much depends on it.
struct DecisionNumber {
  const char* name = nullptr;
  /// Multiplies it; whole numbers are rounded.
  void (*scale)(DecisionParams& params, double factor) = nullptr;
};

/// Multiplies the number that `MEMBER` points to.
template <auto MEMBER>
void scale_decision(DecisionParams& params, double factor) {
  if constexpr (requires { params.*MEMBER; }) {
    auto& number = params.*MEMBER;
    if constexpr (std::is_integral_v<std::remove_reference_t<decltype(number)>>) {
      number = static_cast<std::remove_reference_t<decltype(number)>>(
          std::llround(static_cast<double>(number) * factor));
    } else {
      number *= factor;
    }
  } else {
    params.rates.*MEMBER *= factor;
  }
}

inline constexpr std::array<DecisionNumber, 38> kDecisionNumbers{{
    {"packet_events", scale_decision<&DecisionParams::packet_events>},
    {"packet_s", scale_decision<&DecisionParams::packet_s>},
    {"settled_us", scale_decision<&DecisionParams::settled_us>},
    {"silent_us", scale_decision<&DecisionParams::silent_us>},
    {"resting_us", scale_decision<&DecisionParams::resting_us>},
    {"most_nats", scale_decision<&DecisionParams::most_nats>},
    {"confirm", scale_decision<&DecisionParams::confirm>},
    {"replace", scale_decision<&DecisionParams::replace>},
    {"lose_odds", scale_decision<&DecisionParams::lose_odds>},
    {"sure", scale_decision<&DecisionParams::sure>},
    {"manoeuvre_nats", scale_decision<&DecisionParams::manoeuvre_nats>},
    {"manoeuvre_us", scale_decision<&DecisionParams::manoeuvre_us>},
    {"manoeuvre_px_s", scale_decision<&DecisionParams::manoeuvre_px_s>},
    {"found_px_s", scale_decision<&DecisionParams::found_px_s>},
    {"reach_px", scale_decision<&DecisionParams::reach_px>},
    {"reach_px_s", scale_decision<&DecisionParams::reach_px_s>},
    {"found", scale_decision<&DecisionParams::found>},
    {"found_per_score", scale_decision<&DecisionParams::found_per_score>},
    {"mark_odds", scale_decision<&DecisionParams::mark_odds>},
    {"mark_odds_each", scale_decision<&DecisionParams::mark_odds_each>},
    {"newcomer_odds", scale_decision<&DecisionParams::newcomer_odds>},
    {"newcomer_s", scale_decision<&DecisionParams::newcomer_s>},
    {"scene_cells", scale_decision<&DecisionParams::scene_cells>},
    {"still_sigma", scale_decision<&DecisionParams::still_sigma>},
    {"slip", scale_decision<&DecisionParams::slip>},
    {"lost_px", scale_decision<&DecisionParams::lost_px>},
    {"lost_px_s", scale_decision<&DecisionParams::lost_px_s>},
    {"gate_sigma", scale_decision<&DecisionParams::gate_sigma>},
    {"gate_px", scale_decision<&DecisionParams::gate_px>},
    {"lag_sigma_s", scale_decision<&DecisionParams::lag_sigma_s>},
    {"place_sigma_px", scale_decision<&DecisionParams::place_sigma_px>},
    {"hide", scale_decision<&BeliefRates::hide>},
    {"show", scale_decision<&BeliefRates::show>},
    {"leave", scale_decision<&BeliefRates::leave>},
    {"leave_silent", scale_decision<&BeliefRates::leave_silent>},
    {"leave_hidden", scale_decision<&BeliefRates::leave_hidden>},
    {"elsewhere", scale_decision<&BeliefRates::elsewhere>},
    {"come", scale_decision<&BeliefRates::come>},
}};

}  // namespace puck
