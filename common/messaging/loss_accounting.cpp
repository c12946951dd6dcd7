#include "common/messaging/loss_accounting.h"

#include <algorithm>

namespace puck {
namespace {

/// Bound for forged numbers, so that the sum of many gaps cannot overflow.
void add_gap(std::int64_t& total, std::int64_t gap) {
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  total = std::min(total + std::min(gap, kMost), kMost);
}

}  // namespace

Arrival LossAccount::add(std::int64_t session_id, std::int64_t seq, std::int64_t items_before,
                         std::int64_t items) {
  ++counters_.received;
  Session* session = find(session_id);
  Arrival arrival = Arrival::kNewSession;
  if (session == nullptr) {
    ++counters_.sessions;
    session = &longest_silent();
    *session = Session{.id = session_id, .first_seq = seq, .newest_seq = seq, .seen = 1};
  } else if (seq > session->newest_seq) {
    arrival = add_newer(*session, seq, items_before);
  } else {
    arrival = add_older(*session, seq);
  }
  session->last_heard = counters_.received;
  if (seq == session->newest_seq) session->items_expected = items_before + items;
  return arrival;
}

LossAccount::Session* LossAccount::find(std::int64_t id) {
  const auto found = std::find_if(sessions_.begin(), sessions_.end(), [id](const Session& session) {
    return session.last_heard != 0 && session.id == id;
  });
  return found == sessions_.end() ? nullptr : &*found;
}

LossAccount::Session& LossAccount::longest_silent() {
  return *std::min_element(
      sessions_.begin(), sessions_.end(),
      [](const Session& a, const Session& b) { return a.last_heard < b.last_heard; });
}

Arrival LossAccount::add_newer(Session& session, std::int64_t seq, std::int64_t items_before) {
  const std::int64_t step = seq - session.newest_seq;
  add_gap(counters_.lost, step - 1);
  add_gap(counters_.items_lost, std::max<std::int64_t>(items_before - session.items_expected, 0));
  session.seen = step >= kWindow ? 1 : session.seen << step | 1;
  session.newest_seq = seq;
  return Arrival::kNewest;
}

Arrival LossAccount::add_older(Session& session, std::int64_t seq) {
  const std::int64_t age = session.newest_seq - seq;
  if (age < kWindow) {
    const std::uint64_t bit = std::uint64_t{1} << age;
    if ((session.seen & bit) != 0) {
      ++counters_.duplicates;
      return Arrival::kDuplicate;
    }
    session.seen |= bit;
    if (seq >= session.first_seq) --counters_.lost;
  }
  ++counters_.late;
  return Arrival::kLate;
}

}  // namespace puck
