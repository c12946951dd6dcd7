#include "tools/view/recording/time_spans.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

TEST_CASE("spans that are near one another become one, whatever the order") {
  TimeSpans spans(10);
  spans.add({100}, {200});
  spans.add({300}, {400});
  CHECK(spans.spans().size() == 2);
  spans.add({390}, {450});
  CHECK(spans.spans().size() == 2);
  CHECK(spans.spans()[1].end == Timestamp{450});
  spans.add({210}, {290});
  REQUIRE(spans.spans().size() == 1);
  CHECK(spans.spans()[0].begin == Timestamp{100});
  CHECK(spans.spans()[0].end == Timestamp{450});
  spans.add({0}, {10});
  CHECK(spans.spans().front().end == Timestamp{10});
}

TEST_CASE("the next and the previous span are found from any time") {
  TimeSpans spans(0);
  CHECK(!spans.after({0}));
  CHECK(!spans.before({1000}));
  spans.add({100}, {200});
  spans.add({300}, {400});
  CHECK(spans.after({99})->begin == Timestamp{100});
  CHECK(spans.after({100})->begin == Timestamp{300});
  CHECK(!spans.after({300}));
  CHECK(spans.before({301})->begin == Timestamp{300});
  CHECK(spans.before({300})->begin == Timestamp{100});
  CHECK(!spans.before({100}));
  CHECK(spans.end_around({150}) == Timestamp{200});
  CHECK(spans.end_around({250}) == Timestamp{250});
}

}  // namespace
}  // namespace puck
