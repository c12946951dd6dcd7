#include "tests/bench/eros_plain.h"

#include <cmath>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace puck {
namespace {

constexpr int kMaxHalfWidth = 8;
constexpr float kFixedOne = 256;

template <PlainDecay kForm, typename Pixel>
Pixel decayed(Pixel value, float decay, std::uint32_t fixed_decay) {
  if constexpr (kForm == PlainDecay::kByteFixedPoint) {
    return static_cast<Pixel>(value * fixed_decay >> 8);
  } else {
    return static_cast<Pixel>(static_cast<float>(value) * decay);
  }
}

}  // namespace

// Arrays instead of vectors: this file is compiled for one machine, so no code that it shares with
// other files may be generated here.
struct PlainEros::Surface {
  int half_width;
  int stride;
  float decay;
  PlainDecay form;
  std::unique_ptr<std::uint8_t[]> bytes;
  std::unique_ptr<float[]> floats;

  template <PlainDecay kForm, int kHalfWidth, typename Pixel>
  void apply(Pixel* pixels, const Event* event, const Event* end) const {
    constexpr int kSide = 2 * kHalfWidth + 1;
    const std::ptrdiff_t row_step = stride;
    const float factor = decay;
    const auto fixed_factor = static_cast<std::uint16_t>(std::lround(decay * kFixedOne));
    for (; event != end; ++event) {
      Pixel* row = pixels + event->y * row_step + event->x;
      Pixel* const centre = row + kHalfWidth * row_step + kHalfWidth;
      for (int r = 0; r < kSide; ++r, row += row_step) {
        for (int c = 0; c < kSide; ++c) {
          row[c] = decayed<kForm>(row[c], factor, fixed_factor);
        }
      }
      *centre = 255;
    }
  }

  template <PlainDecay kForm, typename Pixel>
  void apply_any_width(Pixel* pixels, const Event* event, const Event* end) const {
    switch (half_width) {
      case 1:
        return apply<kForm, 1>(pixels, event, end);
      case 2:
        return apply<kForm, 2>(pixels, event, end);
      case 3:
        return apply<kForm, 3>(pixels, event, end);
      case 4:
        return apply<kForm, 4>(pixels, event, end);
      case 5:
        return apply<kForm, 5>(pixels, event, end);
      case 6:
        return apply<kForm, 6>(pixels, event, end);
      case 7:
        return apply<kForm, 7>(pixels, event, end);
      case 8:
        return apply<kForm, 8>(pixels, event, end);
    }
  }

  void apply_floats(const Event* event, const Event* end) const {
#ifdef __SSE__
    const unsigned before = _MM_GET_FLUSH_ZERO_MODE();
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
#endif
    apply_any_width<PlainDecay::kFloat>(floats.get(), event, end);
#ifdef __SSE__
    _MM_SET_FLUSH_ZERO_MODE(before);
#endif
  }
};

PlainEros::PlainEros(SensorSize size, int half_width_px, double decay, PlainDecay form)
    : surface_(new Surface{half_width_px, size.width + 2 * kMaxHalfWidth, static_cast<float>(decay),
                           form, nullptr, nullptr}) {
  const int pixels = surface_->stride * (size.height + 2 * kMaxHalfWidth);
  if (form == PlainDecay::kFloat) {
    surface_->floats.reset(new float[static_cast<std::size_t>(pixels)]());
  } else {
    surface_->bytes.reset(new std::uint8_t[static_cast<std::size_t>(pixels)]());
  }
}

PlainEros::~PlainEros() = default;

void PlainEros::update(std::span<const Event> events) {
  const Event* const begin = events.data();
  const Event* const end = begin + events.size();
  switch (surface_->form) {
    case PlainDecay::kByteTimesFloat:
      return surface_->apply_any_width<PlainDecay::kByteTimesFloat>(surface_->bytes.get(), begin,
                                                                    end);
    case PlainDecay::kByteFixedPoint:
      return surface_->apply_any_width<PlainDecay::kByteFixedPoint>(surface_->bytes.get(), begin,
                                                                    end);
    case PlainDecay::kFloat:
      return surface_->apply_floats(begin, end);
  }
}

double PlainEros::at(int x, int y) const {
  const int index = (y + surface_->half_width) * surface_->stride + x + surface_->half_width;
  return surface_->floats ? surface_->floats[static_cast<std::size_t>(index)]
                          : surface_->bytes[static_cast<std::size_t>(index)];
}

}  // namespace puck
