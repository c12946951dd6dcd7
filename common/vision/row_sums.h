#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/vision/image.h"
#include "common/vision/region.h"

namespace puck {

/// A picture with its rows summed up from the left, so that the sum of a run of pixels is the
/// difference of two numbers, however long it is. Sums are kept modulo 2^16: a run of at most
/// `kLongestRun` pixels has a smaller sum, so its difference is exact, and vectors hold twice as
/// many as with 32 bits.
class RowSums {
 public:
  static constexpr int kLongestRun = 257;
  /// So many sums may be read beyond a row's last, whatever they are: whole vectors.
  static constexpr int kSlack = 128;
  /// So many pixels are summed up at once, whatever the last ones of a row's are.
  static constexpr int kStep = 16;

  /// Makes room for a picture of `place`. The caller writes all its pixels, row by row, to
  /// `pixels()`, and then calls `sum_up()`: the rows before `first` and from `last` on are all
  /// dark.
  void resize(const Region& place);
  ImageView<std::uint8_t> pixels() {
    return {pixels_.data(), place_.width, place_.height, pixel_stride_};
  }
  void sum_up(int first, int last);

  const Region& place() const { return place_; }
  /// The sums of row y, from the top of the place: [x] is that of the pixels left of column x.
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
