#pragma once

#include <cstdint>
#include <optional>

#include "common/vision/challenger.h"
#include "common/vision/claim.h"
#include "common/vision/track_looks.h"
#include "common/vision/way_back.h"

/// The rules by which a challenger takes the main track's place: functions of numbers.
namespace puck {

/// Of a puck of good contrast the correlation's score is above this, of all else below.
inline constexpr double kEvidentScore = 0.65;
/// How long an evident puck is waited for before anything less is believed.
inline constexpr std::int64_t kPatience_us = 150'000;
/// … and one that does not seem to slide along an edge, while the head may turn.
inline constexpr std::int64_t kLongPatience_us = 600'000;
/// What the search found must convince for so long without a break; the first of all for longer,
/// as nothing is known that it would have to be better than.
inline constexpr std::int64_t kConvincedAfter_us = 1'500;
inline constexpr std::int64_t kFirstConvincedAfter_us = 3'000;

/// What speaks for the main track.
struct Defence {
  TrackLooks looks;
  bool is_trusted = false;                 ///< TrackTrust's.
  bool is_proven = false;                  ///< TrackTrust's.
  bool may_be_overtaken = false;           ///< Ingredient `overtaking`.
  bool knows_pucks = false;                ///< Ingredient `recognition`.
  bool is_resting = false;                 ///< TrackStanding's.
  bool lies_in_scene = false;              ///< SceneRest's.
  bool is_lost = false;                    ///< TrackStanding's.
  bool was_covered = false;                ///< TrackTrust's.
  bool is_witnessed = false;               ///< WitnessCheck vouches for it.
  bool may_be_faint = false;               ///< PuckSignature's.
  bool had_contrast = false;               ///< PuckSignature's.
  std::optional<WayBack::Reach> way_back;  ///< WayBack's.
  double score = 0;                        ///< SeenScore's.
  std::int64_t since_good_us = 0;          ///< TrackTrust's.
  std::int64_t since_sound_us = 0;         ///< TrackTrust's.
};

/// For those born of the main track: the sequential test on the events that both of them saw.
bool wins_test(Challenger::Kind kind, const Claim& claim);

/// To the correlation it looks like nothing but a puck, and its events do not say otherwise.
bool is_evident(const Claim& claim);
/// Nothing that is fixed to the table moves so fast in the image, however the head turns; or, while
/// the head rests, it moves at all, and is a puck in every respect.
bool moves_by_itself(const Claim& claim);

/// It is by far the stronger, wherever it is, searches see something of a puck in it, and the main
/// track has not been sound for long or it is evident itself.
bool outshines(const Claim& claim, const Defence& main);
/// It moves as a puck does and is of its size, and it is more of a puck in every respect: its
/// events are better, at least half as many again, and on more sides, and searches say so, too. If
/// these do not clearly see a puck, its ring must be a fine one.
/// What is not of a puck's size it need not quite equal in quality.
bool surpasses(const Claim& claim, const Defence& main);
/// It moves as a puck does; the main track has never done so, or has not been good for so long
/// that it has lost what it followed. It need not look quite as good, and a whole ring may look
/// worse still: a round mark on the table is the better ring. What is no whole ring must not be
/// less of a puck to searches.
bool outmoves(const Claim& claim, const Defence& main);
/// It is evident, or clear at once, and not less of a puck to searches; the main track is not to be
/// trusted, or has not been sound for long. If that is a faint puck's, and a good whole ring, what
/// is clear must be one, too. While it moves as only pucks do, what is slow unmasks nothing.
bool unmasks(const Claim& claim, const Defence& main);
/// It looks better than a main track that is not to be trusted, is of a puck's size, and not less
/// of a puck to searches; nor slow while that moves as only pucks do. Where the head is known to
/// turn it is a whole ring, or very strong.
bool displaces_stranger(const Claim& claim, const Defence& main);
/// It looks better near a main track that nothing vouches for, is no larger than a puck, and not
/// less of one to searches; the farther away, the better it must look. It may be smaller: of the
/// other opinion on the wall it is. What is seen on few sides succeeds a faint puck only if
/// searches see it, too.
bool succeeds_nearby(const Claim& claim, const Defence& main);
/// It moves as a puck does, is of its size, leads, and looks good on enough sides, and searches see
/// something of a puck in it; and a main track not far away has just lost all of its events, as one
/// does that missed a bounce or a hit. While they fly apart, it is out of reach of what succeeds
/// nearby.
bool inherits(const Claim& claim, const Defence& main);

/// It moves as a puck does, beyond doubt or as a whole ring; the main track is taken to rest, and
/// has never done so itself, or the puck is so faint that it is never evident, or was covered and
/// has not been seen for a while, so that it may have been taken away.
bool outruns_rest(const Claim& claim, const Defence& main);

/// It is evident, and more of a puck to searches, or clear at once, or moves as a puck does; the
/// main track lies in the scene of a turning head. While that looks good, what is clear must be a
/// whole ring.
bool unsettles(const Claim& claim, const Defence& main);

/// It is clear at once; or, the less the correlation says, the more its events must, and the other
/// way round, and the clearer those are, the sooner; the main track has not been good for a while.
bool is_recognised(const Claim& claim, const Defence& main);

/// Searches have followed it along a way of its own, and it has some events, or they have done so
/// for long; the main track may be a faint puck's and has not been good for a while.
bool is_followed(const Claim& claim, const Defence& main);

/// Something has come over a puck that was beyond doubt a moment ago. What searches do not see as a
/// puck is then likely a part of that, or a mallet elsewhere, each of which may be the better ring
/// while the puck is hidden. What is clear at once is neither; and of a faint puck searches may see
/// no more.
bool is_premature(const Claim& claim, const Defence& main);

/// A puck of good contrast has left the image, and the claim is farther from there than WayBack
/// says. It must be evident, or a whole ring that moves as pucks do, with very many events, and
/// fast enough to have come from there.
bool is_out_of_reach(const Claim& claim, const Defence& main);

/// Any of the first seven, or recognised or followed, and neither premature nor out of reach; but
/// far from a track that moves, has twice its events, on more sides, and is more of a puck to
/// searches, none; against a puck at rest, which makes no events, that it is evident, outruns it,
/// or is recognised, by a high score if it is not lost; against one that lies in the scene and is
/// not lost, that it unsettles it. A conjecture must move by itself, unless the main track has not
/// been sound for long.
bool is_convincing(const Claim& claim, const Defence& main);

/// While nothing is known, `searched_us` after the first search began: what is neither evident, nor
/// likely, nor may be printed, nor moves by itself, being no larger than a puck, must look like a
/// puck in every respect, and longer, unless it rests in the scene; so must, for a while, what is
/// but evident or printed, with another side wall than the puck. While the head may turn, what may
/// slide along an edge or is adrift does not count for kLongPatience_us, nor what is no whole ring
/// as moving by itself, unless they are very strong; and what has something in its middle does not
/// count as likely.
bool is_convincing_as_first(const Claim& claim, std::int64_t searched_us);

/// What the search found far away, or first, even if it may be printed, and is neither evident,
/// clear at once, nor likely, nor moves by itself, nor rests in the scene, nor has been followed
/// for long.
bool is_weakly_found(const Claim& claim, const std::optional<TrackLooks>& main);

}  // namespace puck
