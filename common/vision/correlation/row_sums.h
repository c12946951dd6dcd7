#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/vision/geometry/image.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// Prefix sums of a picture's rows, so that the sum of a run of pixels of any length is the
/// difference of two numbers. Sums are kept modulo 2^16, so that vectors hold twice as many as with
/// 32 bits: the sum of a run of at most `kLongestRun` pixels is smaller, so its difference is
/// exact.
class RowSums {
 public:
  static constexpr int kLongestRun = 257;
  /// Readable elements beyond a row's last sum, of any value: for whole vectors.
  static constexpr int kSlack = 128;
  /// Pixels summed up at once; those beyond a row's end may have any value.
  static constexpr int kStep = 16;

  /// Makes room for a picture of `place`. The caller writes all its pixels, row by row, to
  /// `pixels()`, and then calls `sum_up()`; the rows before `first` and from `last` on must be
  /// dark.
  void resize(const Region& place);
  ImageView<std::uint8_t> pixels() {
    return {pixels_.data(), place_.width, place_.height, pixel_stride_};
  }
  void sum_up(int first, int last);

  const Region& place() const { return place_; }
  /// The sums of row y, from the top of the place: [x] is the sum of the pixels left of column x.
  const std::uint16_t* row(int y) const { return sums_.data() + y * stride_; }
  std::ptrdiff_t stride() const { return stride_; }
  ImageView<const std::uint8_t> picture() const {
    return {pixels_.data(), place_.width, place_.height, pixel_stride_};
  }

 private:
  Region place_;
  std::ptrdiff_t pixel_stride_ = 0;
  std::vector<std::uint8_t> pixels_;
  std::ptrdiff_t stride_ = 0;
  std::vector<std::uint16_t> sums_;
};

}  // namespace puck
