#include "common/vision/gaussian_blur.h"

#include <algorithm>
#include <cstddef>

// Everything in this file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/gaussian_blur.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Binomial weights, in 16ths: what OpenCV takes for five pixels when it chooses sigma itself. Two
// passes of them fit into 16 bits: 16 · 16 · 255 = 65280, and the half that rounds.
template <typename V>
HWY_INLINE V binomial(V a, V b, V c, V d, V e) {
  const V middle = hn::Add(hn::ShiftLeft<2>(hn::Add(hn::Add(b, c), d)), hn::Add(c, c));
  return hn::Add(hn::Add(a, e), middle);
}

// Calls `blur_at(tag, x)` so that `count` pixels are blurred.
template <typename BlurAt>
HWY_INLINE void blur_all(std::size_t count, const BlurAt& blur_at) {
  const hn::ScalableTag<std::uint16_t> wide;
  const std::size_t lanes = hn::Lanes(wide);
  std::size_t x = 0;
  for (; x + lanes <= count; x += lanes) blur_at(wide, x);
  if (x == count) return;
  // The last vector may overlap the one before it.
  if (count >= lanes) return blur_at(wide, count - lanes);
  for (; x < count; ++x) blur_at(hn::CappedTag<std::uint16_t, 1>(), x);
}

// Weights five neighbours, the first of them at `from`; the pixels end at from[count + 3].
void blur_along_row(const std::uint8_t* HWY_RESTRICT from, std::size_t count,
                    std::uint16_t* HWY_RESTRICT to) {
  const auto blur_at = [&](auto d16, std::size_t x) HWY_ATTR {
    const hn::Rebind<std::uint8_t, decltype(d16)> d8;
    const auto at = [&](std::size_t i)
                        HWY_ATTR { return hn::PromoteTo(d16, hn::LoadU(d8, from + x + i)); };
    hn::StoreU(binomial(at(0), at(1), at(2), at(3), at(4)), d16, to + x);
  };
  blur_all(count, blur_at);
}

void blur_across_rows(const std::uint16_t* HWY_RESTRICT a, const std::uint16_t* HWY_RESTRICT b,
                      const std::uint16_t* HWY_RESTRICT c, const std::uint16_t* HWY_RESTRICT d,
                      const std::uint16_t* HWY_RESTRICT e, std::size_t count,
                      std::uint8_t* HWY_RESTRICT to) {
  const auto blur_at = [&](auto d16, std::size_t x) HWY_ATTR {
    const hn::Rebind<std::uint8_t, decltype(d16)> d8;
    const hn::RebindToSigned<decltype(d16)> di16;
    const auto sum = binomial(hn::LoadU(d16, a + x), hn::LoadU(d16, b + x), hn::LoadU(d16, c + x),
                              hn::LoadU(d16, d + x), hn::LoadU(d16, e + x));
    const auto rounded = hn::ShiftRight<8>(hn::Add(sum, hn::Set(d16, 128)));
    hn::StoreU(hn::DemoteTo(d8, hn::BitCast(di16, rounded)), d8, to + x);
  };
  blur_all(count, blur_at);
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {
namespace {

HWY_EXPORT(blur_along_row);
HWY_EXPORT(blur_across_rows);

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
  const auto along_row = HWY_DYNAMIC_DISPATCH(blur_along_row);
  const auto across_rows = HWY_DYNAMIC_DISPATCH(blur_across_rows);
  const auto count = static_cast<std::size_t>(part.width);
  const int first = std::max(part.y - kRadius, 0);
  const int last = std::min(part.bottom() - 1 + kRadius, source.height() - 1);
  rows_.resize(part.width, last - first + 1);
  padded_row_.resize(part.width + 2 * kRadius, 1);
  int done = part.y;
  for (int y = first; y <= last; ++y) {
    along_row(padded(source.row(y), source.width(), part), count, rows_.row(y - first));
    // A row is finished as soon as the last one that it needs is there, while all are in the cache.
    for (; done < part.bottom() && std::min(done + kRadius, last) <= y; ++done) {
      const auto row = [&](int offset) {
        return rows_.row(mirrored(done + offset, source.height()) - first);
      };
      across_rows(row(-2), row(-1), row(0), row(1), row(2), count, out.row(done - part.y));
    }
  }
}

const std::uint8_t* GaussianBlur::padded(const std::uint8_t* row, int source_width,
                                         const Region& part) {
  const int begin = part.x - kRadius;
  if (begin >= 0 && part.right() + kRadius <= source_width) return row + begin;
  std::uint8_t* to = padded_row_.row(0);
  std::copy_n(row + part.x, part.width, to + kRadius);
  for (int i = 0; i < kRadius; ++i) {
    to[i] = row[mirrored(begin + i, source_width)];
    to[kRadius + part.width + i] = row[mirrored(part.right() + i, source_width)];
  }
  return to;
}

}  // namespace puck
#endif
