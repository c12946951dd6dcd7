#include "common/messages/single_publisher.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

using Verdict = SinglePublisher::Verdict;

TEST_CASE("The first publisher is kept until it has been silent for 500 ms") {
  SinglePublisher publisher;
  CHECK(publisher.hear(7, 0, 1'000'000) == Verdict::kNewPublisher);
  CHECK(publisher.hear(8, 0, 1'000'001) == Verdict::kOtherPublisher);
  CHECK(publisher.hear(7, 1, 1'400'000) == Verdict::kAccepted);
  CHECK(publisher.hear(8, 1, 1'900'000) == Verdict::kOtherPublisher);
  CHECK(publisher.hear(8, 2, 1'900'001) == Verdict::kNewPublisher);
  CHECK(publisher.hear(7, 2, 1'900'002) == Verdict::kOtherPublisher);
  CHECK(publisher.session() == 8);
}

TEST_CASE("Late and duplicate messages are reported, even after a silence, and keep no publisher") {
  SinglePublisher publisher;
  publisher.hear(7, 5, 0);
  CHECK(publisher.hear(7, 5, 100'000) == Verdict::kLate);
  CHECK(publisher.hear(7, 4, 400'000) == Verdict::kLate);
  CHECK(publisher.hear(7, 3, 900'000) == Verdict::kLate);
  CHECK(publisher.hear(8, 0, 900'001) == Verdict::kNewPublisher);
}

TEST_CASE("A publisher is silent 500 ms after its last accepted message, and before its first") {
  SinglePublisher publisher;
  CHECK(publisher.is_silent(0));
  publisher.hear(7, 5, 1'000'000);
  publisher.hear(7, 4, 1'400'000);
  CHECK_FALSE(publisher.is_silent(1'500'000));
  CHECK(publisher.is_silent(1'500'001));
}

TEST_CASE("A publisher that returns after a silence is accepted again") {
  SinglePublisher publisher;
  publisher.hear(7, 5, 0);
  CHECK(publisher.hear(7, 6, 2'000'000) == Verdict::kAccepted);
}

}  // namespace
}  // namespace puck
