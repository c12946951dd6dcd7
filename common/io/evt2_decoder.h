#pragma once

#include <cstdint>

#include "common/io/cd_word_decoder.h"

namespace puck {

/// Prophesee EVT 2.0: 32-bit words, 34 bits of time. Skips triggers, monitoring and IMU words.
class Evt2Decoder final : public CdWordDecoder {
 public:
  explicit Evt2Decoder(SensorSize sensor, std::int64_t reorder_us = 0)
      : CdWordDecoder(sensor, reorder_us, kDarker, kTime) {}

 private:
  static constexpr std::uint32_t kDarker = 0x0;
  static constexpr std::uint32_t kTime = 0x8;

  void take(std::uint32_t word) override;
};

}  // namespace puck
