#pragma once

#include <opencv2/core.hpp>

#include "tools/view/interface/picture_wishes.h"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// Draws the table from above, the robot's end at the left, or at the bottom of a picture that is
/// higher than wide: the puck, its predicted path with two
/// standard deviations, the crossing of the robot's line, the mallet, truth, and the score. A
/// coasting puck is dashed; without a track the picture says so. `picture` has its size and the
/// palette's background.
void draw_table(const ViewScene& scene, const PictureWishes& wishes, cv::Mat& picture);

}  // namespace puck
