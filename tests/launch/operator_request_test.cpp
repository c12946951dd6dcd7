#include "services/launch/operator_request.h"

#include <doctest/doctest.h>

#include "common/messages/host_time.h"

namespace puck {
namespace {

/// Is taken at once, and never confirmed.
class EndlessRequest final : public OperatorRequest {
 public:
  void listen(Bus&, StatusReporter&) override {}
  bool publish(Bus&) override {
    ++published_;
    return true;
  }
  std::string why_not() const override { return "it goes on"; }
  std::string refusal() const override { return refusal_; }
  bool is_in_progress() const override { return true; }
  std::string goal() const override { return "done"; }

  int published_ = 0;
  std::string refusal_;
};

TEST_CASE("a request that is being carried out is waited for longer, but not for ever") {
  EndlessRequest request;
  const std::int64_t begin_us = host_monotonic_us();
  CHECK(make_operator_request({.program = "test", .give_up_us = 50'000, .longest_us = 300'000},
                              {.url = "memq://"}, request, {}) == 1);
  CHECK(host_monotonic_us() - begin_us >= 300'000);
  CHECK(request.published_ > 2);
}

TEST_CASE("a refusal ends a request once it was published as long as it must be") {
  EndlessRequest request;
  request.refusal_ = "no";
  const std::int64_t begin_us = host_monotonic_us();
  CHECK(make_operator_request({.program = "test", .at_least_us = 100'000}, {.url = "memq://"},
                              request, {}) == 1);
  CHECK(host_monotonic_us() - begin_us >= 100'000);
}

}  // namespace
}  // namespace puck
