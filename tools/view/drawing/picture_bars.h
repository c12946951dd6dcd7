#pragma once

#include "tools/view/drawing/canvas.h"
#include "tools/view/interface/picture_wishes.h"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// Heights of the bars above and below the camera's picture.
inline constexpr int kTopBar_px = 30;
inline constexpr int kBottomBar_px = 26;

/// Writes time, tracker, state, error, speed and score into the top bar, from left to right, as far
/// as the width allows.
void write_bar(const ViewScene& scene, const PictureWishes& wishes, Canvas& canvas, int width_px);

/// Draws the legend of what the wishes show around the row y: its entries are nearer together where
/// there is little room, and what does not fit is left out.
void draw_legend(const ViewScene& scene, const PictureWishes& wishes, Canvas& canvas, int width_px,
                 double y);

}  // namespace puck
