#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace puck {

/// What the contour tracker is made of, one switch an ingredient, so that each can be taken away
/// to see what it brings.
struct ContourIngredients {
  /// Sizes are those of a disc in perspective, where the calibration knows it, not Equation (2).
  bool perspective = true;
  bool shear = true;         ///< The ellipse is sheared as the table's perspective asks.
  bool size_state = true;    ///< The filter follows the contour's size, not only its place.
  bool lag = true;           ///< Events are put forward by the sensor's lag.
  bool polarity = true;      ///< Events of the wrong sign are no contour events.
  bool first_events = true;  ///< A puck of low contrast is followed by first events only.
  bool size_penalty = true;  ///< Too many events, or too large a size, make a track doubtful.
  /// … but at the image's sides a puck of good contrast may be larger, and cut off.
  bool image_sides = true;
  bool bloom = true;              ///< … but a bright puck looks larger than it is.
  bool smear = true;              ///< … and a fast one may look smaller.
  bool purity = true;             ///< Signs that do not suit a disc of one tone make it doubtful.
  bool sector_saturation = true;  ///< Events in one direction count less and less.
  bool twins = true;              ///< A twin at rest is there to take over at a bounce.
  bool wall = true;               ///< Whether the puck's side wall makes events is found out.
  bool wall_search = true;        ///< … and the search looks for it as it was found to be.
  bool wall_height = true;        ///< … and how high it is, where annotations leave it out.
  bool wall_edge = true;          ///< … and an edge between its face and it counts neither way.
  /// What lies inside the contour, where the surroundings are clear, is of the puck: its face may
  /// have a print.
  bool face_print = true;
  bool plain_face = true;   ///< … unless the puck is not faint and has been seen to have none.
  bool witness = true;      ///< A blob follows the puck more coarsely and checks on the track.
  bool search = true;       ///< A doubtful track is challenged by the correlation near it.
  bool wide_search = true;  ///< … and, unless it is beyond doubt, everywhere.
  bool anywhere = true;     ///< … again and again where it is not known at all where the puck is.
  /// A track that is 15 px outside the image has nothing left that speaks for it, so that the puck
  /// is looked for at once; and what is farther off than it may have come back to is less believed.
  bool way_back = true;
  bool afresh = true;        ///< What is found where a poor track is challenges it, too.
  bool fresh_search = true;  ///< The search sees what has made events of late only.
  bool stopping = true;      ///< A puck that falls silent is taken to have stopped.
  bool settling = true;      ///< A puck whose events fade comes to rest where it was last clear.
  /// The sensor's noise is measured, where all of its events are taken, and neither disturbs a puck
  /// at rest nor passes for what stands still.
  bool noise_floor = true;
  bool holding = true;      ///< A puck at rest stays while something comes near.
  bool left_behind = true;  ///< A track led away from a puck that cannot have left is brought back.
  bool background = true;   ///< What stands still while the head turns counts less.
  bool early_background = true;  ///< … which is known by the time that a track becomes doubtful.
  bool clear_rings = true;       ///< … unless a faint puck is sought, and it is a clear ring.
  bool faint_rests = true;       ///< What may be a faint puck at rest is looked for elsewhere, too.
  bool faint_memory = true;      ///< That a puck is faint is remembered while nothing tells it.
  /// What moves by itself takes over from a track that has gone bad, or rests and never moved.
  bool overtaking = true;
  /// While the head rests, which the background tells, even what moves slowly moves by itself.
  bool slow_movers = true;
  /// While the head may turn, what is found first moves with the scene or clearly by itself, as
  /// what slides along an edge does not; where it is known how it turns, only a whole or very
  /// strong ring displaces what is not trusted.
  bool own_motion = true;
  /// A faint puck at rest beneath a turning head is found, since it moves with the scene, and stays
  /// in it. The former takes own_motion, too.
  bool scene_rests = true;
  /// What one search after another finds along a way of its own is a faint puck, even if it has
  /// hardly any events of its own, as beside a rail. Takes background and, to correct a track,
  /// sightings.
  bool sighting_trails = true;
  /// What the search and its events together say is the puck takes over; what the search hardly
  /// sees as one does so less easily.
  bool recognition = true;
  bool sightings = true;     ///< What a search sees where a poor track is puts that right.
  bool at_once = true;       ///< What is clearly a puck, or likely, is believed on a few events.
  bool silent_trust = true;  ///< A track keeps its trust while its events, though few, agree.
};

struct ContourIngredient {
  std::string_view name;
  bool ContourIngredients::*is_on = nullptr;
};

/// Their names, for the ablation.
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
