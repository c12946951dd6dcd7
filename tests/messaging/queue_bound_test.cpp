#include "common/messaging/queue_bound.h"

#include <cstddef>
#include <initializer_list>

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20;

}  // namespace

TEST_CASE("a queue has room for as many messages as its bytes, of the largest until one comes") {
  QueueBound bound(32 * kMegabyte, 16384);
  CHECK(bound.messages() == 512);
  CHECK_FALSE(bound.add(60'000));
  CHECK(bound.messages() == 512);
}

TEST_CASE("small messages find room at once when they come first, and up to the most") {
  QueueBound bound(32 * kMegabyte, 16384);
  CHECK(bound.add(5'000));
  CHECK(bound.messages() == 4096);
  QueueBound tiny(32 * kMegabyte, 16384);
  CHECK(tiny.add(1));
  CHECK(tiny.messages() == 16384);
}

TEST_CASE("a large message takes the room of the many small ones at once, and gives it back late") {
  QueueBound bound(32 * kMegabyte, 16384);
  bound.add(1'400);
  CHECK(bound.messages() == 16384);
  CHECK(bound.add(60'000));
  CHECK(bound.messages() == 512);
  for (int i = 0; i < 10; ++i) CHECK_FALSE(bound.add(1'400));
  for (int i = 0; i < 2'000; ++i) bound.add(1'400);
  CHECK(bound.messages() == 16384);
}

TEST_CASE("sizes that hardly vary leave the room as it is") {
  QueueBound bound(32 * kMegabyte, 16384);
  bound.add(1'400);
  for (const std::size_t bytes : {1'300, 1'440, 1'200, 1'430}) CHECK_FALSE(bound.add(bytes));
}

TEST_CASE("there is room for one message, however large") {
  QueueBound bound(1'000, 16384);
  CHECK(bound.messages() == 1);
  bound.add(60'000);
  CHECK(bound.messages() == 1);
}

}  // namespace puck
