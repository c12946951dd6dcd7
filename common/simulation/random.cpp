#include "common/simulation/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {

Random::Random(std::int64_t seed, std::uint64_t stream) {
  std::uint64_t mixed = static_cast<std::uint64_t>(seed) + stream * 0xd1342543de82ef95u;
  for (std::uint64_t& word : state_) {
    mixed += 0x9e3779b97f4a7c15u;
    std::uint64_t z = mixed;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    word = z ^ (z >> 31);
  }
}

double Random::normal() {
  // Box and Muller; the second number of the pair is dropped, so that the state is only the
  // generator's.
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

int Random::poisson(double mean) {
  // Knuth's product is exact but draws `mean` numbers; above 64 the normal distribution is as good.
  if (mean > 64) {
    return std::max(0, static_cast<int>(std::lround(mean + std::sqrt(mean) * normal())));
  }
  const double limit = std::exp(-mean);
  int count = 0;
  for (double product = uniform(); product > limit; product *= uniform()) ++count;
  return count;
}

}  // namespace puck
