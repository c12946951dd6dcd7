#pragma once

#include "tools/play/error_fit.h"
#include "tools/play/estimate_errors.h"
#include "tools/play/play_setup.h"
#include "tools/play/save_figures.h"
#include "tools/play/shot_facts.h"

namespace puck {

/// The errors that PUCK makes on events, and what a game is with them and with the model of them.
struct ErrorModelCheck {
  EstimateErrorParams fitted;
  SaveFigures on_events;
  SaveFigures on_model;  ///< The setup's, not the one that was fitted just now.
};

/// The errors of the setup's tracker in one shot.
FlightErrors watch_flight(const PlaySetup& setup, const ShotFacts& facts);

/// Plays single shots of the setup on events and on the model. `count` shots in `jobs` threads.
ErrorModelCheck check_error_model(PlaySetup setup, std::int64_t seed, int count, int jobs);

/// For a person, to stdout.
void print(const ErrorModelCheck& check);

}  // namespace puck
