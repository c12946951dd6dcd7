#include "tools/evaluate/part_reader.h"

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/evaluation/listed_events.h"

namespace puck {
namespace {

std::unique_ptr<ListedEvents> listed(std::vector<std::int64_t> times_us) {
  return std::make_unique<ListedEvents>(std::move(times_us));
}

TEST_CASE("a part starts at the first event, and excludes its end") {
  const std::vector<std::int64_t> part{1'300, 1'400, 1'500};
  for (const std::size_t most : {std::size_t{1}, std::size_t{2}, std::size_t{100}}) {
    auto source = listed({1'000, 1'299, 1'300, 1'400, 1'500, 1'501, 1'600});
    const ListedEvents& all = *source;
    PartReader events(std::move(source), {.from_us = 300, .length_us = 201});
    CHECK(events.begin().us == 1'300);
    CHECK(times_of(events, most) == part);
    // A pipe can be read once only.
    CHECK(all.rewinds() == 0);
    events.rewind();
    CHECK(times_of(events, most) == part);
  }
}

TEST_CASE("without a length a part continues to the end") {
  PartReader events(listed({1'000, 2'000, 3'000}), {.from_us = 1'500});
  CHECK(times_of(events, 10) == std::vector<std::int64_t>{3'000});
  CHECK(RecordingPart{}.is_whole());
  CHECK_FALSE(RecordingPart{.from_us = 1}.is_whole());
  CHECK_FALSE(RecordingPart{.length_us = 1}.is_whole());
}

TEST_CASE("a part without events is empty") {
  PartReader events(listed({1'000, 9'000}), {.from_us = 1'000, .length_us = 1'000});
  CHECK(times_of(events, 10).empty());
}

TEST_CASE("a part beyond the recording's end is refused") {
  try {
    PartReader events(listed({0, 2'500'000}), {.from_us = 3'000'000});
    FAIL("not refused");
  } catch (const std::invalid_argument& error) {
    CHECK(std::string(error.what()) ==
          "the recording is 2.500 s long: nothing is left from 3.000 s on");
  }
  CHECK_THROWS_AS(PartReader(listed({}), {.from_us = 1}), std::invalid_argument);
}

}  // namespace
}  // namespace puck
