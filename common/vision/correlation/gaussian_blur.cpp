#include "common/vision/correlation/gaussian_blur.h"

#include <algorithm>
#include <cstddef>
#include <span>

// Everything in this file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/correlation/gaussian_blur.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Binomial weights, in 16ths, as OpenCV uses for five pixels when it chooses sigma itself. Two
// passes fit into 16 bits: 16 · 16 · 255 = 65280, plus the rounding half.

// Calls `blur_at(tag, x)` until `count` pixels are blurred, with the widest vectors that they fill;
// the last one may overlap the one before it.
template <typename Tag, typename BlurAt>
HWY_INLINE void blur_all(Tag tag, std::size_t count, const BlurAt& blur_at) {
  const std::size_t lanes = hn::Lanes(tag);
  if (count < lanes) {
    if constexpr (hn::MaxLanes(Tag()) > 1) blur_all(hn::Half<Tag>(), count, blur_at);
    return;
  }
  std::size_t x = 0;
  for (; x + lanes <= count; x += lanes) blur_at(tag, x);
  if (x < count) blur_at(tag, count - lanes);
}

// Weights five rows each, starting at rows[0]; `rows` has four rows more than are written.
void blur_down(std::span<const std::uint8_t* const> rows, std::size_t count, std::uint16_t* to,
               std::ptrdiff_t stride) {
  // Four sums of two neighbouring rows: weights 1, 4, 6, 4, 1.
  const auto blur_at = [&](auto d16, std::size_t x) HWY_ATTR {
    const hn::Rebind<std::uint8_t, decltype(d16)> d8;
    const auto none = hn::Zero(d16);
    auto row = none;
    auto two = none;
    auto three = none;
    auto four = none;
    std::uint16_t* out = to + x;
    for (std::size_t y = 0; y < rows.size(); ++y) {
      const auto next_row = hn::PromoteTo(d16, hn::LoadU(d8, rows[y] + x));
      const auto next_two = hn::Add(row, next_row);
      const auto next_three = hn::Add(two, next_two);
      const auto next_four = hn::Add(three, next_three);
      if (y >= 4) {
        hn::StoreU(hn::Add(four, next_four), d16, out);
        out += stride;
      }
      row = next_row;
      two = next_two;
      three = next_three;
      four = next_four;
    }
  };
  blur_all(hn::ScalableTag<std::uint16_t>(), count, blur_at);
}

// Weights five neighbours in each row, starting at `from`.
void blur_across(const std::uint16_t* from, std::ptrdiff_t stride, ImageView<std::uint8_t> out) {
  for (int y = 0; y < out.height(); ++y, from += stride) {
    std::uint8_t* to = out.row(y);
    const auto blur_at = [&](auto d16, std::size_t x) HWY_ATTR {
      const hn::Rebind<std::uint8_t, decltype(d16)> d8;
      const hn::RebindToSigned<decltype(d16)> di16;
      const auto at = [&](std::size_t i) HWY_ATTR { return hn::LoadU(d16, from + x + i); };
      const auto middle = at(2);
      const auto inner = hn::Add(hn::Add(at(1), middle), at(3));
      const auto outer = hn::Add(hn::Add(at(0), at(4)), hn::Set(d16, 128));
      const auto sum = hn::Add(hn::Add(hn::ShiftLeft<2>(inner), hn::Add(middle, middle)), outer);
      hn::StoreU(hn::DemoteTo(d8, hn::BitCast(di16, hn::ShiftRight<8>(sum))), d8, to + x);
    };
    blur_all(hn::ScalableTag<std::uint16_t>(), static_cast<std::size_t>(out.width()), blur_at);
  }
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {
namespace {

HWY_EXPORT(blur_down);
HWY_EXPORT(blur_across);

// Mirrors an index about the outermost pixels: −1 → 1, size → size − 2.
int mirrored(int index, int size) {
  if (size == 1) return 0;
  while (index < 0 || index >= size) {
    index = index < 0 ? -index : 2 * (size - 1) - index;
  }
  return index;
}

}  // namespace

void GaussianBlur::apply(ImageView<const std::uint8_t> source, Image<std::uint8_t>& out) {
  out.resize(source.width(), source.height());
  apply(source, {0, 0, source.width(), source.height()}, out.mutable_view());
}

void GaussianBlur::apply(ImageView<const std::uint8_t> source, const Region& part,
                         ImageView<std::uint8_t> out) {
  if (part.empty()) return;
  const Region needed = part.inflated(kRadius);
  const Region there = needed.intersect({0, 0, source.width(), source.height()});
  rows_.clear();
  for (int y = needed.y; y < needed.bottom(); ++y) {
    rows_.push_back(source.row(mirrored(y, source.height())) + there.x);
  }
  down_.resize(needed.width, part.height);
  HWY_DYNAMIC_DISPATCH(blur_down)
  (rows_, static_cast<std::size_t>(there.width), down_.row(0) + (there.x - needed.x), needed.width);
  mirror_columns(needed.x, there.x, needed.x, source.width());
  mirror_columns(there.right(), needed.right(), needed.x, source.width());
  HWY_DYNAMIC_DISPATCH(blur_across)(down_.row(0), needed.width, out);
}

void GaussianBlur::mirror_columns(int first, int last, int first_x, int source_width) {
  for (int x = first; x < last; ++x) {
    const int like = mirrored(x, source_width) - first_x;
    std::uint16_t* row = down_.row(0);
    for (int y = 0; y < down_.height(); ++y, row += down_.width()) row[x - first_x] = row[like];
  }
}

}  // namespace puck
#endif
