#pragma once

#include <cstdint>

#include "common/vision/blob_witness.h"
#include "common/vision/challengers.h"

namespace puck {

/// Lets a blob follow the puck more coarsely, and checks the main track against it. That it speaks
/// up is switched by ContourIngredients::witness.
class WitnessCheck {
 public:
  void take(double x, double y) { witness_.take(x, y); }

  /// To be called at each decision. Where the two disagree, the blob's opinion challenges the main
  /// track; a blob that is astray of a good track for long is put back.
  void consult(const ContourTrack& main, const ContourContext& context, std::int64_t time_us,
               Challengers& challengers);

  /// To be called at each decision once the puck has settled, `passed_us` after the last one: noise
  /// would lead the blob astray in time, and draws it more weakly than this does.
  void draw_to(Pixel main, std::int64_t passed_us);

  /// The main track is somewhere else now.
  void put(Pixel position, std::int64_t time_us);

  bool agrees(Pixel main, const ContourContext& context) const;
  /// The same, or it is so near that what lies beside a small puck may have drawn it off.
  bool is_near(Pixel main, const ContourContext& context) const;
  /// It agrees, and what it follows are the puck's events.
  bool vouches(Pixel main, const ContourContext& context) const;
  Pixel position() const { return witness_.position(); }

 private:
  BlobWitness witness_{Pixel{}};
  std::int64_t agreed_us_ = 0;
  std::int64_t spoke_us_ = 0;
};

}  // namespace puck
