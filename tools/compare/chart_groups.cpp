#include "tools/compare/chart_groups.h"

#include "tools/compare/sequence_plan.h"

namespace puck {

void add_legend(Chart& chart) {
  std::size_t number = 0;
  for (const Contestant& contestant : contestants()) {
    chart.legend(contestant.name, series_ink(number++));
  }
}

double place_in_group(std::size_t group, std::size_t contestant) {
  const auto count = static_cast<double>(contestants().size());
  return static_cast<double>(group) + 0.1 + 0.8 * (static_cast<double>(contestant) + 0.5) / count;
}

double half_width_in_group() { return 0.32 / static_cast<double>(contestants().size()); }

}  // namespace puck
