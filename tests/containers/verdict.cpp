#include "tests/containers/verdict.h"

#include <array>
#include <cstdint>
#include <cstdio>

namespace puck {

// All the containers share a few busy cores: a machine may stall for a second without a fault of
// ours.
constexpr std::int64_t kPatience = 4;

void Verdict::demand_within(const std::string& what, bool came, std::int64_t took_us,
                            std::int64_t asked_us) {
  if (!came) {
    demand(false, what + ": never");
    return;
  }
  const std::string asked = std::to_string(asked_us / 1000) + " ms";
  const std::string took = what + " after " + std::to_string(took_us / 1000) + " ms";
  note(took);
  demand(took_us <= kPatience * asked_us, took + "; asked for: " + asked);
}

std::string figure_text(double value, int decimals, const std::string& unit) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data() + (unit.empty() ? "" : " " + unit);
}

}  // namespace puck
