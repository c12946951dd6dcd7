#include "tools/demo_report/demo_table.h"

#include <cstdint>
#include <cstdio>
#include <optional>

namespace puck {
namespace {

std::string count_of(std::int64_t count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::string fixed(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

/// Rows with a name and values.
class Table {
 public:
  void heading(const char* text) { text_ += std::string(text) + '\n'; }
  void latency_heading(const char* text) {
    char line[96];
    std::snprintf(line, sizeof line, "%-40s %10s %10s %10s\n", text, "median", "99 %", "maximum");
    text_ += line;
  }
  void row(const char* name, const std::optional<std::int64_t>& value) {
    row(name, value ? std::to_string(*value) : "-", "");
  }
  void row(const char* name, const std::optional<double>& value, const char* unit) {
    row(name, value ? fixed(*value) : "-", value ? unit : "");
  }
  void row(const char* name, const std::optional<LoggedLatency>& latency) {
    if (!latency) return row(name, "-", "");
    char line[96];
    std::snprintf(line, sizeof line, "  %-38s %10lld %10lld %10lld us\n", name,
                  static_cast<long long>(latency->p50_us), static_cast<long long>(latency->p99_us),
                  static_cast<long long>(latency->max_us));
    text_ += line;
  }
  void note(const std::string& text) { text_ += "  " + text + '\n'; }
  void sentence(const std::string& text) { text_ += '\n' + text + '\n'; }

  const std::string& text() const { return text_; }

 private:
  void row(const char* name, const std::string& value, const char* unit) {
    char line[96];
    std::snprintf(line, sizeof line, "  %-38s %10s%s%s\n", name, value.c_str(),
                  *unit == '\0' ? "" : " ", unit);
    text_ += line;
  }

  std::string text_;
};

void add_game(const DemoFigures& f, Table& table) {
  table.heading("Game, as the simulated table counted it");
  table.row("shots at the robot's goal", f.shots);
  table.row("saves", f.saves);
  table.row("goals against the robot", f.goals_against);
  if (f.shots && f.saves && f.goals_against) {
    const std::int64_t open = *f.shots - *f.saves - *f.goals_against;
    if (open > 0) {
      table.note(count_of(open, "shot", "shots") +
                 " neither saved nor in: still under way, or stopped by the opponent");
    } else if (open < 0) {
      table.note(count_of(-open, "goal", "goals") +
                 " besides missed shots: a saved puck that went in by a rail, or an own goal");
    }
  }
  if (f.believed_shots && f.believed_saves && f.believed_goals_against &&
      (f.believed_shots != f.shots || f.believed_saves != f.saves ||
       f.believed_goals_against != f.goals_against)) {
    table.note("the bridge counted differently, from estimates: " +
               count_of(*f.believed_shots, "shot", "shots") + ", " +
               count_of(*f.believed_saves, "save", "saves") + ", " +
               count_of(*f.believed_goals_against, "goal", "goals") + " against");
  }
}

std::string what_happened(const DemoFigures& f) {
  std::string text;
  if (f.shots == 0) {
    text = "There was no shot at the robot's goal; the tracker ";
  } else if (f.shots && f.saves) {
    text = "The robot saved " + std::to_string(*f.saves) + " of " +
           count_of(*f.shots, "shot", "shots") + "; the tracker ";
  } else {
    text = "The tracker ";
  }
  if (f.mean_px && f.lost_percent) {
    text += "was " + fixed(*f.mean_px) + " px off on average and lost the puck for " +
            fixed(*f.lost_percent) + " % of the time";
  } else {
    text += "made " + count_of(f.estimates, "estimate", "estimates");
  }
  if (f.events_lost) {
    text += *f.events_lost == 0
                ? "; no event was lost"
                : "; " + count_of(*f.events_lost, "event was", "events were") + " lost";
  }
  return text + '.';
}

}  // namespace

std::string demo_table(const DemoFigures& f) {
  Table table;
  table.heading("Events");
  table.row("sent by the camera", f.events_sent);
  table.row("received by the tracker", f.events_received);
  table.row("lost between them", f.events_lost);
  table.heading("Estimates");
  table.row("published", std::optional(f.estimates));
  table.row("rate of those with new events", f.estimate_rate_hz, "Hz");
  table.row("position error, mean", f.mean_px, "px");
  table.row("position error, median", f.median_px, "px");
  table.row("position error, 95th percentile", f.p95_px, "px");
  table.row("puck lost (> 20 px off, or no track)", f.lost_percent, "%");
  table.latency_heading("Latency");
  table.row("packet received to estimate published", f.packet_to_estimate);
  table.row("event at the sensor to estimate", f.sensor_to_estimate);
  table.row("event backlog (received, not applied)", f.backlog);
  table.row("estimate received to command sent", f.estimate_to_command);
  table.heading("Messages, all services together");
  table.row("received", std::optional(f.bus.received));
  table.row("lost", std::optional(f.bus.lost));
  table.row("out of order or duplicate", std::optional(f.bus.late + f.bus.duplicate));
  table.row("malformed", std::optional(f.bus.rejected));
  table.row("foreign datagrams on this port", std::optional(f.bus.foreign));
  if (f.bus.left_out > 0) {
    table.note(count_of(f.bus.left_out, "counter", "counters") +
               " did not fit into STATUS: a 0 here may be more");
  }
  add_game(f, table);
  table.heading("Replay of the recorded events into a second tracker");
  table.row("estimates", f.replay_estimates);
  table.row("mean distance to the recorded estimates", f.replay_mean_difference_px, "px");
  table.sentence(what_happened(f));
  return table.text();
}

}  // namespace puck
