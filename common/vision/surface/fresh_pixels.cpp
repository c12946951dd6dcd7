#include "common/vision/surface/fresh_pixels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace puck {
namespace {

using Eight = std::array<std::uint8_t, 8>;

// What is left of eight pixels, by the bits of those that have fired.
constexpr std::array<Eight, 256> kMasks = [] {
  std::array<Eight, 256> masks{};
  for (std::size_t bits = 0; bits < masks.size(); ++bits) {
    for (std::size_t i = 0; i < 8; ++i) masks[bits][i] = (bits >> i & 1) != 0 ? 255 : 0;
  }
  return masks;
}();

// Eight pixels at once, which compilers make one instruction of.
void keep_masked(std::uint8_t* pixels, const Eight& mask) {
  std::uint64_t values;
  std::uint64_t kept;
  std::memcpy(&values, pixels, sizeof values);
  std::memcpy(&kept, mask.data(), sizeof kept);
  values &= kept;
  std::memcpy(pixels, &values, sizeof values);
}

}  // namespace

void FreshRows::darken_stale(const Region& part, ImageView<std::uint8_t> grey) const {
  for (int y = 0; y < part.height; ++y) {
    const std::uint8_t* fired = bits.data() + static_cast<std::ptrdiff_t>(part.y + y) * stride;
    const auto eight_from = [&](int x) {
      const std::uint8_t* byte = fired + x / 8;
      return static_cast<std::uint8_t>((byte[0] | byte[1] << 8) >> x % 8);
    };
    std::uint8_t* pixels = grey.row(y);
    int x = 0;
    for (; x + 8 <= part.width; x += 8) keep_masked(pixels + x, kMasks[eight_from(part.x + x)]);
    if (x == part.width) continue;
    const Eight& mask = kMasks[eight_from(part.x + x)];
    for (std::size_t i = 0; x < part.width; ++x, ++i) pixels[x] &= mask[i];
  }
}

FreshPixels::FreshPixels(SensorSize sensor)
    // At least a byte more than a row needs, since eight pixels from anywhere are read from two.
    : stride_(sensor.width / 8 + 2) {
  for (std::vector<std::uint8_t>& fired : fired_) {
    fired.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(sensor.height));
  }
}

void FreshPixels::take(Timestamp start, std::span<const Event> events) {
  for (const Event& event : events) {
    const std::int64_t time_us = (start + event.offset_us).us;
    if (time_us >= turn_us_) turn_over(time_us);
    const auto row = static_cast<std::size_t>(event.y) * static_cast<std::size_t>(stride_);
    fired_[0][row + event.x / 8u] |= static_cast<std::uint8_t>(1u << event.x % 8u);
  }
}

void FreshPixels::turn_over(std::int64_t time_us) {
  for (std::size_t i = 0; i < kPeriods && turn_us_ <= time_us; ++i) {
    std::rotate(fired_.begin(), fired_.end() - 1, fired_.end());
    std::fill(fired_[0].begin(), fired_[0].end(), std::uint8_t{0});
    turn_us_ += kPeriod_us;
  }
  turn_us_ = (time_us / kPeriod_us + 1) * kPeriod_us;
}

void FreshPixels::copy_rows(const Region& region, FreshRows& out) const {
  out.stride = stride_;
  out.bits.resize(fired_[0].size());
  const auto first = static_cast<std::size_t>(region.y) * static_cast<std::size_t>(stride_);
  const auto last = static_cast<std::size_t>(region.bottom()) * static_cast<std::size_t>(stride_);
  for (std::size_t i = first; i < last; ++i) {
    out.bits[i] = fired_[0][i] | fired_[1][i] | fired_[2][i] | fired_[3][i];
  }
}

}  // namespace puck
