#pragma once

#include <cstdint>

#include "common/io/event_sink.h"
#include "common/io/sensor_clock.h"
#include "common/io/word_assembler.h"

namespace puck {

/// Ends a stream of words: accepts its newest time word, and counts an incomplete word.
template <typename Word>
void finish_words(WordAssembler<Word>& words, SensorClock& clock, EventSink& sink) {
  EventPacket nothing;
  sink.begin(nothing, 0);
  clock.finish(sink);
  sink.counters().truncated_bytes += static_cast<std::int64_t>(words.partial_bytes());
  words.reset();
}

}  // namespace puck
