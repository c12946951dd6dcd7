#include "common/vision/kernel_sweep.h"

#include <algorithm>
#include <limits>
#include <span>

#include "common/vision/sweep_plan.h"

// Everything in this file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/kernel_sweep.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Without vectors Highway has no halves of them.
#if HWY_TARGET == HWY_SCALAR
constexpr int kHalves = 1;
#else
constexpr int kHalves = 2;
#endif

using Wide = hn::ScalableTag<std::uint16_t>;
// Of 16 lanes at most: three of them waste less on 33 to 48 columns than two that are twice as
// wide.
using Narrow = hn::CappedTag<std::uint16_t, 16>;

// kVectors vectors of neighbouring candidates, from the first row to the last; what one row hands
// on to the next stays in registers. kShapes: 1, the weighted total; 3, the canvas's sum, the outer
// and the inner ellipse's.
template <typename Sums, int kShapes, int kVectors>
class Strip {
  using Changes = hn::RebindToSigned<Sums>;
#if HWY_TARGET == HWY_SCALAR
  using Totals = hn::Rebind<std::int32_t, Sums>;
#else
  using Totals = hn::Repartition<std::int32_t, Sums>;
#endif
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
    sum_ellipses(place, plan_.outer, outer_);
    sum_ellipses(place, plan_.inner, inner_);
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
  template <typename V>
  static HWY_INLINE TotalVector half_of(V values, int half) {
#if HWY_TARGET == HWY_SCALAR
    static_cast<void>(half);
    return hn::PromoteTo(Totals(), values);
#else
    return half == 0 ? hn::PromoteTo(Totals(), hn::LowerHalf(values))
                     : hn::PromoteTo(Totals(), hn::UpperHalf(hn::Half<hn::DFromV<V> >(), values));
#endif
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

  // The first row's sums exceed 16 bits, those of its runs do not.
  HWY_INLINE void begin_totals(const std::uint16_t* place) {
    for (auto& total : totals_) total = hn::Zero(Totals());
    for (int row = 0; row < plan_.canvas_height; ++row) {
      add_run(place + row * plan_.stride, plan_.canvas_row, 0, plan_.weights.canvas);
    }
    for (const SumRun& run : plan_.outer) add_run(place, run, 1, plan_.weights.outer);
    for (const SumRun& run : plan_.inner) add_run(place, run, 2, plan_.weights.inner);
  }

  HWY_INLINE void add_run(const std::uint16_t* place, const SumRun& run, int shape,
                          std::int32_t weight) {
    for (int v = 0; v < kVectors; ++v) {
      add(run_at(place + static_cast<std::size_t>(v) * lanes_, run), v, shape, weight);
    }
  }

  HWY_INLINE void move_on(const std::uint16_t* place) {
    SumVector outer[kVectors];
    SumVector inner[kVectors];
    sum_ellipses(place, plan_.outer, outer);
    sum_ellipses(place, plan_.inner, inner);
    const std::uint16_t* lost = place - plan_.stride;
    const std::uint16_t* gained = lost + plan_.canvas_height * plan_.stride;
    for (int v = 0; v < kVectors; ++v) {
      const std::size_t x = static_cast<std::size_t>(v) * lanes_;
      const auto canvas =
          hn::Sub(run_at(gained + x, plan_.canvas_row), run_at(lost + x, plan_.canvas_row));
      add(change(canvas), v, 0, plan_.weights.canvas);
      add(change(hn::Sub(outer[v], outer_[v])), v, 1, plan_.weights.outer);
      add(change(hn::Sub(inner[v], inner_[v])), v, 2, plan_.weights.inner);
      outer_[v] = outer[v];
      inner_[v] = inner[v];
    }
  }

  static HWY_INLINE hn::Vec<Changes> change(SumVector difference) {
    return hn::BitCast(Changes(), difference);
  }

  template <typename V>
  HWY_INLINE void add(V values, int v, int shape, std::int32_t weight) {
    for (int half = 0; half < kHalves; ++half) {
      const auto wide = half_of(values, half);
      if constexpr (kShapes == 1) {
        auto& total = totals_[v * kHalves + half];
        total = hn::Add(total, hn::Mul(wide, hn::Set(Totals(), weight)));
      } else {
        auto& total = totals_[(shape * kVectors + v) * kHalves + half];
        total = hn::Add(total, wide);
      }
    }
  }

  HWY_INLINE void put(int row) {
    if constexpr (kShapes == 1) {
      for (int i = 0; i < kVectors * kHalves; ++i) lowest_[i] = hn::Min(lowest_[i], totals_[i]);
    }
    if (row < plan_.kept_first || row >= plan_.kept_last) return;
    for (int shape = 0; shape < kShapes; ++shape) {
      std::int32_t* to = plan_.out[static_cast<std::size_t>(shape)] +
                         (row - plan_.kept_first) * plan_.out_stride + x_;
      for (int i = 0; i < kVectors * kHalves; ++i) {
        hn::StoreU(totals_[shape * kVectors * kHalves + i], Totals(),
                   to + static_cast<std::size_t>(i) * hn::Lanes(Totals()));
      }
    }
  }

  // Of the columns that are candidates.
  HWY_INLINE std::int32_t lowest() const {
    const auto none = hn::Set(Totals(), std::numeric_limits<std::int32_t>::max());
    auto all = none;
    for (int i = 0; i < kVectors * kHalves; ++i) {
      const std::size_t x = x_ + static_cast<std::size_t>(i) * hn::Lanes(Totals());
      if (x >= plan_.width) break;
      const auto inside = hn::FirstN(Totals(), plan_.width - x);
      all = hn::Min(all, hn::IfThenElse(inside, lowest_[i], none));
    }
    return hn::GetLane(hn::MinOfLanes(Totals(), all));
  }

  const SweepPlan& plan_;
  std::size_t x_;
  std::size_t lanes_;
  SumVector outer_[kVectors];
  SumVector inner_[kVectors];
  TotalVector totals_[kShapes * kVectors * kHalves];
  TotalVector lowest_[kVectors * kHalves];
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

// Whole strips are written.
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
  outer_.clear();
  inner_.clear();
  for (int row = 0; row < kernel.height(); ++row) {
    add_run(outer_, row * picture.stride(), kernel.outer_run(row));
    add_run(inner_, row * picture.stride(), kernel.inner_run(row));
  }
  SweepPlan plan;
  plan.stride = picture.stride();
  plan.first = picture.row(candidates.y - kernel.anchor_y() - picture.place().y) +
               (candidates.x - kernel.anchor_x() - picture.place().x);
  plan.width = static_cast<std::size_t>(candidates.width);
  plan.rows = candidates.height;
  plan.canvas_height = kernel.height();
  plan.canvas_row = {kernel.width(), 0};
  plan.kept_first = kept.y - candidates.y;
  plan.kept_last = plan.kept_first + kept.height;
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

std::array<std::int32_t, 3> sums_at(const RowSums& picture, const EllipseKernel& kernel, int x,
                                    int y) {
  std::array<std::int32_t, 3> sums{};
  const std::uint16_t* place = picture.row(y - kernel.anchor_y() - picture.place().y) +
                               (x - kernel.anchor_x() - picture.place().x);
  const auto sum_of = [&](int first, int last) {
    return static_cast<std::uint16_t>(place[last] - place[first]);
  };
  for (int row = 0; row < kernel.height(); ++row, place += picture.stride()) {
    const EllipseKernel::Run outer = kernel.outer_run(row);
    const EllipseKernel::Run inner = kernel.inner_run(row);
    sums[0] += sum_of(0, kernel.width());
    sums[1] += sum_of(outer.first, outer.last);
    sums[2] += sum_of(inner.first, inner.last);
  }
  return sums;
}

}  // namespace puck
#endif
