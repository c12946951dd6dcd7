#include "common/simulation/puck_serve.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "common/simulation/table_game.h"

namespace puck {

TEST_CASE("A served puck is pushed from one place to another and left there at rest") {
  const TablePoint from{2.2, 0};
  const TablePoint to{1.5, 0.2};
  PuckServe serve(from, to);
  constexpr double kStep_s = 1e-3;
  DiscState puck{from, {}};
  double fastest_m_s = 0;
  int steps = 0;
  while (serve.is_under_way()) {
    const DiscState next = serve.step(kStep_s);
    const double vx_m_s = (next.position.x_m - puck.position.x_m) / kStep_s;
    CHECK(std::abs(vx_m_s - next.velocity.x_m_s) < 0.02);
    fastest_m_s = std::max(fastest_m_s, std::abs(vx_m_s));
    puck = next;
    ++steps;
  }
  CHECK(std::abs(steps - 500) <= 1);
  CHECK(puck.position.x_m == doctest::Approx(to.x_m));
  CHECK(puck.position.y_m == doctest::Approx(to.y_m));
  CHECK(std::hypot(puck.velocity.x_m_s, puck.velocity.y_m_s) < 1e-6);
  // A quarter of a sine is π/2 times as fast at its start as on average.
  CHECK(fastest_m_s == doctest::Approx(0.7 / 0.5 * 1.5708).epsilon(0.01));
}

TEST_CASE("A game that begins with a serve has its first puck come out of the opponent's goal") {
  SimulationParams params;
  CHECK(TableGame(params).puck()->position.x_m < 0.8 * params.table.length_m);
  params.game.served_at_start = true;
  TableGame game(params);
  CHECK(game.puck()->position.x_m == doctest::Approx(params.table.length_m).epsilon(0.02));
  for (int step = 0; step < 20'000; ++step) game.step();
  CHECK(game.puck()->position.x_m < 0.8 * params.table.length_m);
}

}  // namespace puck
