#include "common/vision/surface/grey_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/surface/grey_table.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Replaces bytes in whole vectors; returns the number replaced. `grey_after` holds `sixteens` times
// 16 values; all beyond are 0.
std::size_t look_up(std::span<std::uint8_t> counts, const std::uint8_t* grey_after, int sixteens) {
  const hn::ScalableTag<std::uint8_t> tag;
  const std::size_t lanes = hn::Lanes(tag);
  // An index of 128 and more looks up 0. A saturated addition of 112 moves all indices but 0 to 15
  // there, wrapped negative ones included; of the others only the lowest four bits count.
  const auto beyond = hn::Set(tag, 112);
  const auto index_bits = hn::Set(tag, 0x8f);
  std::size_t done = 0;
  for (; done + lanes <= counts.size(); done += lanes) {
    auto n = hn::Sub(hn::Set(tag, 255), hn::LoadU(tag, counts.data() + done));
    auto grey = hn::Zero(tag);
    for (int i = 0; i < sixteens; ++i) {
      const auto table = hn::LoadDup128(tag, grey_after + 16 * i);
      const auto index = hn::And(hn::SaturatedAdd(n, beyond), index_bits);
      grey = hn::Or(grey, hn::TableLookupBytesOr0(table, index));
      n = hn::Sub(n, hn::Set(tag, 16));
    }
    hn::StoreU(grey, tag, counts.data() + done);
  }
  return done;
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {
namespace {

HWY_EXPORT(look_up);

// Copies the columns of a strip that lie in the picture. A constant number of columns saves a call
// for each row.
template <int kColumns>
void copy_columns(const std::uint8_t* strip, ImageView<std::uint8_t> out, int first_column) {
  for (int y = 0; y < out.height(); ++y, strip += kColumns) {
    std::memcpy(out.row(y) + first_column, strip, kColumns);
  }
}

void copy_some_columns(const std::uint8_t* strip, int strip_width, ImageView<std::uint8_t> out,
                       int first_column) {
  const int first = std::max(first_column, 0);
  const int last = std::min(first_column + strip_width, out.width());
  for (int y = 0; y < out.height(); ++y, strip += strip_width) {
    std::memcpy(out.row(y) + first, strip + first - first_column,
                static_cast<std::size_t>(last - first));
  }
}

}  // namespace

GreyValues eros_greys(double decay, ErosRounding rounding) {
  GreyValues greys{};
  int truncated = 255;
  // The last byte stays dark: a pixel that never fired, or not for 255 neighbouring events.
  for (int n = 0; n < 255; ++n) {
    greys[static_cast<std::size_t>(255 - n)] = static_cast<std::uint8_t>(
        rounding == ErosRounding::kNearest ? std::lround(255 * std::pow(decay, n)) : truncated);
    truncated = static_cast<int>(truncated * decay);
  }
  return greys;
}

GreyTable::GreyTable(const GreyValues& greys) : grey_of_count_(greys) {
  std::reverse_copy(greys.begin(), greys.end(), grey_after_.begin());
  for (int n = 0; n < 256; ++n) {
    if (grey_after_[static_cast<std::size_t>(n)] > 0) sixteens_ = n / 16 + 1;
  }
}

void GreyTable::develop(SurfaceCounts& counts, ImageView<std::uint8_t> out) const {
  if (out.empty()) return;
  apply(counts.strips);
  const int width = counts.strip_width;
  const std::uint8_t* strip = counts.strips.data();
  for (int column = counts.first_column; column < out.width(); column += width) {
    if (column < 0 || column + width > out.width()) {
      copy_some_columns(strip, width, out, column);
    } else if (width == 8) {
      copy_columns<8>(strip, out, column);
    } else if (width == 10) {
      copy_columns<10>(strip, out, column);
    } else {
      copy_some_columns(strip, width, out, column);
    }
    strip += width * out.height();
  }
}

void GreyTable::apply(std::span<std::uint8_t> counts) const {
  const std::size_t done = HWY_DYNAMIC_DISPATCH(look_up)(counts, grey_after_.data(), sixteens_);
  for (std::uint8_t& count : counts.subspan(done)) count = grey_of_count_[count];
}

}  // namespace puck
#endif
