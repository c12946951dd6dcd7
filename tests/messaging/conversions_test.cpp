#include "common/messaging/conversions.h"

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("an estimate is unchanged by conversion to its message and back") {
  PuckEstimate estimate;
  estimate.state = TrackState::kTracking;
  estimate.coasting = true;
  estimate.position = Pixel{320.25, 240.5};
  estimate.velocity = {100, -50};
  estimate.size = {30, 20};
  estimate.score = 0.75;
  estimate.covariance[0] = 0.25;
  estimate.covariance[15] = 9;
  estimate.region = {300, 220, 60, 40};
  estimate.newest_event = Timestamp{5'000'000};
  estimate.events_applied = 123456;

  const puck_estimate_t message = to_message(estimate, {640, 480});
  CHECK(message.state == puck_estimate_t::STATE_TRACKING);
  CHECK(message.flags == 2 + 8);  // Coasting, position.
  CHECK(message.image_width == 640);

  const PuckEstimate back = from_message(message);
  CHECK(back.state == TrackState::kTracking);
  CHECK(back.coasting);
  CHECK_FALSE(back.resting);
  CHECK(back.position == estimate.position);
  CHECK(back.velocity.y == -50);
  CHECK(back.size.height == 20);
  CHECK(back.score == 0.75);
  CHECK(back.covariance == estimate.covariance);
  CHECK(back.region == estimate.region);
  CHECK(back.newest_event == estimate.newest_event);
  CHECK(back.events_applied == 123456);
  CHECK_FALSE(back.left_image.has_value());
}

TEST_CASE("a puck that left the image has a place of exit and no position") {
  PuckEstimate estimate;
  estimate.state = TrackState::kLost;
  estimate.left_image = Pixel{639, 100};
  const puck_estimate_t message = to_message(estimate, {640, 480});
  CHECK(message.flags == puck_estimate_t::FLAG_LEFT_IMAGE);
  const PuckEstimate back = from_message(message);
  CHECK_FALSE(back.position.has_value());
  CHECK(back.left_image == Pixel{639, 100});
}

TEST_CASE("the states in messages are those of the tracker") {
  CHECK(static_cast<int>(TrackState::kSearching) == puck_estimate_t::STATE_SEARCHING);
  CHECK(static_cast<int>(TrackState::kTracking) == puck_estimate_t::STATE_TRACKING);
  CHECK(static_cast<int>(TrackState::kLost) == puck_estimate_t::STATE_LOST);
}

}  // namespace puck
