#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace puck {

/// Rates of change of what a hypothesis is, per second.
struct BeliefRates {
  double hide = 1;     ///< A visible puck becomes covered, where something is seen to come.
  double show = 5;     ///< A covered puck shows again.
  double leave = 0.1;  ///< The puck is elsewhere: a hypothesis with events …
  double leave_silent = 0.002;  ///< … without …
  double leave_hidden = 2;      ///< … one of a covered puck …
  double elsewhere = 20;        ///< … and any while the puck is seen elsewhere.
  double come = 0.2;            ///< The puck comes to be where the hypothesis is.
};

/// Belief that a hypothesis is the puck and visible, is the puck but covered, or is not the puck: a
/// Markov chain whose state is observed through Evidence::sum. Forgets by its rates, so that a
/// certainty of seconds is undone within some packets.
class PuckBelief {
 public:
  explicit PuckBelief(double log_odds = 0)
      : visible_(1 / (1 + std::exp(-log_odds))), not_puck_(1 - visible_) {}

  /// Lets `seconds` pass, however many. `comes`: how much of the place is busy with something that
  /// may cover the puck, 0 to 1; `told`: Evidence::told: while it is 0, a visible puck is not
  /// covered, and a covered one does not show; `elsewhere`: probability that the puck is seen
  /// elsewhere.
  void pass(double seconds, double comes, double told, double elsewhere, const BeliefRates& rates) {
    const double away = rates.elsewhere * elsewhere;
    const double leave = away + rates.leave_silent + (rates.leave - rates.leave_silent) * told;
    const auto [hides, leaves] = outflows(visible_, rates.hide * comes * told, leave, seconds);
    const auto [shows, forgets] =
        outflows(hidden_, rates.show * told, away + rates.leave_hidden * told, seconds);
    const double appears = outflows(not_puck_, rates.come, 0, seconds)[0];
    visible_ += shows + appears - hides - leaves;
    hidden_ += hides - shows - forgets;
    not_puck_ += leaves + forgets - appears;
  }

  /// Takes a packet's log likelihood ratio. A covered puck's events are of what covers it.
  void take(double nats) {
    visible_ *= std::exp(nats);
    const double sum = visible_ + hidden_ + not_puck_;
    visible_ /= sum;
    hidden_ /= sum;
    not_puck_ /= sum;
  }

  double visible() const { return visible_; }
  /// That it is the puck, visible or not, against that it is not.
  double odds() const { return (visible_ + hidden_) / std::max(not_puck_, 1e-12); }
  double visible_odds() const { return visible_ / std::max(not_puck_, 1e-12); }
  /// If it is the puck, it is rather covered than seen.
  bool is_covered() const { return seen_share() < 0.5; }
  /// If it is the puck, how likely it is seen.
  double seen_share() const { return visible_ / std::max(visible_ + hidden_, 1e-12); }

 private:
  // What leaves a state at two rates; together no more than there is.
  static std::array<double, 2> outflows(double state, double one, double other, double seconds) {
    const double rate = one + other;
    if (!(rate > 0)) return {0, 0};
    const double out = state * (1 - std::exp(-rate * seconds));
    return {out * one / rate, out * other / rate};
  }

  double visible_;
  double hidden_ = 0;
  double not_puck_;
};

/// Whether a hypothesis has moved by itself. Marks of the scene never do: they move with the scene
/// when the camera turns.
class OwnMotion {
 public:
  /// Factor of the odds that it is a mark: 1 until it has moved by itself.
  double mark() const { return mark_; }

  /// `still`: probability that it moved with the scene during `seconds`. `slip`:
  /// DecisionParams::slip.
  void pass(double seconds, double still, double slip) {
    mark_ *= std::exp(-(1 - still) * seconds * kMost_nats / kTelling_s);
    mark_ = std::clamp(mark_ + slip * still * seconds, std::exp(-kMost_nats), 1.0);
  }

  /// It is known to have moved.
  void moved() { mark_ = std::exp(-kMost_nats); }

 private:
  // Moving by itself for this time is evidence of this size against a mark.
  static constexpr double kTelling_s = 0.01;
  static constexpr double kMost_nats = 8;

  double mark_ = 1;
};

}  // namespace puck
