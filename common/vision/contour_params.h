#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace puck {

/// The components of the contour tracker, one switch each, for ablation.
struct ContourIngredients {
  /// Sizes from a disc in perspective, where calibrated, instead of Equation (2).
  bool perspective = true;
  bool shear = true;         ///< The ellipse is sheared by the table's perspective.
  bool size_state = true;    ///< The filter estimates the contour's size, too.
  bool lag = true;           ///< The sensor's lag is compensated.
  bool polarity = true;      ///< Events of the wrong sign are rejected.
  bool first_events = true;  ///< A puck of low contrast uses only first events.
  bool size_penalty = true;  ///< Too many events or too large a size lower the score.
  /// Exception at the image's sides: a puck of good contrast may be larger there, and cut off.
  bool image_sides = true;
  bool bloom = true;              ///< A bright puck may look larger.
  bool smear = true;              ///< A fast puck may look smaller.
  bool purity = true;             ///< Signs unlike those of a disc of one tone lower the score.
  bool sector_saturation = true;  ///< Each further event in one sector counts less.
  bool twins = true;              ///< A manoeuvre hypothesis at rest, for bounces.
  bool wall = true;               ///< Estimates whether the puck's side wall makes events.
  bool wall_search = true;        ///< The search uses that estimate.
  bool wall_height = true;        ///< Estimates the wall's height if not annotated.
  bool wall_edge = true;          ///< The edge between face and wall is ignored.
  /// Events inside the contour belong to the puck where the surroundings are clear: its face may
  /// have a print.
  bool face_print = true;
  bool plain_face = true;   ///< No print on a clear puck that has shown none.
  bool witness = true;      ///< A coarse blob tracker checks the position.
  bool search = true;       ///< Correlation searches near a doubtful track.
  bool wide_search = true;  ///< It searches the whole image now and then.
  bool anywhere = true;     ///< Every 5 ms while the place is unknown.
  /// Re-entry gate: a track 15 px outside the image ends, so that the search starts at once;
  /// candidates beyond the reach of a returning puck are less believed.
  bool way_back = true;
  bool afresh = true;        ///< Candidates at a poor track's own place count.
  bool fresh_search = true;  ///< The search sees only recently active edges.
  bool stopping = true;      ///< A puck without events is taken to have stopped.
  bool settling = true;      ///< A fading puck rests where it was last clear.
  /// The sensor's noise is measured, where all of its events are taken. It neither disturbs a puck
  /// at rest nor counts as a static object.
  bool noise_floor = true;
  bool holding = true;           ///< A puck at rest stays when an object comes near.
  bool left_behind = true;       ///< Occupancy test where the puck rested.
  bool background = true;        ///< Static objects under a turning head count less.
  bool early_background = true;  ///< Learned before a track becomes doubtful.
  bool clear_rings = true;       ///< Not clear rings while a faint puck is sought.
  bool faint_rests = true;       ///< Possibly faint resting pucks: search elsewhere.
  bool faint_memory = true;      ///< Remembers that a puck is faint.
  /// A moving track hypothesis replaces a track that has gone bad, or rests and never moved.
  bool overtaking = true;
  /// While the head rests, which the background tells, slow motion counts as own motion, too.
  bool slow_movers = true;
  /// While the head may turn, a new track must move with the scene or clearly by itself, unlike
  /// something that slides along an edge; where the turn is known, only a whole or very strong ring
  /// displaces a track that is not trusted.
  bool own_motion = true;
  /// A faint puck at rest under a turning head moves with the scene: it is found, and kept in it.
  /// Finding it needs own_motion, too.
  bool scene_rests = true;
  /// A trail that successive searches find, with a motion of its own, is a faint puck, even with
  /// hardly any events of its own, as beside a rail. Needs background and, to correct a track,
  /// sightings.
  bool sighting_trails = true;
  /// A candidate that both the search and its events support switches the track; one with a low
  /// search score does so less easily.
  bool recognition = true;
  bool sightings = true;     ///< A search's position corrects a poor track.
  bool at_once = true;       ///< A clear or likely puck needs few events.
  bool silent_trust = true;  ///< A few agreeing events keep a track trusted.
};

struct ContourIngredient {
  std::string_view name;
  bool ContourIngredients::*is_on = nullptr;
};

/// Names of the switches, for the ablation.
inline constexpr std::array<ContourIngredient, 45> kContourIngredients{{
    {"perspective", &ContourIngredients::perspective},
    {"shear", &ContourIngredients::shear},
    {"size-state", &ContourIngredients::size_state},
    {"lag", &ContourIngredients::lag},
    {"polarity", &ContourIngredients::polarity},
    {"first-events", &ContourIngredients::first_events},
    {"size-penalty", &ContourIngredients::size_penalty},
    {"image-sides", &ContourIngredients::image_sides},
    {"bloom", &ContourIngredients::bloom},
    {"smear", &ContourIngredients::smear},
    {"purity", &ContourIngredients::purity},
    {"sector-saturation", &ContourIngredients::sector_saturation},
    {"twins", &ContourIngredients::twins},
    {"wall", &ContourIngredients::wall},
    {"wall-edge", &ContourIngredients::wall_edge},
    {"wall-height", &ContourIngredients::wall_height},
    {"wall-search", &ContourIngredients::wall_search},
    {"face-print", &ContourIngredients::face_print},
    {"plain-face", &ContourIngredients::plain_face},
    {"witness", &ContourIngredients::witness},
    {"search", &ContourIngredients::search},
    {"wide-search", &ContourIngredients::wide_search},
    {"anywhere", &ContourIngredients::anywhere},
    {"way-back", &ContourIngredients::way_back},
    {"afresh", &ContourIngredients::afresh},
    {"fresh-search", &ContourIngredients::fresh_search},
    {"stopping", &ContourIngredients::stopping},
    {"settling", &ContourIngredients::settling},
    {"noise-floor", &ContourIngredients::noise_floor},
    {"holding", &ContourIngredients::holding},
    {"left-behind", &ContourIngredients::left_behind},
    {"background", &ContourIngredients::background},
    {"early-background", &ContourIngredients::early_background},
    {"clear-rings", &ContourIngredients::clear_rings},
    {"faint-rests", &ContourIngredients::faint_rests},
    {"faint-memory", &ContourIngredients::faint_memory},
    {"overtaking", &ContourIngredients::overtaking},
    {"slow-movers", &ContourIngredients::slow_movers},
    {"own-motion", &ContourIngredients::own_motion},
    {"scene-rests", &ContourIngredients::scene_rests},
    {"sighting-trails", &ContourIngredients::sighting_trails},
    {"recognition", &ContourIngredients::recognition},
    {"sightings", &ContourIngredients::sightings},
    {"at-once", &ContourIngredients::at_once},
    {"silent-trust", &ContourIngredients::silent_trust},
}};

}  // namespace puck
