#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/vision/geometry/image.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// A Gaussian at whole steps along one direction, kept from one step to the next as long as the
/// puck's size and the window stay the same.
class GaussianTable {
 public:
  /// Values at `first`, `first` + 1, … from its middle.
  const std::vector<double>& at(double first, int count, double sigma);

 private:
  double first_ = 0;
  double sigma_ = 0;
  std::vector<double> values_;
};

/// A response in a window around the expected position, and the Gaussian that weighs it.
struct WeightedWindow {
  ImageView<const double> response;
  const std::vector<double>* columns = nullptr;
  const std::vector<double>* rows = nullptr;
  /// The weighted response is rounded to 256 levels between its lowest and its highest value, as in
  /// the authors' code.
  bool quantised = false;
};

/// The maximum of a response that a Gaussian weighs.
struct WeightedPeak {
  int x = 0;  ///< The first one in reading order, from the window's first pixel.
  int y = 0;
  bool stands_out = false;  ///< The weighted response is above 0 there.
};

/// Finds the maximum of (response − lowest) · Gaussian, where differences below 0 count 0.
class WeightedPeakFinder {
 public:
  WeightedPeak find(const WeightedWindow& window, double lowest);

  /// The maximum if the lowest response is only known to lie between `least` and `most`, and `most`
  /// exceeds no response in the window; nothing if the maximum depends on it. Every weighted
  /// response is linear in the lowest one, and so is the difference of two: a pixel below another
  /// one at both ends is below it everywhere between.
  std::optional<WeightedPeak> find_between(const WeightedWindow& window, double least, double most);

 private:
  struct Place {
    int x = 0;
    int y = 0;
    friend bool operator==(const Place&, const Place&) = default;
  };
  struct Found {
    WeightedPeak peak;
    Place highest;
    Place lowest;
  };

  Found look(const WeightedWindow& window, double lowest);
  static double weighted(const WeightedWindow& window, Place place, double lowest);
  static Place place_of(const WeightedWindow& window, double lowest, double value,
                        const std::vector<double>& of_rows);
  static bool reaches_highest_level(double value, double low, double high);

  std::vector<double> row_highs_;
  std::vector<double> row_lows_;
};

}  // namespace puck
