#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace puck {

/// What is said of one scenario: its own figures, and what went wrong.
class Verdict {
 public:
  void note(const std::string& figure) { notes_.push_back(figure); }
  /// Whatever is not as it should be fails the scenario.
  void demand(bool holds, const std::string& complaint) {
    if (!holds) complaints_.push_back(complaint);
  }
  /// An event that is asked for within some time. Said always; fails only when it never came, or
  /// took four times as long: a machine on which all the containers share two busy cores may
  /// stand still for that.
  void demand_within(const std::string& what, bool came, std::int64_t took_us,
                     std::int64_t asked_us);

  bool passed() const { return complaints_.empty(); }
  const std::vector<std::string>& notes() const { return notes_; }
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  std::vector<std::string> notes_;
  std::vector<std::string> complaints_;
};

/// "0.98 %" of 0.98, 2 and "%".
std::string figure_text(double value, int decimals, const std::string& unit);

}  // namespace puck
