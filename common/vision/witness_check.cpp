#include "common/vision/witness_check.h"

#include <algorithm>

namespace puck {
namespace {

constexpr double kAgreement_widths = 0.25;
constexpr double kNear_px = 4.5;
constexpr double kAstray_widths = 0.5;
constexpr std::int64_t kAstrayFor_us = 20'000;
constexpr std::int64_t kSpeakingPeriod_us = 1'000;
constexpr double kSigma_px = 4;
constexpr double kSigma_px_s = 1'000;
constexpr double kReturn_us = 100'000;

}  // namespace

void WitnessCheck::consult(const ContourTrack& main, const ContourContext& context,
                           std::int64_t time_us, Challengers& challengers) {
  const Pixel position = main.filter().position();
  witness_.set_size(context.contour.size_at(witness_.position()));
  witness_.note();
  if (agrees(position, context)) {
    agreed_us_ = time_us;
    return;
  }
  if (!context.ingredients.witness) return;
  const double astray_px = kAstray_widths * context.contour.size_at(position).width;
  if (main.is_good() && distance_px(witness_.position(), position) > astray_px &&
      time_us - agreed_us_ > kAstrayFor_us) {
    witness_.put(position);
    return;
  }
  // First events alone, which a faint puck is followed by, are too few for a blob.
  if (context.signature.is_faint() || time_us - spoke_us_ < kSpeakingPeriod_us) return;
  spoke_us_ = time_us;
  ContourFilter::Start start = main.filter().start_at(witness_.position());
  start.velocity = witness_.velocity();
  start.sigma_px = kSigma_px;
  start.sigma_px_s = kSigma_px_s;
  challengers.add(Challenger::Kind::kWitness, context, start, time_us, main.wall_share());
}

void WitnessCheck::draw_to(Pixel main, std::int64_t passed_us) {
  witness_.draw_to(main, std::min(static_cast<double>(passed_us) / kReturn_us, 1.0));
}

void WitnessCheck::put(Pixel position, std::int64_t time_us) {
  witness_.put(position);
  agreed_us_ = time_us;
}

bool WitnessCheck::agrees(Pixel main, const ContourContext& context) const {
  return distance_px(witness_.position(), main) <
         kAgreement_widths * context.contour.size_at(main).width;
}

bool WitnessCheck::is_near(Pixel main, const ContourContext& context) const {
  return agrees(main, context) || distance_px(witness_.position(), main) < kNear_px;
}

bool WitnessCheck::vouches(Pixel main, const ContourContext& context) const {
  return context.ingredients.witness && agrees(main, context) &&
         context.signature.knows_multiplicity() && !context.signature.is_faint();
}

}  // namespace puck
