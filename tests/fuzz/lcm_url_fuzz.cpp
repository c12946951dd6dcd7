// The bus's address and names, as users, files and other machines may write them.
#include <string>

#include "common/messaging/bus_error.h"
#include "common/messaging/channels.h"
#include "common/messaging/lcm_url.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const puck::LcmUrl url = puck::parse_lcm_url(text);
    const std::string canonical = url.to_string();
    puck::require(puck::parse_lcm_url(canonical).to_string() == canonical,
                  "a URL that was taken is taken again");
  } catch (const puck::BusError&) {
  }
  try {
    puck::check_prefix(text);
    const std::string name = puck::channel_name(puck::Channel::kEvents, text);
    puck::require(puck::find_channel(name, text) == puck::Channel::kEvents,
                  "a channel is found by its name");
  } catch (const puck::BusError&) {
  }
  for (const char* prefix : {"", "LEFT"}) {
    const auto channel = puck::find_channel(text, prefix);
    if (channel) {
      puck::require(puck::channel_name(*channel, prefix) == text, "a name is of one channel");
    }
  }
  return 0;
}
