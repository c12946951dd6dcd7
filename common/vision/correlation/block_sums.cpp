#include "common/vision/correlation/block_sums.h"

#include <algorithm>
#include <cstddef>

// Everything in this file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/correlation/block_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Sums one row of blocks, as high as `band`; the last block may be narrower.
void sum_blocks(ImageView<const std::uint8_t> band, std::uint32_t* sums) {
  constexpr int kSide = 8;
  int x = 0;
  const auto sum = [&](auto tag) HWY_ATTR {
    const hn::Repartition<std::uint64_t, decltype(tag)> wide;
    const int lanes = static_cast<int>(hn::Lanes(tag));
    HWY_ALIGN std::uint64_t blocks[hn::MaxLanes(wide)];
    for (; x + lanes <= band.width(); x += lanes) {
      auto total = hn::Zero(wide);
      for (int y = 0; y < band.height(); ++y) {
        total = hn::Add(total, hn::SumsOf8(hn::LoadU(tag, band.row(y) + x)));
      }
      hn::Store(total, wide, blocks);
      for (int i = 0; i < lanes / kSide; ++i) *sums++ = static_cast<std::uint32_t>(blocks[i]);
    }
  };
  sum(hn::ScalableTag<std::uint8_t>());
  sum(hn::Full64<std::uint8_t>());
  for (; x < band.width(); x += kSide) {
    std::uint32_t total = 0;
    for (int y = 0; y < band.height(); ++y) {
      for (int i = x; i < std::min(x + kSide, band.width()); ++i) total += band(i, y);
    }
    *sums++ = total;
  }
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {
namespace {

HWY_EXPORT(sum_blocks);

int blocks_in(int pixels) { return (pixels + BlockSums::kSide - 1) / BlockSums::kSide; }

// The largest number of blocks that so many pixels can touch.
int blocks_touched(int pixels) { return blocks_in(pixels - 1) + 1; }

}  // namespace

void BlockSums::set_picture(ImageView<const std::uint8_t> picture) {
  sums_.resize(blocks_in(picture.width()), blocks_in(picture.height()));
  for (int row = 0; row < sums_.height(); ++row) {
    const int y = row * kSide;
    const int height = std::min(kSide, picture.height() - y);
    HWY_DYNAMIC_DISPATCH(sum_blocks)
    (picture.part(0, y, picture.width(), height), sums_.row(row));
  }
}

std::int64_t BlockSums::most_in(int width, int height) {
  const int across = std::min(blocks_touched(width), sums_.width());
  const int down = std::min(blocks_touched(height), sums_.height());
  if (across <= 0 || down <= 0) return 0;
  const int places = sums_.width() - across + 1;
  of_rows_.resize(places, sums_.height());
  for (int y = 0; y < sums_.height(); ++y) {
    const std::uint32_t* sums = sums_.row(y);
    std::uint32_t run = 0;
    for (int x = 0; x < across; ++x) run += sums[x];
    of_rows_(0, y) = run;
    for (int x = 1; x < places; ++x) {
      run += sums[x + across - 1] - sums[x - 1];
      of_rows_(x, y) = run;
    }
  }
  std::uint32_t most = 0;
  of_columns_.assign(static_cast<std::size_t>(places), 0);
  for (int y = 0; y < sums_.height(); ++y) {
    const std::uint32_t* gained = of_rows_.row(y);
    const std::uint32_t* lost = y < down ? nullptr : of_rows_.row(y - down);
    for (int x = 0; x < places; ++x) {
      std::uint32_t& total = of_columns_[static_cast<std::size_t>(x)];
      total += gained[x] - (lost != nullptr ? lost[x] : 0);
      most = std::max(most, total);
    }
  }
  return most;
}

const std::vector<std::uint32_t>& BlockSums::columns_between(int first, int last) {
  of_columns_.assign(static_cast<std::size_t>(sums_.width()), 0);
  const int first_block = std::max(first, 0) / kSide;
  const int last_block = std::min(blocks_in(std::max(last, 0)), sums_.height());
  for (int row = first_block; row < last_block; ++row) {
    const std::uint32_t* sums = sums_.row(row);
    for (std::size_t x = 0; x < of_columns_.size(); ++x) of_columns_[x] += sums[x];
  }
  return of_columns_;
}

}  // namespace puck
#endif
