#include "common/vision/correlation/row_sums.h"

#include <algorithm>
#include <type_traits>

// Everything in this file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/correlation/row_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Lanes move only within blocks of 16 bytes, so each block of a vector holds a row of its own.
constexpr std::size_t kBlock = 16;
using Pixels = hn::CappedTag<std::uint8_t, 4 * kBlock>;
using Sums = hn::Repartition<std::uint16_t, Pixels>;
constexpr int kRowsInVector = static_cast<int>(hn::MaxLanes(Pixels()) / kBlock);
constexpr int kStep = RowSums::kStep;
static_assert(kStep == kBlock);

template <typename Tag>
HWY_INLINE hn::Vec<Tag> load_rows(Tag tag, const std::uint8_t* from, std::ptrdiff_t stride) {
  constexpr std::size_t kRows = hn::MaxLanes(Tag()) / kBlock;
  if constexpr (kRows == 1) {
    return hn::LoadU(tag, from);
  } else {
    const hn::Half<Tag> half;
    return hn::Combine(tag, load_rows(half, from + kRows / 2 * stride, stride),
                       load_rows(half, from, stride));
  }
}

template <typename Tag>
HWY_INLINE void store_rows(hn::Vec<Tag> sums, Tag tag, std::uint16_t* to, std::ptrdiff_t stride) {
  constexpr std::size_t kRows = hn::MaxLanes(Tag()) * sizeof(std::uint16_t) / kBlock;
  if constexpr (kRows == 1) {
    hn::StoreU(sums, tag, to);
  } else {
    const hn::Half<Tag> half;
    store_rows(hn::LowerHalf(half, sums), half, to, stride);
    store_rows(hn::UpperHalf(half, sums), half, to + kRows / 2 * stride, stride);
  }
}

HWY_INLINE hn::Vec<Sums> sum_along_blocks(hn::Vec<Sums> sums) {
  const Sums tag;
  sums = hn::Add(sums, hn::ShiftLeftLanes<1>(tag, sums));
  sums = hn::Add(sums, hn::ShiftLeftLanes<2>(tag, sums));
  return hn::Add(sums, hn::ShiftLeftLanes<4>(tag, sums));
}

// Several vectors of rows at once: each sum depends on the one before it, but not on other rows.
template <int kVectors>
HWY_INLINE void sum_rows(const std::uint8_t* from, std::ptrdiff_t from_stride, int width,
                         std::uint16_t* to, std::ptrdiff_t to_stride) {
  const Pixels pixel_tag;
  const Sums tag;
  const auto none = hn::Zero(pixel_tag);
  hn::Vec<Sums> before[kVectors];
  for (auto& sum : before) sum = hn::Zero(tag);
  for (int row = 0; row < kVectors * kRowsInVector; ++row) to[row * to_stride] = 0;
  for (int x = 0; x < width; x += kStep) {
    HWY_UNROLL(2)
    for (int v = 0; v < kVectors; ++v) {
      const std::ptrdiff_t first = v * kRowsInVector;
      const auto pixels = load_rows(pixel_tag, from + first * from_stride + x, from_stride);
      const auto left = hn::BitCast(tag, hn::InterleaveLower(pixel_tag, pixels, none));
      const auto right = hn::BitCast(tag, hn::InterleaveUpper(pixel_tag, pixels, none));
      const auto left_sums = hn::Add(sum_along_blocks(left), before[v]);
      const auto right_sums = hn::Add(sum_along_blocks(right), hn::Broadcast<7>(left_sums));
      std::uint16_t* place = to + first * to_stride + x + 1;
      store_rows(left_sums, tag, place, to_stride);
      store_rows(right_sums, tag, place + kStep / 2, to_stride);
      before[v] = hn::Broadcast<7>(right_sums);
    }
  }
}

HWY_INLINE void sum_row(const std::uint8_t* from, int width, std::uint16_t* to) {
  to[0] = 0;
  for (int x = 0; x < width; ++x) to[x + 1] = static_cast<std::uint16_t>(to[x] + from[x]);
}

void sum_picture(ImageView<const std::uint8_t> picture, std::uint16_t* to, std::ptrdiff_t stride) {
  int y = 0;
  const std::ptrdiff_t picture_stride = picture.row(1) - picture.row(0);
  const auto sum = [&](auto vectors, int first) HWY_ATTR {
    sum_rows<vectors()>(picture.row(first), picture_stride, picture.width(), to + first * stride,
                        stride);
  };
  const std::integral_constant<int, 1> one;
  const std::integral_constant<int, 2> two;
  for (; y + two * kRowsInVector <= picture.height(); y += two * kRowsInVector) sum(two, y);
  for (; y + kRowsInVector <= picture.height(); y += kRowsInVector) sum(one, y);
  // The last vector may repeat rows of the one before it.
  if (y < picture.height() && picture.height() >= kRowsInVector) {
    y = picture.height();
    sum(one, y - kRowsInVector);
  }
  for (; y < picture.height(); ++y) sum_row(picture.row(y), picture.width(), to + y * stride);
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {

HWY_EXPORT(sum_picture);

void RowSums::resize(const Region& place) {
  place_ = place;
  // Pixels are read and sums written in whole steps.
  pixel_stride_ = (place.width + kStep - 1) / kStep * kStep;
  const auto pixels = static_cast<std::size_t>(pixel_stride_ * place.height);
  if (pixels_.size() < pixels) pixels_.resize(pixels);
  // Whole cache lines, an odd number of them, so that rows do not compete for the same ones.
  constexpr std::ptrdiff_t kLine = 64 / sizeof(std::uint16_t);
  stride_ = ((pixel_stride_ + 1 + kLine - 1) / kLine | 1) * kLine;
  const auto size = static_cast<std::size_t>(stride_ * place.height + kSlack);
  if (sums_.size() < size) sums_.resize(size);
}

void RowSums::sum_up(int first, int last) {
  const auto leave_dark = [this](int from, int to) {
    for (int y = from; y < to; ++y) {
      std::fill_n(sums_.data() + y * stride_, place_.width + 1, std::uint16_t{0});
    }
  };
  leave_dark(0, first);
  leave_dark(last, place_.height);
  HWY_DYNAMIC_DISPATCH(sum_picture)
  (picture().part(0, first, place_.width, last - first), sums_.data() + first * stride_, stride_);
}

}  // namespace puck
#endif
