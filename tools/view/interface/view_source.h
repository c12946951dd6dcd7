#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "common/events/timestamp.h"
#include "tools/view/interface/picture_wishes.h"
#include "tools/view/interface/view_control.h"
#include "tools/view/interface/view_scene.h"
#include "tools/view/interface/view_state.h"

namespace puck {

/// What a viewer looks at: a recording that is played, or the live bus. All functions are safe from
/// any thread; none waits for longer than a copy takes, except wait_for_change().
class ViewSource {
 public:
  virtual ~ViewSource() = default;

  /// Fills what the wishes ask for, reusing the memory of `scene`. False while there is nothing to
  /// draw, as the sensor is not known: ViewState::messages then says why.
  virtual bool fill(const PictureWishes& wishes, ViewScene& scene) = 0;

  /// `since`: of the samples, only newer ones; those of another `run` are returned in full.
  virtual ViewState state(Timestamp since, std::int64_t run) = 0;

  /// Empty for the live bus.
  virtual ViewTimeline timeline() = 0;

  /// Returns an empty text, or why the wish is not fulfilled, for the user.
  virtual std::string control(const ViewControl& control) = 0;

  /// Increases whenever a new picture may differ from the last.
  virtual std::uint64_t version() const = 0;

  /// Returns once version() differs from `seen`, or `timeout` has passed.
  virtual void wait_for_change(std::uint64_t seen, std::chrono::milliseconds timeout) = 0;
};

}  // namespace puck
