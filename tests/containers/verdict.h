#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace puck {

/// Result of one scenario: its figures and its failures.
class Verdict {
 public:
  void note(const std::string& figure) { notes_.push_back(figure); }
  /// Fails the scenario with the complaint, unless `holds`.
  void demand(bool holds, const std::string& complaint) {
    if (!holds) complaints_.push_back(complaint);
  }
  /// An event that must come within some time. Always printed; fails only without the event, or
  /// after four times that time, because a machine with all the containers on two busy cores may
  /// stall.
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
