// Valid messages of any content and order for the bridge, and for the arm that it commands.
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include <fuzzer/FuzzedDataProvider.h>

#include "common/control/arm_controller.h"
#include "common/messaging/conversions.h"
#include "common/play/play_bridge.h"
#include "tests/fuzz/require.h"
#include "tests/support/test_camera.h"

namespace puck {
namespace {

template <typename Message>
bool is_valid(Message& message) {
  std::vector<std::uint8_t> bytes;
  encode(message, bytes);
  return !check_message(kChannelOf<Message>, bytes);
}

class Play {
 public:
  explicit Play(FuzzedDataProvider& input)
      : input_(input), bridge_({}, test_camera(), TableGeometry{}), arm_({}, kArmSession) {}

  void go_on() {
    switch (input_.ConsumeIntegralInRange(0, 4)) {
      case 0:
        return hear_estimate();
      case 1:
        return hear_arm_state();
      case 2:
        return hear_head();
      case 3:
        return hear_command();
      default:
        return step();
    }
  }

 private:
  static constexpr std::int64_t kArmSession = 1001;
  static constexpr std::int64_t kBridgeSession = 2001;
  static constexpr ClockOffset kOwnClock{};

  std::int64_t session() { return input_.ConsumeIntegralInRange<std::int64_t>(3001, 3003); }
  bool rarely() { return input_.ConsumeIntegral<std::uint8_t>() < 16; }

  /// The sender's clock: mostly ours, now and then another, or unknown.
  SenderClock clock() {
    if (!rarely()) return kOwnClock;
    constexpr std::int64_t kFar = std::int64_t{1} << 53;
    if (input_.ConsumeBool()) return std::nullopt;
    return ClockOffset{input_.ConsumeIntegralInRange(-kFar, kFar),
                       input_.ConsumeIntegralInRange<std::int64_t>(0, kFar)};
  }

  /// Mostly unchanged; now and then any value.
  void spoil(double& value) {
    constexpr std::array kEnds{0.0,
                               -1.0,
                               1e-300,
                               1e18,
                               -1e18,
                               std::numeric_limits<double>::max(),
                               std::numeric_limits<double>::lowest(),
                               std::numeric_limits<double>::denorm_min()};
    if (!rarely()) return;
    value = input_.ConsumeBool() ? input_.PickValueInArray(kEnds)
                                 : std::bit_cast<double>(input_.ConsumeIntegral<std::uint64_t>());
  }
  void spoil(std::int64_t& value) {
    if (rarely()) value = input_.ConsumeIntegral<std::int64_t>();
  }
  template <typename Message>
  void fill_header(Message& message, std::int64_t seq) {
    message.utime = now_.utime - input_.ConsumeIntegralInRange(0, 1000);
    message.session = session();
    message.seq = seq;
    spoil(message.utime);
    spoil(message.seq);
  }

  void hear_estimate() {
    PublishedEstimate message;
    fill_header(message, seq_++);
    message.events_session = 1;
    message.newest_event = {now_.monotonic_us - input_.ConsumeIntegralInRange(0, 2000)};
    message.event_utime = now_.utime - 300;
    message.events_applied = seq_;
    message.state = input_.ConsumeBool()
                        ? TrackState::kTracking
                        : static_cast<TrackState>(input_.ConsumeIntegralInRange(0, 2));
    message.resting = input_.ConsumeBool();
    message.coasting = input_.ConsumeBool();
    message.is_live = input_.ConsumeBool();
    Pixel& place = message.position.emplace();
    place.x = input_.ConsumeIntegralInRange(0, 640);
    place.y = input_.ConsumeIntegralInRange(0, 480);
    message.velocity.x = input_.ConsumeIntegral<std::int16_t>();
    message.velocity.y = input_.ConsumeIntegral<std::int16_t>();
    message.size = {30, 30};
    for (std::size_t i = 0; i < 16; i += 5) message.covariance[i] = 0.25;
    spoil(message.newest_event.us);
    spoil(*message.event_utime);
    for (double* value :
         {&place.x, &place.y, &message.velocity.x, &message.velocity.y, &message.size.width,
          &message.covariance[input_.ConsumeIntegral<std::uint8_t>() & 15]}) {
      spoil(*value);
    }
    if (!is_valid(message)) return;
    const SenderClock sender = clock();
    bridge_.hear(message, now_, sender);
    arm_.hear(message, now_, sender);
  }

  void hear_arm_state() {
    ArmState message = arm_.state();
    fill_header(message, seq_++);
    if (!rarely()) message.session = kArmSession;
    spoil(message.line_min_m);
    spoil(message.line_max_m);
    spoil(message.line_x_m);
    spoil(message.position_m);
    if (is_valid(message)) bridge_.hear(message, now_, clock());
  }

  void hear_head() {
    HeadState message;
    fill_header(message, seq_++);
    message.at.emplace();
    spoil(message.at->us);
    if (rarely()) message.at.reset();
    spoil(message.yaw_deg);
    spoil(message.pitch_deg);
    if (is_valid(message)) bridge_.hear(message, now_);
  }

  void hear_command() {
    ArmCommand message;
    fill_header(message, seq_++);
    message.mode = static_cast<CommandMode>(input_.ConsumeIntegralInRange(0, 3));
    message.from_operator = input_.ConsumeBool();
    message.target_m = input_.ConsumeIntegral<std::int8_t>() * 0.01;
    message.target_normalised = message.target_m / 0.3;
    message.valid_for_us = 100'000;
    message.estimate = {session(), seq_ - 1};
    message.arm_session = kArmSession;
    spoil(message.target_m);
    spoil(message.target_normalised);
    spoil(message.arrive_in_us);
    spoil(message.valid_for_us);
    spoil(message.arm_session);
    if (is_valid(message)) arm_.hear(message, now_, clock());
  }

  void step() {
    for (int i = input_.ConsumeIntegralInRange(0, 7); i >= 0; --i) {
      now_.utime += 1000;
      now_.monotonic_us += 1000;
      publish();
      arm_.step(now_, 0.001);
      check_arm();
    }
  }

  void publish() {
    if (auto trajectory = bridge_.next_trajectory(now_)) check_published(*trajectory);
    if (auto game = bridge_.next_game(now_)) check_published(*game);
    if (auto command = bridge_.next_command(now_)) {
      check_published(*command);
      require(std::abs(command->target_normalised) <= 1, "a command's target is on the line");
      arm_.hear(*command, now_, kOwnClock);
    }
  }

  template <typename Message>
  void check_published(Message& message) {
    message.utime = now_.utime;
    message.session = kBridgeSession;
    message.seq = published_++;
    require(is_valid(message), "what is published is valid");
  }

  void check_arm() {
    constexpr double kRounding = 1e-9;
    const ArmControllerParams params;
    require(std::abs(arm_.motion().line().state().position) <= params.guard.line_half_m + kRounding,
            "the arm stays on its line");
    require(std::abs(arm_.motion().line().state().velocity) <= params.arm.max_speed_m_s + kRounding,
            "the arm is not faster than it may be");
    ArmState state = arm_.state();
    state.session = kArmSession;
    state.utime = now_.utime;
    require(is_valid(state), "the arm's state is valid");
  }

  FuzzedDataProvider& input_;
  HostNow now_{1'700'000'000'000'000, 5'000'000};
  PlayBridge bridge_;
  ArmController arm_;
  std::int64_t seq_ = 1;
  std::int64_t published_ = 0;
};

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider input(data, size);
  puck::Play play(input);
  while (input.remaining_bytes() > 0) play.go_on();
  return 0;
}
