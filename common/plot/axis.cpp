#include "common/plot/axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace puck {
namespace {

constexpr int kSteps = 5;
constexpr double kFarBelow = -10;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// 1, 2 or 5 times a power of ten, so that about kSteps of them make the range.
double round_step(double range) {
  const double rough = range / kSteps;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double share = rough / power;
  return power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

std::vector<Axis::Tick> linear_ticks(double low, double high) {
  std::vector<Axis::Tick> ticks;
  const double step = round_step(high - low);
  const double slack = 1e-9 * step;
  for (double n = std::ceil((low - slack) / step); n * step <= high + slack; ++n) {
    const double value = n * step + 0.0;  // Avoids −0.
    ticks.push_back({value, number(value)});
  }
  return ticks;
}

std::vector<Axis::Tick> decades(double low, double high) {
  std::vector<Axis::Tick> ticks;
  for (double power = std::pow(10, std::floor(std::log10(low))); power <= high * 1.001;
       power *= 10) {
    for (int times = 1; times < 10; ++times) {
      const double value = power * times;
      if (value < low * 0.999 || value > high * 1.001) continue;
      ticks.push_back({value, times == 1 ? number(value) : std::string()});
    }
  }
  return ticks;
}

}  // namespace

std::vector<Axis::Tick> Axis::ticks() const {
  if (!things.empty()) {
    std::vector<Tick> ticks;
    for (const std::string& thing : things) {
      ticks.push_back({static_cast<double>(ticks.size()) + 0.5, thing});
    }
    return ticks;
  }
  const auto [low, high] = std::minmax(from, to);
  return logarithmic ? decades(low, high) : linear_ticks(low, high);
}

double Axis::fraction(double value) const {
  if (!things.empty()) return value / static_cast<double>(things.size());
  if (!logarithmic) return (value - from) / (to - from);
  if (!(value > 0)) return kFarBelow;
  return std::log(value / from) / std::log(to / from);
}

Axis axis_from_zero(std::string label, double largest) {
  return {.label = std::move(label), .to = largest > 0 ? 1.05 * largest : 1};
}

Axis logarithmic_axis(std::string label, double smallest, double largest) {
  const double low = smallest > 0 ? smallest : 0.1;
  const double high = std::max(largest, low);
  const double from = std::pow(10, std::floor(std::log10(low)));
  const double to = std::pow(10, std::ceil(std::log10(high)));
  return {.label = std::move(label),
          .from = from,
          .to = to > from ? to : 10 * from,
          .logarithmic = true};
}

}  // namespace puck
