#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/baselines/particle_template.h"
#include "common/baselines/uniform_random.h"
#include "common/events/sensor_size.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// The defaults are those of the variant that the PUCK paper was compared with (algorithms.md §1.8,
/// generation C).
struct ParticleSetParams {
  int particles = 100;
  /// A particle moves by up to this much in x and in y at each update.
  double position_spread_px = 3;
  /// Its scale, template px per image px, changes by up to this much at each update.
  double scale_spread = 0.1;
  double smallest_radius_px = 6;
  double largest_radius_px = 25.5;
  /// Resample only when few particles carry the weight; otherwise at each update.
  bool adaptive_resampling = false;
  /// Seed of the random numbers; the same seed and events give the same track, to the bit.
  std::uint64_t seed = 1;
};

/// A hypothesis of the puck's place and size.
struct Particle {
  Pixel position;
  double scale = 1;  ///< Template px per image px: 15 / radius.
  double weight = 0;
};

/// The particles of a filter and the steps that do not depend on their observations: weighting,
/// resampling, prediction. One thread at a time.
class ParticleSet {
 public:
  /// Throws std::invalid_argument, naming the key, when a parameter is out of range.
  ParticleSet(SensorSize sensor, const ParticleSetParams& params);

  /// Places all particles at `position` with equal weights; a radius beyond the limits is clamped.
  void seed(Pixel position, double radius_px);

  std::span<const Particle> particles() const { return particles_; }

  /// Multiplies each weight by its particle's likelihood (above 0) and normalises the sum to 1.
  void weigh(std::span<const double> likelihoods);

  /// Weighted means, as of the last `seed` or `weigh`.
  Pixel mean_position() const { return mean_position_; }
  double mean_radius_px() const { return mean_radius_px_; }

  /// Draws the same number of particles in proportion to their weights. As in the authors' code a
  /// particle keeps its weight, so that weights go on multiplying.
  void resample();

  /// Moves all particles at random, within the image and the limits of the radius.
  void predict();

 private:
  double scale_of_radius(double radius_px) const;
  void update_means();

  SensorSize sensor_;
  ParticleSetParams params_;
  UniformRandom random_;
  std::vector<Particle> particles_;
  std::vector<Particle> drawn_;
  Pixel mean_position_;
  double mean_radius_px_ = 0;
};

}  // namespace puck
