#include "services/launch/operator_request.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>

#include <spdlog/fmt/fmt.h>

#include "common/messages/host_time.h"

namespace puck {
namespace {

constexpr std::int64_t kPeriodUs = 20'000;
constexpr std::chrono::milliseconds kHandle{5};

int fail(const std::string& program, const std::string& reason) {
  std::fprintf(stderr, "%s: %s\n", program.c_str(), reason.c_str());
  return 1;
}

}  // namespace

int make_operator_request(const OperatorParams& operation, const BusParams& params,
                          OperatorRequest& request, std::stop_token stop) {
  Bus bus(params);
  // Others must know our clock before they accept a request as current, and we theirs.
  StatusReporter status(bus, "puck-operator");
  request.listen(bus, status);
  std::stop_source give_up;
  const std::stop_callback on_stop(stop, [&] { give_up.request_stop(); });
  std::string no_route;
  const bool started = bus.start(give_up.get_token(), [&](const std::string& reason) {
    no_route = reason;
    give_up.request_stop();
  });
  if (!started) return no_route.empty() ? 1 : fail(operation.program, no_route);

  const std::int64_t begin_us = host_monotonic_us();
  std::int64_t give_up_us = begin_us + operation.give_up_us;
  std::optional<std::int64_t> first_sent_us;
  std::int64_t next_us = begin_us;
  while (!stop.stop_requested()) {
    bus.handle(kHandle);
    status.poll([](StatusReport&) {});
    const std::int64_t now_us = host_monotonic_us();
    if (now_us >= next_us) {
      next_us = now_us + kPeriodUs;
      if (request.publish(bus) && !first_sent_us) first_sent_us = now_us;
    }
    const bool sent_enough = first_sent_us && now_us - *first_sent_us >= operation.at_least_us;
    if (const std::string reason = request.refusal(); sent_enough && !reason.empty()) {
      return fail(operation.program, "refused: " + reason);
    }
    if (sent_enough && request.why_not().empty()) {
      std::printf("%s: %s\n", operation.program.c_str(), request.result().c_str());
      return 0;
    }
    if (request.is_in_progress()) {
      give_up_us = std::min(now_us + operation.give_up_us, begin_us + operation.longest_us);
    }
    if (now_us > give_up_us) break;
  }
  return fail(operation.program,
              fmt::format("not confirmed to be {} within {:.2g} s: {}", request.goal(),
                          static_cast<double>(give_up_us - begin_us) * 1e-6, request.why_not()));
}

}  // namespace puck
