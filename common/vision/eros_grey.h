#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/vision/eros_strips.h"
#include "common/vision/image.h"

namespace puck {

/// How a decayed pixel becomes a whole grey value.
enum class ErosRounding : std::uint8_t {
  kNearest,           ///< 255·dⁿ, rounded once.
  kTruncateEachStep,  ///< Truncated after every decay, as the authors' 8-bit surface does.
};

/// Conversion of an EROS surface's counts to grey values: a table, applied in vectors. Constant
/// after construction, so safe from any thread.
class ErosGrey {
 public:
  /// `decay` lies between 0 and 1.
  ErosGrey(double decay, ErosRounding rounding);

  /// The grey value of a byte 255 − n, 0 to 255.
  std::uint8_t operator()(std::uint8_t count) const { return grey_of_count_[count]; }

  /// Converts `counts` to a picture and overwrites them. `out` is as large as their region.
  void develop(SurfaceCounts& counts, ImageView<std::uint8_t> out) const;

  /// Replaces bytes 255 − n by their grey values. Uses the widest vectors that the machine has.
  void apply(std::span<std::uint8_t> counts) const;
  /// The specification of apply(), byte by byte.
  void apply_byte_by_byte(std::span<std::uint8_t> counts) const;

 private:
  std::array<std::uint8_t, 256> grey_of_count_{};
  // The table reversed for the vectors: grey after n events, and the number of groups of sixteen
  // before all is dark.
  alignas(64) std::array<std::uint8_t, 256> grey_after_{};
  int sixteens_ = 0;
};

}  // namespace puck
