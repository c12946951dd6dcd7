#include "common/messaging/pong_book.h"

#include <algorithm>
#include <utility>

#include "common/messages/host_time.h"

namespace puck {
namespace {

// An older pong is useless; its publisher is gone.
constexpr std::int64_t kLifeUs = 2'000'000;
constexpr std::size_t kMost = 64;
// New runs never displace a run that was heard this often.
constexpr int kOftenHeard = 3;
constexpr std::ptrdiff_t kAtOnce = 8;
constexpr std::ptrdiff_t kOfNew = 2;

}  // namespace

bool PongBook::hear(const service_status_t& status, const Receipt& receipt) {
  const auto known = std::find_if(pongs_.begin(), pongs_.end(),
                                  [&](const Pong& pong) { return pong.session == status.session; });
  if (known == pongs_.end()) {
    keep({.session = status.session,
          .utime = status.utime,
          .received_utime = receipt.utime,
          .received_monotonic_us = receipt.monotonic_us,
          .times_heard = 1,
          .waits_since_us = receipt.monotonic_us});
    return true;
  }
  known->utime = status.utime;
  known->received_utime = receipt.utime;
  known->received_monotonic_us = receipt.monotonic_us;
  known->times_heard = std::min(known->times_heard + 1, kOftenHeard);
  return false;
}

void PongBook::keep(const Pong& pong) {
  if (pongs_.size() < kMost) {
    pongs_.push_back(pong);
    return;
  }
  const auto least =
      std::min_element(pongs_.begin(), pongs_.end(), [](const Pong& a, const Pong& b) {
        return std::pair(a.times_heard >= kOftenHeard, a.received_monotonic_us) <
               std::pair(b.times_heard >= kOftenHeard, b.received_monotonic_us);
      });
  if (least->times_heard < kOftenHeard) *least = pong;
}

bool PongBook::answer(service_status_t& message) {
  const std::int64_t now_us = host_monotonic_us();
  std::erase_if(pongs_,
                [&](const Pong& pong) { return pong.received_monotonic_us < now_us - kLifeUs; });
  std::sort(pongs_.begin(), pongs_.end(),
            [](const Pong& a, const Pong& b) { return a.waits_since_us < b.waits_since_us; });
  const auto new_ones = std::stable_partition(pongs_.begin(), pongs_.end(), [](const Pong& pong) {
    return pong.times_heard >= kOftenHeard;
  });
  const std::ptrdiff_t often = new_ones - pongs_.begin();
  const std::ptrdiff_t kept = std::min(pongs_.end() - new_ones, kOfNew);
  const std::ptrdiff_t of_often = std::min(often, kAtOnce - kept);
  const std::ptrdiff_t of_new = std::min(pongs_.end() - new_ones, kAtOnce - of_often);
  add(pongs_.begin(), of_often, now_us, message);
  add(new_ones, of_new, now_us, message);
  return std::any_of(new_ones, pongs_.end(), [](const Pong& pong) { return !pong.is_answered; });
}

void PongBook::add(Place first, std::ptrdiff_t count, std::int64_t now_us,
                   service_status_t& message) {
  std::for_each_n(first, count, [&](Pong& pong) {
    pong.waits_since_us = now_us;
    pong.is_answered = true;
    message.pong_session.push_back(pong.session);
    message.pong_utime.push_back(pong.utime);
    message.pong_received_utime.push_back(pong.received_utime);
  });
}

}  // namespace puck
