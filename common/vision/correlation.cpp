#include "common/vision/correlation.h"

#include <algorithm>

namespace puck {

void Correlation::set_picture(ImageView<const std::uint8_t> picture, const Region& region) {
  region_ = region;
  row_sums_.resize(picture.width() + 1, picture.height());
  for (int y = 0; y < picture.height(); ++y) {
    const std::uint8_t* from = picture.row(y);
    std::int32_t* to = row_sums_.row(y);
    std::int32_t sum = 0;
    to[0] = 0;
    for (int x = 0; x < picture.width(); ++x) {
      sum += from[x];
      to[x + 1] = sum;
    }
  }
}

void Correlation::correlate(const EllipseKernel& kernel, const Region& candidates,
                            CorrelationMap& out) {
  out.region = candidates;
  out.response.resize(candidates.width, candidates.height);
  if (candidates.empty()) return;
  const auto count = static_cast<std::size_t>(candidates.width);

  // Sums that a kernel row needs: from the first candidate's first column to the last one's end.
  const int first_column = candidates.x - kernel.anchor_x() - region_.x;
  const int columns = candidates.width + kernel.width();

  // Which picture rows the kernel reaches from each candidate row; the sums of each such row are
  // laid out once and added to every candidate row that it belongs to.
  canvas_sum_.assign(count * static_cast<std::size_t>(candidates.height), 0);
  outer_sum_.assign(canvas_sum_.size(), 0);
  inner_sum_.assign(canvas_sum_.size(), 0);

  const int first_row = candidates.y - kernel.anchor_y() - region_.y;
  const int rows = candidates.height + kernel.height() - 1;
  for (int i = std::max(0, -first_row); i < rows; ++i) {
    const int picture_row = first_row + i;
    if (picture_row >= row_sums_.height()) break;
    const std::int32_t* sums = sums_from(picture_row, first_column, columns);
    const int first_candidate = std::max(0, i - kernel.height() + 1);
    const int last_candidate = std::min(i, candidates.height - 1);
    for (int candidate_row = first_candidate; candidate_row <= last_candidate; ++candidate_row) {
      const auto add = [&](std::vector<std::int32_t>& total, EllipseKernel::Run run) {
        if (run.first == run.last) return;
        std::int32_t* to = total.data() + static_cast<std::ptrdiff_t>(candidate_row) *
                                              static_cast<std::ptrdiff_t>(count);
        const std::int32_t* high = sums + run.last;
        const std::int32_t* low = sums + run.first;
        for (std::size_t x = 0; x < count; ++x) to[x] += high[x] - low[x];
      };
      const int kernel_row = i - candidate_row;
      add(canvas_sum_, {0, static_cast<std::int16_t>(kernel.width())});
      add(outer_sum_, kernel.outer_run(kernel_row));
      add(inner_sum_, kernel.inner_run(kernel_row));
    }
  }

  for (int y = 0; y < candidates.height; ++y) {
    const std::size_t offset = static_cast<std::size_t>(y) * count;
    double* to = out.response.row(y);
    for (std::size_t x = 0; x < count; ++x) {
      to[x] =
          kernel.response(canvas_sum_[offset + x], outer_sum_[offset + x], inner_sum_[offset + x]);
    }
  }
}

const std::int32_t* Correlation::sums_from(int row, int first, int count) {
  const std::int32_t* sums = row_sums_.row(row);
  if (first >= 0 && first + count <= row_sums_.width()) return sums + first;
  const int before = std::clamp(-first, 0, count);
  const int from = std::clamp(first, 0, row_sums_.width());
  const int inside = std::min(row_sums_.width() - from, count - before);
  padded_.assign(static_cast<std::size_t>(count), sums[row_sums_.width() - 1]);
  std::fill_n(padded_.begin(), before, 0);
  std::copy_n(sums + from, inside, padded_.begin() + before);
  return padded_.data();
}

double Correlation::contrast_at(const EllipseKernel& kernel, int x, int y) const {
  const int left = x - kernel.anchor_x() - region_.x;
  const int top = y - kernel.anchor_y() - region_.y;
  double canvas = 0;
  double outer = 0;
  double inner = 0;
  for (int row = std::max(0, -top); row < kernel.height(); ++row) {
    const int picture_row = top + row;
    if (picture_row >= row_sums_.height()) break;
    const auto sum = [&](int first, int last) {
      return sum_left_of(picture_row, left + last) - sum_left_of(picture_row, left + first);
    };
    canvas += sum(0, kernel.width());
    outer += sum(kernel.outer_run(row).first, kernel.outer_run(row).last);
    inner += sum(kernel.inner_run(row).first, kernel.inner_run(row).last);
  }
  return kernel.contrast(canvas, outer, inner);
}

std::int32_t Correlation::sum_left_of(int row, int x) const {
  return row_sums_(std::clamp(x, 0, row_sums_.width() - 1), row);
}

}  // namespace puck
