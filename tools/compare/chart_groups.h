#pragma once

#include <cstddef>

#include "common/plot/chart.h"

namespace puck {

/// Adds all contestants, each in its own ink.
void add_legend(Chart& chart);

/// Position of a contestant's box or bar in a group, both by their numbers.
double place_in_group(std::size_t group, std::size_t contestant);
double half_width_in_group();

}  // namespace puck
