#pragma once

#include <cstdint>
#include <optional>

#include "common/io/cd_word_decoder.h"

namespace puck {

/// Prophesee EVT 4.0: as EVT 2.0 with other types, and vectors: a word as of an event, and a second
/// one that is a mask of the 32 pixels from its x on. Skips triggers, monitoring and padding.
class Evt4Decoder final : public CdWordDecoder {
 public:
  explicit Evt4Decoder(SensorSize sensor, std::int64_t reorder_us = 0)
      : CdWordDecoder(sensor, reorder_us, kDarker, kTime) {}

 private:
  static constexpr std::uint32_t kDarker = 0xA;
  static constexpr std::uint32_t kDarkerVector = 0xC;
  static constexpr std::uint32_t kTime = 0xE;

  void take(std::uint32_t word) override;
  bool is_data_next() const override { return vector_.has_value(); }
  void take_vector(std::uint32_t vector, std::uint32_t mask);

  std::optional<std::uint32_t> vector_;  // Whose mask follows.
};

}  // namespace puck
