#pragma once

#include "tools/play/error_fit.h"
#include "tools/play/estimate_errors.h"
#include "tools/play/play_setup.h"
#include "tools/play/save_figures.h"
#include "tools/play/shot_facts.h"

namespace puck {

/// PUCK's errors on events, and the saves with them and with the model of them.
struct ErrorModelCheck {
  EstimateErrorParams fitted;
  SaveFigures on_events;
  SaveFigures on_model;  ///< With the setup's model, not the new fit.
};

/// The errors of the setup's tracker in one shot.
FlightErrors watch_flight(const PlaySetup& setup, const ShotFacts& facts);

/// Plays `count` single shots of the setup on events and on the model, in `jobs` threads.
ErrorModelCheck check_error_model(PlaySetup setup, std::int64_t seed, int count, int jobs);

/// Prints to stdout, for people.
void print(const ErrorModelCheck& check);

}  // namespace puck
