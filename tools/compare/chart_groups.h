#pragma once

#include <cstddef>

#include "common/plot/chart.h"

namespace puck {

/// All contestants, each in the ink of its number.
void add_legend(Chart& chart);

/// Where the box or bar of a contestant, by its number, lies in a group of all, by its number.
double place_in_group(std::size_t group, std::size_t contestant);
double half_width_in_group();

}  // namespace puck
