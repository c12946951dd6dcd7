#include "common/calibration/evidence_fit.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/contains.h"
#include "tests/support/sanitizers.h"

namespace puck {
namespace {

constexpr int kPackets = kIsSanitized ? 200 : 1'500;
constexpr EvidenceAreas kAreas{.ring = 200, .inside = 250, .outside = 400, .reach_px = 7};

// Draws packets as the tracker's likelihoods describe them, of a puck at a known speed.
class PacketMaker {
 public:
  explicit PacketMaker(const EvidenceParams& params) : params_(params) {}

  LabelledPacket packet(bool is_puck) {
    LabelledPacket made{.areas = kAreas, .density = 1, .is_puck = is_puck};
    EvidencePacket& packet = made.packet;
    packet.seconds = 0.001;
    packet.swept = packet.swept_low = packet.swept_high = 20;
    packet.flux = {4, 3, 2, 4, 3, 2, 1, 1, 1, 1, 1, 1};
    std::array<double, 3> places{};
    draw(places, place_shares(is_puck), is_puck ? params_.place_puck : params_.place_other,
         12 + static_cast<int>(30 * uniform()));
    packet.ring = places[0];
    packet.inside = places[1];
    packet.outside = places[2];
    const int ring = static_cast<int>(packet.ring);
    draw(packet.sectors, sector_shares(packet, is_puck),
         is_puck ? params_.sector_puck : params_.sector_other, ring);
    std::array<double, 2> signs{};
    draw(signs, {0.5, 0.5}, 2 * (is_puck ? params_.sign_puck : params_.sign_other), ring);
    packet.dark = signs[0];
    packet.bright = signs[1];
    return made;
  }

  LabelledRecording recording(int pucks, int others) {
    LabelledRecording made;
    for (int i = 0; i < pucks; ++i) made.packets.push_back(packet(true));
    for (int i = 0; i < others; ++i) made.packets.push_back(packet(false));
    return made;
  }

 private:
  double uniform() { return std::uniform_real_distribution<>()(random_); }

  std::array<double, 3> place_shares(bool is_puck) const {
    std::array<double, 3> shares{
        kAreas.ring * std::exp(is_puck ? params_.place_puck_lift : params_.place_other_lift),
        kAreas.inside,
        kAreas.outside *
            std::exp(is_puck ? params_.place_puck_outside : params_.place_other_outside)};
    const double sum = shares[0] + shares[1] + shares[2];
    for (double& share : shares) share /= sum;
    return shares;
  }

  std::array<double, kContourSectors> sector_shares(const EvidencePacket& packet,
                                                    bool is_puck) const {
    const double even = is_puck ? params_.sector_puck_even : params_.sector_other_even;
    const double sum = std::accumulate(packet.flux.begin(), packet.flux.end(), 0.0);
    std::array<double, kContourSectors> shares{};
    for (std::size_t i = 0; i < shares.size(); ++i) {
      shares[i] = (1 - even) * packet.flux[i] / sum + even / kContourSectors;
    }
    return shares;
  }

  // Pólya's urn: what was drawn is drawn more easily again.
  template <std::size_t N>
  void draw(std::array<double, N>& counts, const std::array<double, N>& shares,
            double concentration, int events) {
    for (int drawn = 0; drawn < events; ++drawn) {
      double left = uniform() * (concentration + drawn);
      std::size_t i = 0;
      while (i + 1 < N && left >= concentration * shares[i] + counts[i]) {
        left -= concentration * shares[i] + counts[i];
        ++i;
      }
      counts[i] += 1;
    }
  }

  EvidenceParams params_;
  std::mt19937 random_{1};
};

EvidenceParams known() {
  EvidenceParams params;
  params.place_puck = 8;
  params.place_puck_lift = 2;
  params.place_puck_outside = -0.5;
  params.place_other = 5;
  params.place_other_lift = 0.5;
  params.place_other_outside = 0.3;
  params.sector_puck = 60;
  params.sector_puck_even = 0.2;
  params.sector_other = 3;
  params.sector_other_even = 0.5;
  params.sign_puck = 0.1;
  params.sign_other = 0.6;
  return params;
}

TEST_CASE("the fit finds the numbers with which packets were drawn") {
  const EvidenceParams drawn = known();
  PacketMaker maker(drawn);
  const LabelledRecording recording = maker.recording(kPackets, kPackets);
  const EvidenceParams fitted = fit_evidence(std::span(&recording, 1));
  // It allows for a few packets of each class that look like the other's, which were not drawn.
  const double log_error = kIsSanitized ? 0.7 : 0.4;
  for (double EvidenceParams::*number :
       {&EvidenceParams::place_puck, &EvidenceParams::place_other, &EvidenceParams::sector_puck,
        &EvidenceParams::sector_puck_even, &EvidenceParams::sector_other,
        &EvidenceParams::sector_other_even, &EvidenceParams::sign_puck,
        &EvidenceParams::sign_other}) {
    CAPTURE(drawn.*number);
    CAPTURE(fitted.*number);
    CHECK(std::abs(std::log(fitted.*number / drawn.*number)) < log_error);
  }
  for (double EvidenceParams::*lift :
       {&EvidenceParams::place_puck_lift, &EvidenceParams::place_puck_outside,
        &EvidenceParams::place_other_lift, &EvidenceParams::place_other_outside}) {
    CAPTURE(drawn.*lift);
    CHECK(std::abs(fitted.*lift - drawn.*lift) < 0.25);
  }
  // The terms were drawn independently: each counts whole.
  const double lowest = kIsSanitized ? 0.33 : 0.7;
  const double largest = kIsSanitized ? 3 : 1.5;
  for (const double worth : {fitted.place_worth, fitted.sector_worth, fitted.sign_worth}) {
    CHECK(worth > lowest);
    CHECK(worth < largest);
  }
  const EvidenceQuality before = quality_of(recording.packets, {});
  const EvidenceQuality after = quality_of(recording.packets, fitted);
  CHECK(after.auc.value() > 0.95);
  CHECK(after.log_loss.value() < before.log_loss.value());
}

TEST_CASE("a recording counts by its weight, not by its number of packets") {
  constexpr int kFew = kPackets / 5;
  EvidenceParams wide = known();
  wide.place_puck_lift = 0.5;
  std::array<LabelledRecording, 2> recordings{PacketMaker(known()).recording(kFew, kFew),
                                              PacketMaker(wide).recording(3 * kFew, kFew)};
  recordings[0].weight = 1000;
  CHECK(fit_evidence(recordings).place_puck_lift > 1.6);
  recordings[0].weight = 1e-3;
  CHECK(fit_evidence(recordings).place_puck_lift < 0.9);
}

TEST_CASE("too few packets of a class are refused") {
  const LabelledRecording recording = PacketMaker(known()).recording(100, 7);
  try {
    fit_evidence(std::span(&recording, 1));
    FAIL("not refused");
  } catch (const std::invalid_argument& error) {
    CHECK(contains(error.what(), "only 7 packets of events are of anything else, 50 or more"));
  }
}

TEST_CASE("packets of one class alone have no quality, and equal ones tell nothing") {
  PacketMaker maker(known());
  LabelledPacket packet = maker.packet(true);
  const EvidenceQuality alone = quality_of(std::span(&packet, 1), {});
  CHECK(alone.pucks == 1);
  CHECK_FALSE(alone.auc);
  CHECK_FALSE(alone.log_loss);
  std::array<LabelledPacket, 2> both{packet, packet};
  both[1].is_puck = false;
  CHECK(quality_of(both, {}).auc.value() == doctest::Approx(0.5));
}

}  // namespace
}  // namespace puck
