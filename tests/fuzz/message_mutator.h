#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>

#include "common/messaging/channels.h"
#include "tests/fuzz/message_parts.h"

namespace puck {

/// Changes a few things in a message: values to their limits and beyond, counts with and without
/// their arrays, events. Most results are valid or nearly so, unlike changes of single bits.
/// `mutate_bytes(data, size, max_size)`: the fuzzer's own.
using MutateBytes = std::size_t (*)(std::uint8_t* data, std::size_t size, std::size_t max_size);
Bytes mutate_message(Channel channel, std::span<const std::uint8_t> message,
                     std::mt19937_64& random, MutateBytes mutate_bytes);

}  // namespace puck
