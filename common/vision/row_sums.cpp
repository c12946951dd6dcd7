#include "common/vision/row_sums.h"

// Everything in this file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/row_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Sums up kRows rows: each sum waits for the one before it, but not for those of other rows.
template <int kRows>
void sum_rows(const std::uint8_t* from, std::ptrdiff_t from_stride, int width, std::uint16_t* to,
              std::ptrdiff_t to_stride) {
  int x = 0;
  for (int row = 0; row < kRows; ++row) to[row * to_stride] = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::Full128<std::uint16_t> tag;
  const hn::Rebind<std::uint8_t, decltype(tag)> pixel_tag;
  hn::Vec<decltype(tag)> before[kRows];
  for (auto& sum : before) sum = hn::Zero(tag);
  for (; x + 8 <= width; x += 8) {
    HWY_UNROLL(4)
    for (int row = 0; row < kRows; ++row) {
      auto sums = hn::PromoteTo(tag, hn::LoadU(pixel_tag, from + row * from_stride + x));
      sums = hn::Add(sums, hn::ShiftLeftLanes<1>(tag, sums));
      sums = hn::Add(sums, hn::ShiftLeftLanes<2>(tag, sums));
      sums = hn::Add(sums, hn::ShiftLeftLanes<4>(tag, sums));
      sums = hn::Add(sums, before[row]);
      hn::StoreU(sums, tag, to + row * to_stride + x + 1);
      before[row] = hn::Broadcast<7>(sums);
    }
  }
#endif
  for (; x < width; ++x) {
    for (int row = 0; row < kRows; ++row) {
      std::uint16_t* sums = to + row * to_stride + x;
      sums[1] = static_cast<std::uint16_t>(sums[0] + from[row * from_stride + x]);
    }
  }
}

void sum_picture(ImageView<const std::uint8_t> picture, std::uint16_t* to, std::ptrdiff_t stride) {
  constexpr int kRowsAtOnce = 4;
  const std::ptrdiff_t picture_stride = picture.width();
  int y = 0;
  for (; y + kRowsAtOnce <= picture.height(); y += kRowsAtOnce) {
    sum_rows<kRowsAtOnce>(picture.row(y), picture_stride, picture.width(), to + y * stride, stride);
  }
  for (; y < picture.height(); ++y) {
    sum_rows<1>(picture.row(y), picture_stride, picture.width(), to + y * stride, stride);
  }
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {

HWY_EXPORT(sum_picture);

void RowSums::resize(const Region& place) {
  place_ = place;
  pixels_.resize(place.width, place.height);
  // Whole cache lines, an odd number of them, so that rows do not compete for the same ones.
  constexpr std::ptrdiff_t kLine = 64 / sizeof(std::uint16_t);
  stride_ = ((place.width + 1 + kLine - 1) / kLine | 1) * kLine;
  const auto size = static_cast<std::size_t>(stride_ * place.height + kSlack);
  if (sums_.size() < size) sums_.resize(size);
}

void RowSums::sum_up() { HWY_DYNAMIC_DISPATCH(sum_picture)(pixels_.view(), sums_.data(), stride_); }

}  // namespace puck
#endif
