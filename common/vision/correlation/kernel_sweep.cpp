#include "common/vision/correlation/kernel_sweep.h"

#include <algorithm>
#include <limits>
#include <span>

// Everything in this file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/correlation/kernel_sweep.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::ScalableTag<std::uint16_t>;
// At most 16 lanes: on 33 to 48 columns three such vectors waste less than two of twice the width.
using Narrow = hn::CappedTag<std::uint16_t, 16>;

// kVectors vectors of neighbouring candidates, from the first row to the last; the running sums
// stay in registers from row to row. kShapes: 1, the weighted total; 3, the sums of the canvas, the
// outer and the inner ellipse.
template <typename Sums, int kShapes, int kVectors>
class Strip {
  using Totals = hn::Repartition<std::int32_t, Sums>;
  using SumVector = hn::Vec<Sums>;
  using TotalVector = hn::Vec<Totals>;

 public:
  HWY_INLINE Strip(const SweepPlan& plan, std::size_t x)
      : plan_(plan), x_(x), lanes_(hn::Lanes(Sums())) {
    const auto none = hn::Set(Totals(), std::numeric_limits<std::int32_t>::max());
    for (auto& lowest : lowest_) lowest = none;
  }

  HWY_INLINE std::int32_t sweep() {
    const std::uint16_t* place = plan_.first + x_;
    begin_totals(place);
    put(0);
    for (int row = 1; row < plan_.rows; ++row) {
      place += plan_.stride;
      move_on(place);
      put(row);
    }
    return lowest();
  }

 private:
  // One half of the values, widened to 32 bits. Values stay in their block of 16 bytes, because a
  // move between blocks takes longer; so each half has some of each block, see put_in_order.
  static HWY_INLINE TotalVector half_of(SumVector values, int half) {
    return hn::BitCast(Totals(), interleaved(values, hn::Zero(Sums()), half));
  }

  // The same for values read as signed numbers.
  static HWY_INLINE TotalVector signed_half_of(SumVector values, int half) {
    return hn::ShiftRight<16>(hn::BitCast(Totals(), interleaved(values, values, half)));
  }

  static HWY_INLINE SumVector interleaved(SumVector a, SumVector b, int half) {
    return half == 0 ? hn::InterleaveLower(Sums(), a, b) : hn::InterleaveUpper(Sums(), a, b);
  }

  // Writes the halves of some values in the order of the values.
  template <typename Tag>
  static HWY_INLINE void put_in_order(Tag tag, const hn::Vec<Tag>* halves, std::int32_t* to) {
    if constexpr (hn::MaxLanes(Tag()) * sizeof(std::int32_t) > 16) {
      const hn::Half<Tag> half;
      const hn::Vec<hn::Half<Tag> > lower[] = {hn::LowerHalf(half, halves[0]),
                                               hn::LowerHalf(half, halves[1])};
      const hn::Vec<hn::Half<Tag> > upper[] = {hn::UpperHalf(half, halves[0]),
                                               hn::UpperHalf(half, halves[1])};
      put_in_order(half, lower, to);
      put_in_order(half, upper, to + hn::Lanes(tag));
    } else {
      hn::StoreU(halves[0], tag, to);
      hn::StoreU(halves[1], tag, to + hn::Lanes(tag));
    }
  }

  static HWY_INLINE SumVector run_at(const std::uint16_t* place, const SumRun& run) {
    return hn::Sub(hn::LoadU(Sums(), place + run.high), hn::LoadU(Sums(), place + run.low));
  }

  HWY_INLINE void sum_ellipses(const std::uint16_t* place, std::span<const SumRun> runs,
                               SumVector* sums) const {
    for (int v = 0; v < kVectors; ++v) sums[v] = hn::Zero(Sums());
    for (const SumRun& run : runs) {
      HWY_UNROLL(4)
      for (int v = 0; v < kVectors; ++v) {
        sums[v] = hn::Add(sums[v], run_at(place + static_cast<std::size_t>(v) * lanes_, run));
      }
    }
  }

  HWY_INLINE void begin_totals(const std::uint16_t* place) {
    for (auto& total : totals_) total = hn::Zero(Totals());
    SumVector canvas[kVectors];
    begin_totals(place, plan_.canvas, 0, plan_.weights.canvas, canvas);
    begin_totals(place, plan_.outer, 1, plan_.weights.outer, outer_);
    begin_totals(place, plan_.inner, 2, plan_.weights.inner, inner_);
  }

  // The first row's sums may exceed 16 bits: adds as many runs in 16 bits as cannot overflow.
  HWY_INLINE void begin_totals(const std::uint16_t* place, std::span<const SumRun> runs, int shape,
                               std::int32_t weight, SumVector* sums) {
    for (int v = 0; v < kVectors; ++v) sums[v] = hn::Zero(Sums());
    while (!runs.empty()) {
      const std::size_t count = std::min(runs.size(), plan_.runs_at_once);
      SumVector some[kVectors];
      sum_ellipses(place, runs.first(count), some);
      runs = runs.subspan(count);
      for (int v = 0; v < kVectors; ++v) {
        sums[v] = hn::Add(sums[v], some[v]);
        for (int half = 0; half < 2; ++half) {
          add(half_of(some[v], half), v, half, shape, weight);
        }
      }
    }
  }

  HWY_INLINE void move_on(const std::uint16_t* place) {
    SumVector outer[kVectors];
    SumVector inner[kVectors];
    sum_ellipses(place, plan_.outer, outer);
    sum_ellipses(place, plan_.inner, inner);
    const std::uint16_t* lost = place - plan_.stride;
    const std::uint16_t* gained =
        lost + static_cast<std::ptrdiff_t>(plan_.canvas.size()) * plan_.stride;
    for (int v = 0; v < kVectors; ++v) {
      const std::size_t x = static_cast<std::size_t>(v) * lanes_;
      const auto canvas =
          hn::Sub(run_at(gained + x, plan_.canvas.front()), run_at(lost + x, plan_.canvas.front()));
      add_changes(canvas, hn::Sub(outer[v], outer_[v]), hn::Sub(inner[v], inner_[v]), v);
      outer_[v] = outer[v];
      inner_[v] = inner[v];
    }
  }

  HWY_INLINE void add_changes(SumVector canvas, SumVector outer, SumVector inner, int v) {
    for (int half = 0; half < 2; ++half) {
      add(signed_half_of(canvas, half), v, half, 0, plan_.weights.canvas);
      add(signed_half_of(outer, half), v, half, 1, plan_.weights.outer);
      add(signed_half_of(inner, half), v, half, 2, plan_.weights.inner);
    }
  }

  HWY_INLINE void add(TotalVector values, int v, int half, int shape, std::int32_t weight) {
    if constexpr (kShapes == 1) {
      auto& total = totals_[2 * v + half];
      total = hn::Add(total, hn::Mul(values, hn::Set(Totals(), weight)));
    } else {
      auto& total = totals_[2 * (shape * kVectors + v) + half];
      total = hn::Add(total, values);
    }
  }

  HWY_INLINE void put(int row) {
    if constexpr (kShapes == 1) {
      for (int i = 0; i < 2 * kVectors; ++i) lowest_[i] = hn::Min(lowest_[i], totals_[i]);
    }
    if (row < plan_.kept_first || row >= plan_.kept_last) return;
    for (int shape = 0; shape < kShapes; ++shape) {
      std::int32_t* to = plan_.out[static_cast<std::size_t>(shape)] +
                         (row - plan_.kept_first) * plan_.out_stride + x_;
      for (int v = 0; v < kVectors; ++v) {
        put_in_order(Totals(), totals_ + 2 * (shape * kVectors + v),
                     to + static_cast<std::size_t>(v) * lanes_);
      }
    }
  }

  // The lowest total in the columns that are candidates.
  HWY_INLINE std::int32_t lowest() const {
    const auto none = hn::Set(Totals(), std::numeric_limits<std::int32_t>::max());
    auto all = none;
    for (int v = 0; v < kVectors; ++v) {
      const std::size_t x = x_ + static_cast<std::size_t>(v) * lanes_;
      if (x >= plan_.width) break;
      const auto width = hn::Set(Totals(), static_cast<std::int32_t>(plan_.width - x));
      for (int half = 0; half < 2; ++half) {
        const auto inside = hn::Lt(half_of(hn::Iota(Sums(), 0), half), width);
        all = hn::Min(all, hn::IfThenElse(inside, lowest_[2 * v + half], none));
      }
    }
    return hn::GetLane(hn::MinOfLanes(Totals(), all));
  }

  const SweepPlan& plan_;
  std::size_t x_;
  std::size_t lanes_;
  SumVector outer_[kVectors];
  SumVector inner_[kVectors];
  TotalVector totals_[2 * kShapes * kVectors];
  TotalVector lowest_[2 * kVectors];
};

template <typename Sums, int kShapes>
std::int32_t sweep_strips(const SweepPlan& plan) {
  const std::size_t lanes = hn::Lanes(Sums());
  std::int32_t lowest = std::numeric_limits<std::int32_t>::max();
  for (std::size_t x = 0; x < plan.width;) {
    const std::size_t vectors = (plan.width - x + lanes - 1) / lanes;
    if (vectors >= 3) {
      lowest = std::min(lowest, Strip<Sums, kShapes, 3>(plan, x).sweep());
      x += 3 * lanes;
    } else if (vectors == 2) {
      lowest = std::min(lowest, Strip<Sums, kShapes, 2>(plan, x).sweep());
      x += 2 * lanes;
    } else {
      lowest = std::min(lowest, Strip<Sums, kShapes, 1>(plan, x).sweep());
      x += lanes;
    }
  }
  return lowest;
}

std::int32_t sweep(const SweepPlan& plan) {
  if (plan.separate) return sweep_strips<Wide, 3>(plan);
  const std::size_t wide = hn::Lanes(Wide());
  const std::size_t narrow = hn::Lanes(Narrow());
  const std::size_t narrow_vectors = (plan.width + narrow - 1) / narrow;
  const bool wastes_less = narrow_vectors * narrow < (plan.width + wide - 1) / wide * wide;
  if (wastes_less && narrow_vectors <= 3) return sweep_strips<Narrow, 1>(plan);
  return sweep_strips<Wide, 1>(plan);
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {
namespace {

HWY_EXPORT(sweep);

// Rows are written in whole strips.
constexpr std::ptrdiff_t kStrip = RowSums::kSlack;

void add_run(std::vector<SumRun>& runs, std::ptrdiff_t row_begin, EllipseKernel::Run run) {
  if (run.first != run.last) runs.push_back({row_begin + run.last, row_begin + run.first});
}

}  // namespace

void KernelSweep::Totals::make_room(const Region& candidates, const Region& kept) {
  region = kept;
  first_column = candidates.x;
  stride = (candidates.width + kStrip - 1) / kStrip * kStrip;
  const auto size = static_cast<std::size_t>(stride * kept.height);
  if (values.size() < size) values.resize(size);
}

SweepPlan KernelSweep::plan_for(const RowSums& picture, const EllipseKernel& kernel,
                                const Region& candidates, const Region& kept) {
  canvas_.clear();
  outer_.clear();
  inner_.clear();
  for (int row = 0; row < kernel.height(); ++row) {
    add_run(canvas_, row * picture.stride(), {0, static_cast<std::int16_t>(kernel.width())});
    add_run(outer_, row * picture.stride(), kernel.outer_run(row));
    add_run(inner_, row * picture.stride(), kernel.inner_run(row));
  }
  SweepPlan plan;
  plan.stride = picture.stride();
  plan.first = picture.row(candidates.y - kernel.anchor_y() - picture.place().y) +
               (candidates.x - kernel.anchor_x() - picture.place().x);
  plan.width = static_cast<std::size_t>(candidates.width);
  plan.rows = candidates.height;
  plan.canvas = canvas_;
  plan.kept_first = kept.y - candidates.y;
  plan.kept_last = plan.kept_first + kept.height;
  plan.runs_at_once =
      std::numeric_limits<std::uint16_t>::max() / (255 * static_cast<std::size_t>(kernel.width()));
  plan.outer = outer_;
  plan.inner = inner_;
  return plan;
}

std::int32_t KernelSweep::sweep(const RowSums& picture, const EllipseKernel& kernel,
                                EllipseKernel::WholeWeights weights, const Region& candidates,
                                const Region& kept, Totals& totals) {
  totals.make_room(candidates, kept);
  SweepPlan plan = plan_for(picture, kernel, candidates, kept);
  plan.weights = weights;
  plan.out[0] = totals.values.data();
  plan.out_stride = totals.stride;
  return HWY_DYNAMIC_DISPATCH(sweep)(plan);
}

void KernelSweep::sweep(const RowSums& picture, const EllipseKernel& kernel,
                        const Region& candidates, std::array<Totals, 3>& sums) {
  SweepPlan plan = plan_for(picture, kernel, candidates, candidates);
  plan.separate = true;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i].make_room(candidates, candidates);
    plan.out[i] = sums[i].values.data();
  }
  plan.out_stride = sums[0].stride;
  HWY_DYNAMIC_DISPATCH(sweep)(plan);
}

}  // namespace puck
#endif
