#include "common/vision/challengers.h"

#include <algorithm>
#include <cmath>

#include "common/vision/image_bounds.h"

namespace puck {
namespace {

constexpr std::ptrdiff_t kMostTwins = 4;
constexpr std::ptrdiff_t kMostWitnesses = 8;
constexpr std::ptrdiff_t kMostWallTwins = 1;
constexpr std::ptrdiff_t kMostFound = 36;
constexpr std::size_t kMostChallengers = kMostTwins + kMostWitnesses + kMostWallTwins + kMostFound;

// A bounce shows at once; what the search found has everything to learn.
constexpr std::int64_t kTwinLife_us = 8'000;
constexpr std::int64_t kWallTwinLife_us = 40'000;
constexpr std::int64_t kSearchLife_us = 60'000;
// … and, if it thrives, is given longer while there is no main track; with one it is idle by then,
// but not refuted, so that it may be found again.
constexpr std::int64_t kThrivingLife_us = 150'000;

// Where there is no room for more, what has been tried for so long and is no better is given up.
constexpr std::int64_t kSupportedAfter_us = 5'000;
constexpr double kUnsupported = 0.1;

// How well a steady trail knows how fast it is.
constexpr double kTrailSigma_px_s = 300;

// A challenger that has come so near to the main track is the same track.
constexpr double kSame_px = 2;
constexpr double kSame_px_s = 100;
// … unless they differ so much in size.
constexpr double kSameGrowth_px = 0.3;

std::ptrdiff_t most_of(Challenger::Kind kind) {
  switch (kind) {
    case Challenger::Kind::kTwin:
      return kMostTwins;
    case Challenger::Kind::kWitness:
      return kMostWitnesses;
    case Challenger::Kind::kWall:
      return kMostWallTwins;
    case Challenger::Kind::kSearch:
      break;
  }
  return kMostFound;
}

std::int64_t life_us(Challenger::Kind kind) {
  switch (kind) {
    case Challenger::Kind::kTwin:
    case Challenger::Kind::kWitness:
      return kTwinLife_us;
    case Challenger::Kind::kWall:
      return kWallTwinLife_us;
    case Challenger::Kind::kSearch:
      break;
  }
  return kSearchLife_us;
}

Pixel position_of(const Challenger& challenger) { return challenger.track().filter().position(); }

bool is_found(const Challenger& challenger) {
  return challenger.kind() == Challenger::Kind::kSearch;
}

// What the search found by mistake makes room for others.
bool is_hopeless(const Challenger& challenger, std::int64_t time_us) {
  const std::int64_t tried_us = challenger.tried_us(time_us);
  const TrackLooks looks = challenger.track().looks();
  const double quality = looks.quality;
  const bool thrives = quality > 0.6 && looks.strength > 20 && !looks.is_oversized();
  return tried_us > (thrives ? kThrivingLife_us : kSearchLife_us) ||
         (tried_us > 10'000 && quality < 0.2) || (tried_us > 25'000 && quality < 0.5);
}

// Opinions on the wall are in the same place by nature.
bool is_same(const Challenger& challenger, const ContourFilter& main) {
  const ContourFilter& filter = challenger.track().filter();
  const PixelVelocity velocity = filter.velocity();
  return challenger.kind() != Challenger::Kind::kWall &&
         distance_px(filter.position(), main.position()) < kSame_px &&
         std::abs(filter.growth_px() - main.growth_px()) < kSameGrowth_px &&
         std::hypot(velocity.x - main.velocity().x, velocity.y - main.velocity().y) < kSame_px_s;
}

}  // namespace

Challengers::Challengers() { challengers_.reserve(kMostChallengers); }

Challenger* Challengers::add(Challenger::Kind kind, const ContourContext& context,
                             const ContourFilter::Start& start, std::int64_t time_us,
                             double wall_share, const Challenger::Found& found) {
  const auto of_kind = std::count_if(challengers_.begin(), challengers_.end(),
                                     [&](const Challenger& other) { return other.kind() == kind; });
  if (of_kind >= most_of(kind)) return nullptr;
  return &challengers_.emplace_back(kind, context, start, time_us, wall_share, found);
}

void Challengers::add_found(const Answer& answer, const ContourContext& context) {
  const SearchResult& result = answer.result;
  // What cannot catch up is tried from now on.
  const std::int64_t seen_us =
      answer.can_catch_up ? std::min(result.time.us, answer.time_us) : answer.time_us;
  const auto try_one = [&](Pixel position, double wall_share, const Challenger::Found& found) {
    ContourFilter::Start start;
    start.position = position;
    if (found.trail.is_steady()) {
      const double passed_s = static_cast<double>(seen_us - result.time.us) * 1e-6;
      start.velocity = found.trail.velocity;
      start.position.x += start.velocity.x * passed_s;
      start.position.y += start.velocity.y * passed_s;
      start.sigma_px_s = kTrailSigma_px_s;
    }
    Challenger* added = add(Challenger::Kind::kSearch, context, start, seen_us, wall_share, found);
    if (added) added->catch_up(answer.missed, answer.period_us, answer.decided_us, context);
  };
  const double sought = context.contour.wall_share(result.request.other_wall);
  const double not_sought = context.contour.wall_share(!result.request.other_wall);
  for (const SearchCandidate& candidate : result.candidates) {
    const Challenger::Found found{candidate.score, answer.is_conjecture, candidate.trail};
    if (answer.main && distance_px(candidate.position, *answer.main) < kSame_px) continue;
    if (note_known(candidate.position, found, seen_us)) continue;
    if (!found.trail.is_steady() &&
        refuted_.contains(candidate.position, candidate.score, answer.time_us)) {
      continue;
    }
    make_room_for(candidate, answer.time_us);
    try_one(candidate.position, sought, found);
    if (!context.ingredients.wall) continue;
    try_one(context.contour.centre_with_wall(candidate.position, sought, not_sought), not_sought,
            found);
  }
}

// Where the puck was when the snapshot was taken is compared with where the others were then.
bool Challengers::note_known(Pixel position, const Challenger::Found& found, std::int64_t time_us) {
  bool is_known = false;
  for (Challenger& challenger : challengers_) {
    if (!is_found(challenger) ||
        distance_px(position, challenger.track().filter().position_at(time_us)) >= 2 * kSame_px) {
      continue;
    }
    challenger.note_found(found);
    is_known = true;
  }
  return is_known;
}

// Of those that were found.
const Challenger* Challengers::least_good(std::int64_t time_us) const {
  const Challenger* worst = nullptr;
  for (const Challenger& one : challengers_) {
    if (!is_found(one) || one.tried_us(time_us) < kSupportedAfter_us ||
        one.found().trail.is_steady()) {
      continue;
    }
    if (worst == nullptr || one.track().quality() < worst->track().quality()) worst = &one;
  }
  return worst;
}

// What no event has spoken for yet makes room; what is evident must not even wait for that.
void Challengers::make_room_for(const SearchCandidate& candidate, std::int64_t time_us) {
  const auto give_up = [this](const Challenger& one) {
    challengers_.erase(challengers_.begin() + (&one - challengers_.data()));
  };
  while (std::count_if(challengers_.begin(), challengers_.end(), is_found) > kMostFound - 2) {
    const Challenger* worst = least_good(time_us);
    if (worst != nullptr && worst->track().quality() < kUnsupported) {
      give_up(*worst);
    } else if (candidate.score > kEvidentScore) {
      give_up(*std::min_element(
          challengers_.begin(), challengers_.end(), [](const Challenger& a, const Challenger& b) {
            return is_found(a) && (!is_found(b) || a.found().score < b.found().score);
          }));
    } else {
      return;
    }
  }
}

void Challengers::decide(std::int64_t time_us, const ContourContext& context) {
  for (Challenger& challenger : challengers_) challenger.decide(time_us, context);
}

const Challenger* Challengers::successor(const Defence& main, const ClaimContext& context,
                                         std::int64_t time_us) {
  for (Challenger& challenger : challengers_) {
    const Claim claim = claim_of(challenger, context, time_us);
    const bool wins = is_found(challenger)
                          ? challenger.convincing_for_us(is_convincing(claim, main), time_us) >=
                                kConvincedAfter_us
                          : wins_test(challenger.kind(), claim);
    if (wins) return &challenger;
  }
  return nullptr;
}

const Challenger* Challengers::first(const ClaimContext& context, std::int64_t searched_us,
                                     std::int64_t time_us) {
  const Challenger* best = nullptr;
  for (Challenger& challenger : challengers_) {
    const bool convinces =
        is_convincing_as_first(claim_of(challenger, context, time_us), searched_us);
    if (challenger.convincing_for_us(convinces, time_us) >= kFirstConvincedAfter_us &&
        (best == nullptr || challenger.track().quality() > best->track().quality())) {
      best = &challenger;
    }
  }
  return best;
}

void Challengers::dismiss_hopeless(std::int64_t time_us, bool head_rests) {
  std::erase_if(challengers_, [&](const Challenger& challenger) {
    const bool is_over = is_found(challenger) && is_hopeless(challenger, time_us);
    const bool was_led_away = head_rests && challenger.track().looks().is_fast();
    if (is_over && !was_led_away && !challenger.found().trail.is_steady()) {
      refuted_.add(position_of(challenger), challenger.found().score, time_us);
    }
    return is_over;
  });
}

void Challengers::dismiss_born() {
  std::erase_if(challengers_, [](const Challenger& challenger) { return !is_found(challenger); });
}

void Challengers::dismiss_outside(SensorSize sensor) {
  std::erase_if(challengers_, [&](const Challenger& challenger) {
    return !is_in_image(position_of(challenger), sensor);
  });
}

void Challengers::dismiss_idle(const ContourFilter& main, std::int64_t time_us) {
  std::erase_if(challengers_, [&](const Challenger& challenger) {
    return challenger.tried_us(time_us) > life_us(challenger.kind()) || is_same(challenger, main);
  });
}

}  // namespace puck
