#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tools/view/drawing/scene_painter.h"
#include "tools/view/interface/view_source.h"

namespace puck {

/// Draws and encodes pictures, one at a time, and keeps the newest of each kind, so that several
/// viewers of the same cost no more than one. Of one kind, at most 60 a second, and 30 of the
/// table; all together take at most kMostOfCore of a core, whatever is asked for. Nothing is drawn
/// that nobody asks for. Safe from any thread.
class PictureDesk {
 public:
  static constexpr double kMostOfCore = 0.15;

  /// `source` must live longer. Uses no further threads of OpenCV's in this process: they would
  /// wait busily.
  explicit PictureDesk(ViewSource& source);

  struct Picture {
    std::uint64_t version = 0;                ///< Of the source.
    std::shared_ptr<const std::string> jpeg;  ///< The encoded bytes.
  };

  /// The newest picture, unless it is the one `seen`; nothing too while there is none to draw.
  std::optional<Picture> newer(const PictureWishes& wishes, std::uint64_t seen);

 private:
  struct Kept {
    PictureWishes wishes;
    Picture picture;
    std::chrono::steady_clock::time_point drawn;
    std::chrono::steady_clock::time_point used;
  };

  Kept& place_of(const PictureWishes& wishes);
  void draw(Kept& kept, std::uint64_t version);

  ViewSource& source_;
  std::mutex mutex_;
  std::vector<Kept> kept_;  // Guarded by mutex_, as all below.
  ViewScene scene_;
  ScenePainter painter_;
  std::vector<unsigned char> encoded_;
  std::chrono::steady_clock::time_point free_;  // Nothing is drawn before.
};

}  // namespace puck
