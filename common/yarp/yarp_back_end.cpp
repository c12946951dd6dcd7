#include "common/yarp/yarp_back_end.h"

#include <chrono>

#include "common/yarp/board_session.h"
#include "common/yarp/port_query.h"
#include "common/yarp/retry_pause.h"
#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

const YarpParams& checked(const YarpParams& params) {
  check(params);
  return params;
}

}  // namespace

YarpBackEnd::YarpBackEnd(const YarpParams& params)
    : params_(checked(params)),
      name_servers_(name_server_addresses(params.host, params.port, "arm.yarp.host")),
      exchange_(std::int64_t{1000} * params.silent_ms),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void YarpBackEnd::command(const JointAngles& set_point, std::int64_t monotonic_us) {
  if (exchange_.give_set_point(set_point, monotonic_us)) waker_.wake();
}

std::optional<JointReading> YarpBackEnd::reading(std::int64_t) { return exchange_.reading(); }

std::string YarpBackEnd::fault(std::int64_t monotonic_us) { return exchange_.fault(monotonic_us); }

std::vector<std::pair<std::string, std::int64_t>> YarpBackEnd::counters(
    std::int64_t monotonic_us) const {
  const YarpCounters now = board_counters(monotonic_us);
  return {{"board_connections", now.connections},
          {"board_failures", now.failures},
          {"board_encoders", now.encoders_received},
          {"board_encoder_age_us", now.encoder_age_us.value_or(-1)},
          {"board_set_points", now.set_points_sent},
          {"board_set_points_replaced", now.set_points_replaced},
          {"board_set_points_unheard", now.set_points_unheard},
          {"board_set_points_refused", now.set_points_refused},
          {"board_set_points_withdrawn", now.set_points_withdrawn},
          {"board_set_points_expired", now.set_points_expired},
          {"board_round_trip_us", now.round_trip_us},
          {"board_round_trip_max_us", now.round_trip_max_us}};
}

void YarpBackEnd::run(const std::stop_token& stop) {
  const std::stop_callback on_stop(stop, [this] { waker_.wake(); });
  const Waiter waiter(stop, waker_);
  RetryPause pause{std::chrono::milliseconds(params_.retry_ms)};
  for (std::size_t i = 0; !waiter.is_stopped(); ++i) {
    const std::int64_t connections_before = exchange_.counters(0).connections;
    const auto failure = serve(name_servers_[i % name_servers_.size()], waiter);
    if (!failure || waiter.is_stopped()) return;
    exchange_.lose_connection(*failure);
    if (exchange_.counters(0).connections > connections_before) pause.restart();
    const Deadline again_at = SteadyClock::now() + pause.take();
    while (!waiter.is_stopped() && SteadyClock::now() < again_at) waiter.wait({}, again_at);
  }
}

std::optional<YarpError> YarpBackEnd::serve(const PortAddress& name_server, const Waiter& waiter) {
  try {
    BoardSession session(params_, name_server, waiter, exchange_);
    try {
      session.run();
    } catch (const YarpError&) {
      if (!waiter.is_stopped()) throw;
    }
    session.leave();
    return std::nullopt;
  } catch (const YarpError& error) {
    return error;
  } catch (const std::exception& error) {
    return YarpError(error.what());
  }
}

}  // namespace puck
