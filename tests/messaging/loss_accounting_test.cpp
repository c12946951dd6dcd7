#include "common/messaging/loss_accounting.h"

#include <limits>

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("messages in order are neither lost nor late") {
  LossAccount account;
  CHECK(account.add(7, 0) == Arrival::kNewSession);
  CHECK(account.add(7, 1) == Arrival::kNewest);
  CHECK(account.add(7, 2) == Arrival::kNewest);
  CHECK(account.counters().received == 3);
  CHECK(account.counters().lost == 0);
  CHECK(account.counters().sessions == 1);
}

TEST_CASE("a gap is loss, until the missing message arrives late") {
  LossAccount account;
  account.add(7, 0);
  CHECK(account.add(7, 4) == Arrival::kNewest);
  CHECK(account.counters().lost == 3);
  CHECK(account.add(7, 2) == Arrival::kLate);
  CHECK(account.counters().lost == 2);
  CHECK(account.counters().late == 1);
  CHECK(account.add(7, 2) == Arrival::kDuplicate);
  CHECK(account.add(7, 4) == Arrival::kDuplicate);
  CHECK(account.counters().lost == 2);
  CHECK(account.counters().late == 1);
  CHECK(account.counters().duplicates == 2);
}

TEST_CASE("messages published before the first received one are not lost") {
  LossAccount account;
  CHECK(account.add(7, 1000) == Arrival::kNewSession);
  CHECK(account.counters().lost == 0);
  CHECK(account.add(7, 999) == Arrival::kLate);
  CHECK(account.counters().lost == 0);
}

TEST_CASE("an old message beyond the window of 64 is late and changes nothing else") {
  LossAccount account;
  account.add(7, 0);
  account.add(7, 100);
  CHECK(account.counters().lost == 99);
  CHECK(account.add(7, 100 - 63) == Arrival::kLate);
  CHECK(account.counters().lost == 98);
  CHECK(account.add(7, 100 - 64) == Arrival::kLate);
  CHECK(account.counters().lost == 98);
  CHECK(account.counters().late == 2);
}

TEST_CASE("a new session is a restart, not a loss") {
  LossAccount account;
  account.add(7, 5000);
  CHECK(account.add(8, 0) == Arrival::kNewSession);
  CHECK(account.add(8, 1) == Arrival::kNewest);
  CHECK(account.counters().lost == 0);
  CHECK(account.counters().sessions == 2);
}

TEST_CASE("several publishers on one channel are counted separately") {
  LossAccount account;
  for (std::int64_t seq = 0; seq < 10; ++seq) {
    for (std::int64_t session = 1; session <= 5; ++session) account.add(session, seq);
  }
  CHECK(account.counters().received == 50);
  CHECK(account.counters().lost == 0);
  CHECK(account.counters().sessions == 5);
}

TEST_CASE("of too many sessions the one silent for longest is dropped") {
  LossAccount account;
  for (std::int64_t session = 1; session <= 17; ++session) account.add(session, 0);
  CHECK(account.add(2, 1) == Arrival::kNewest);
  CHECK(account.add(1, 1) == Arrival::kNewSession);
}

TEST_CASE("events in lost packets are counted from the cumulative count") {
  LossAccount account;
  account.add(7, 0, 0, 340);
  account.add(7, 1, 340, 100);
  CHECK(account.counters().items_lost == 0);
  account.add(7, 4, 1000, 50);  // Packets 2 and 3 held 560.
  CHECK(account.counters().items_lost == 560);
  account.add(7, 3, 740, 260);  // Late: whoever drops it does not have its events.
  CHECK(account.counters().items_lost == 560);
  account.add(7, 5, 1050, 1);
  CHECK(account.counters().items_lost == 560);
}

TEST_CASE("forged numbers do not overflow the counters") {
  LossAccount account;
  for (std::int64_t session = 1; session < 3000; ++session) {
    account.add(session, 0);
    account.add(session, std::int64_t{1} << 53, std::int64_t{1} << 53);
  }
  CHECK(account.counters().lost == std::int64_t{1} << 53);
}

}  // namespace puck
