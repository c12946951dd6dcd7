#include "common/messaging/conversions.h"

#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/bus.h"
#include "tests/support/random_message.h"

namespace puck {
namespace {

// Encodes to the same bytes after a conversion to its plain type and back.
template <typename Message>
void check_kept(Message message) {
  std::vector<std::uint8_t> bytes;
  encode(message, bytes);
  auto plain = from_message(message);
  std::vector<std::uint8_t> again;
  encode(plain, again);
  CHECK(again == bytes);
}

}  // namespace

TEST_CASE_TEMPLATE("a message is unchanged by conversion to its plain type and back", Message,
                   puck_estimate_t, arm_command_t, arm_state_t, game_state_t, head_state_t,
                   ground_truth_t) {
  std::mt19937_64 random(20261130);
  for (int i = 0; i < 100; ++i) {
    Message message;
    REQUIRE_FALSE(decode(random_message(kChannelOf<Message>, random).bytes, message));
    if constexpr (requires { message.flags; }) {
      message.flags |= Message::FLAG_POSITION;
      message.flags |= Message::FLAG_LEFT_IMAGE;
    }
    check_kept(message);
  }
}

TEST_CASE("unknown times have no value, and are unknown again on the wire") {
  puck_estimate_t estimate{};
  estimate.event_utime = 0;
  CHECK_FALSE(from_message(estimate).event_utime);
  CHECK(to_message(from_message(estimate)).event_utime == 0);
  head_state_t head{};
  head.sensor_us = -1;
  CHECK_FALSE(from_message(head).at);
  CHECK(to_message(from_message(head)).sensor_us == -1);
}

TEST_CASE("an estimate without a position has no velocity, size and covariance on the wire") {
  PublishedEstimate estimate;
  estimate.state = TrackState::kLost;
  estimate.velocity = {100, -50};
  estimate.size = {30, 20};
  estimate.covariance[0] = 0.25;
  estimate.left_image = Pixel{639, 100};
  const puck_estimate_t message = to_message(estimate);
  CHECK(message.flags == puck_estimate_t::FLAG_LEFT_IMAGE);
  CHECK(message.left_x_px == 639);
  CHECK(message.vx_px_s == 0);
  CHECK(message.width_px == 0);
  CHECK(message.covariance[0] == 0);
  const PublishedEstimate back = from_message(message);
  CHECK_FALSE(back.position.has_value());
  CHECK(back.left_image == Pixel{639, 100});
}

TEST_CASE("each part of an estimate has its field on the wire") {
  PublishedEstimate estimate{{5, 6, 7}};
  estimate.state = TrackState::kTracking;
  estimate.coasting = true;
  estimate.is_live = true;
  estimate.position = Pixel{320.25, 240.5};
  estimate.velocity = {100, -50};
  estimate.size = {30, 20};
  estimate.newest_event = {5'000'000};
  estimate.sensor = {640, 480};
  estimate.packets = {1, 2, 3, 4, 5, 6, 7};
  const puck_estimate_t message = to_message(estimate);
  CHECK(message.utime == 5);
  CHECK(message.session == 6);
  CHECK(message.seq == 7);
  CHECK(message.state == puck_estimate_t::STATE_TRACKING);
  CHECK(message.flags == 2 + 8 + 16);  // Coasting, position, live.
  CHECK(message.x_px == 320.25);
  CHECK(message.vy_px_s == -50);
  CHECK(message.height_px == 20);
  CHECK(message.sensor_us == 5'000'000);
  CHECK(message.image_width == 640);
  CHECK(message.packets_late == 3);
  CHECK(message.events_skipped == 6);
}

TEST_CASE("each part of a trajectory has its field on the wire") {
  TableTrajectory trajectory;
  trajectory.estimate = {31, 41};
  trajectory.at = {7'000'000};
  trajectory.line_x_m = 0.23;
  CHECK(to_message(trajectory).validity == puck_trajectory_t::VALIDITY_NONE);
  CHECK(to_message(trajectory).crosses == 0);

  trajectory.head_known = true;
  trajectory.track = PuckTrack{{{1.5, -0.2}, {-1, 0.5}}, diagonal(1, 2, 3, 4)};
  CHECK(to_message(trajectory).validity == puck_trajectory_t::VALIDITY_TRACKED);
  trajectory.is_coasting = true;
  trajectory.path = {{0.02, {1.4, -0.1}}, {0.04, {1.3, 0.1}}};
  trajectory.crossing = Intercept{.x_m = 0.23,
                                  .y_m = 0.1,
                                  .in_s = 0.7,
                                  .speed_m_s = 2,
                                  .bounces = 1,
                                  .sigma_y_m = 0.01,
                                  .sigma_t_s = 0.02};
  const puck_trajectory_t message = to_message(trajectory);
  CHECK(message.estimate_session == 31);
  CHECK(message.estimate_seq == 41);
  CHECK(message.sensor_us == 7'000'000);
  CHECK(message.validity == puck_trajectory_t::VALIDITY_COASTING);
  CHECK(message.head_known == 1);
  CHECK(message.y_m == -0.2);
  CHECK(message.vx_m_s == -1);
  CHECK(message.covariance[5] == 2);
  CHECK(message.covariance[15] == 4);
  CHECK(message.path_length == 2);
  CHECK(message.path_t_s[1] == 0.04);
  CHECK(message.path_x_m[0] == 1.4);
  CHECK(message.path_y_m[1] == 0.1);
  CHECK(message.crosses == 1);
  CHECK(message.line_x_m == 0.23);
  CHECK(message.crossing_y_m == 0.1);
  CHECK(message.crossing_in_s == 0.7);
  CHECK(message.crossing_sigma_y_m == 0.01);
  CHECK(message.crossing_sigma_t_s == 0.02);
  CHECK(message.crossing_speed_m_s == 2);
  CHECK(message.crossing_bounces == 1);
}

TEST_CASE("a plain message passes the bus, which fills in its header") {
  Bus bus({.url = "memq://"});
  std::vector<ArmCommand> received;
  bus.subscribe<ArmCommand>(
      [&](const ArmCommand& command, const Receipt&) { received.push_back(command); });
  REQUIRE(bus.start({}, [](const std::string&) {}));
  ArmCommand sent;
  sent.mode = CommandMode::kHold;
  sent.estimate = {31, 41};
  REQUIRE(bus.publish(sent));
  CHECK(sent.session == bus.session());
  bus.handle(std::chrono::milliseconds(100));
  REQUIRE(received.size() == 1);
  CHECK(received[0].utime == sent.utime);
  CHECK(received[0].id() == sent.id());
  CHECK(received[0].mode == CommandMode::kHold);
  CHECK(received[0].estimate == MessageId{31, 41});
  CHECK(bus.counters<ArmCommand>().published == 1);
}

}  // namespace puck
