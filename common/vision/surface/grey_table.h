#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/vision/geometry/image.h"
#include "common/vision/surface/eros_strips.h"

namespace puck {

/// How a decayed pixel becomes a whole grey value.
enum class ErosRounding : std::uint8_t {
  kNearest,           ///< 255·dⁿ, rounded once.
  kTruncateEachStep,  ///< Truncated after every decay, as the authors' 8-bit surface does.
};

/// The grey value of each byte of a surface. Dark is 0.
using GreyValues = std::array<std::uint8_t, 256>;

/// Of EROS, whose bytes are 255 − n after n events: 255·dⁿ. `decay` lies between 0 and 1.
GreyValues eros_greys(double decay, ErosRounding rounding);

/// Conversion of a surface's bytes to grey values: a table, applied in vectors. Constant after
/// construction, so safe from any thread.
class GreyTable {
 public:
  explicit GreyTable(const GreyValues& greys);

  /// The grey value of a byte, 0 to 255.
  std::uint8_t operator()(std::uint8_t count) const { return grey_of_count_[count]; }

  /// Converts `counts` to a picture and overwrites them. `out` is as large as their region.
  void develop(SurfaceCounts& counts, ImageView<std::uint8_t> out) const;

  /// Replaces bytes by their grey values. Uses the widest vectors that the machine has.
  void apply(std::span<std::uint8_t> counts) const;

 private:
  GreyValues grey_of_count_;
  // The table reversed for the vectors, by 255 − byte, and the number of groups of sixteen before
  // all is dark.
  alignas(64) GreyValues grey_after_{};
  int sixteens_ = 0;
};

}  // namespace puck
