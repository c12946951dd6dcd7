#include "common/vision/puck_signature.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr double kSignatureMemory_us = 500'000;
// A puck of good contrast makes about five events at a pixel, a faint one hardly more than one.
constexpr double kFaintBelow = 1.6;
constexpr double kMaybeFaintBelow = 2.5;
// For less it may have been taken for something else; of longer ago it may have been another one.
constexpr std::int64_t kConfirmedAfter_us = 300'000;
constexpr std::int64_t kConfirmedMemory_us = 2'000'000;
// As of thirty events at 100 px/s.
constexpr double kLeastSpeedSum_px_s = 3'000;
constexpr double kLeastSwept_px2 = 2'000;
// Events inside for each one on the contour, area for area: of 13 kinds of development games 0.16
// at most with a plain puck, mostly below 0.03, and 0.41 at least with a printed one. A print so
// small that it has fewer does not make the track doubtful.
constexpr double kPlainFace = 0.1;
// As many as a puck of five events a pixel makes on a way of a few pixels. What comes over a fast
// puck is not told from a print for long; a slow one looks doubtful before that is forgotten.
constexpr double kLeastForFace_per_px2 = 4;
constexpr double kMostForFace_per_px2 = 16;

}  // namespace

void PuckSignature::learn(const Sample& sample, std::int64_t duration_us) {
  const double keep = std::exp(-static_cast<double>(duration_us) / kSignatureMemory_us);
  sum_.signed_speed = keep * sum_.signed_speed + sample.signed_speed;
  sum_.absolute_speed = keep * sum_.absolute_speed + sample.absolute_speed;
  sum_.events = keep * sum_.events + sample.events;
  sum_.swept_px2 = keep * sum_.swept_px2 + sample.swept_px2;
  sum_.quick_events = keep * sum_.quick_events + sample.quick_events;
  sum_.first_events = keep * sum_.first_events + sample.first_events;
  if (density() > 0) last_density_ = density();
  if (knows_multiplicity()) last_multiplicity_ = multiplicity();
  ring_per_px2_ += sample.ring_per_px2;
  inside_per_px2_ += sample.inside_per_px2;
  while (ring_per_px2_ > kMostForFace_per_px2) {
    ring_per_px2_ /= 2;
    inside_per_px2_ /= 2;
  }
}

void PuckSignature::confirm(std::int64_t duration_us) {
  if (!knows_multiplicity() || duration_us <= 0) return;
  duration_us = std::min(duration_us, kConfirmedMemory_us);
  confirmed_us_ = std::min(confirmed_us_ + duration_us, kConfirmedMemory_us);
  confirmed_multiplicity_ += static_cast<double>(duration_us) / static_cast<double>(confirmed_us_) *
                             (multiplicity() - confirmed_multiplicity_);
}

void PuckSignature::forget() {
  PuckSignature fresh;
  fresh.confirmed_multiplicity_ = confirmed_multiplicity_;
  fresh.confirmed_us_ = confirmed_us_;
  *this = fresh;
}

bool PuckSignature::was_faint() const {
  return !had_contrast() && confirmed_us_ > kConfirmedAfter_us &&
         confirmed_multiplicity_ < kFaintBelow;
}

bool PuckSignature::has_plain_face() const {
  return ring_per_px2_ > kLeastForFace_per_px2 && inside_per_px2_ < kPlainFace * ring_per_px2_;
}

double PuckSignature::contrast_sign() const {
  return sum_.absolute_speed > kLeastSpeedSum_px_s ? sum_.signed_speed / sum_.absolute_speed : 0;
}

double PuckSignature::multiplicity() const {
  return sum_.first_events > 0 ? sum_.quick_events / sum_.first_events : 0;
}

bool PuckSignature::is_faint() const {
  return knows_multiplicity() ? multiplicity() < kFaintBelow : was_faint();
}

bool PuckSignature::may_be_faint() const {
  return knows_multiplicity() ? multiplicity() < kMaybeFaintBelow : was_faint();
}

bool PuckSignature::had_contrast() const { return last_multiplicity_ >= kMaybeFaintBelow; }

bool PuckSignature::remembers_contrast() const {
  if (last_multiplicity_ > 0) return had_contrast();
  return confirmed_us_ > kConfirmedAfter_us && confirmed_multiplicity_ >= kMaybeFaintBelow;
}

double PuckSignature::density() const {
  return sum_.swept_px2 > kLeastSwept_px2 ? sum_.events / sum_.swept_px2 : 0;
}

}  // namespace puck
