#include "tools/convert/conversion.h"

#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/io/reader_warnings.h"
#include "common/recording/recording.h"
#include "tools/command_line/progress_bar.h"
#include "tools/convert/output_place.h"
#include "tools/convert/read_ahead.h"

namespace puck {
namespace {

struct Tally {
  std::int64_t read = 0;
  std::int64_t written = 0;
  double seconds = 0;  // Of wall time.
};

// Each count and what it counts, without those that are zero; "none" without any.
std::string listed(const std::vector<std::pair<std::int64_t, const char*>>& counts) {
  std::string text;
  for (const auto& [count, what] : counts) {
    if (count == 0) continue;
    if (!text.empty()) text += ", ";
    text += std::to_string(count) + " " + what;
  }
  return text.empty() ? "none" : text;
}

std::string closing_line(const Tally& tally, const ConversionFilter& filter,
                         const EventCounters& counters) {
  const std::int64_t read =
      tally.read + counters.before_start + counters.outside_sensor + counters.backwards;
  char speed[64];
  std::snprintf(speed, sizeof speed, "%.2f s, %.1f Mev/s", tally.seconds,
                static_cast<double>(tally.read) * 1e-6 / tally.seconds);
  std::vector<std::pair<std::int64_t, const char*>> left_out{
      {filter.before(), "before --start"},
      {filter.after(), "after --seconds, where reading ended"}};
  for (const auto& reason : filter.filtered().reasons()) left_out.push_back(reason);
  left_out.insert(left_out.end(), {{counters.outside_sensor, "outside the sensor"},
                                   {counters.backwards, "older than the ones before them"},
                                   {counters.before_start, "before the first time"},
                                   {counters.missing, "missing in the input"}});
  return std::to_string(read) + " events read, " + std::to_string(tally.written) +
         " written; left out: " + listed(left_out) + "; " + speed;
}

void check_result(const Tally& tally, const ConversionFilter& filter, const std::string& name) {
  if (tally.read == 0) throw std::runtime_error(name + ": holds no events; nothing is written");
  if (tally.written > 0) return;
  char span[32];
  std::snprintf(span, sizeof span, "%.3f s", static_cast<double>(filter.span_us()) * 1e-6);
  throw std::runtime_error(name + ": no event is left of " + std::to_string(tally.read) + " in " +
                           span + "; see --start, --crop and the filters");
}

Tally pump(EventReader& events, Interruption& interruption, ConversionFilter& filter,
           EventWriter& writer) {
  Tally tally;
  const auto start = std::chrono::steady_clock::now();
  ProgressBar bar("Mev", 1e-6);
  ReadAhead ahead(events, interruption);
  EventPacket packet;
  bool goes_on = true;
  while (goes_on && ahead.next(packet)) {
    tally.read += static_cast<std::int64_t>(packet.events.size());
    goes_on = filter.apply(packet);
    writer.write(packet);
    tally.written += static_cast<std::int64_t>(packet.events.size());
    bar.show(tally.read, ahead.share_read());
  }
  ahead.stop();
  writer.close();
  tally.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return tally;
}

}  // namespace

bool convert(const ConvertOptions& options) {
  const std::string name = options.in == "-" ? "stdin" : options.in.string();
  Interruption interruption;
  EventFileOptions file = options.file;
  file.interruption = &interruption;
  const auto events = open_recording(options.in, file, options.prefix);
  ConversionFilter filter(options.filter, events->sensor_size());
  // Before the place, which has another ending.
  const std::string_view format =
      options.to.empty() ? format_of_recording(options.out) : options.to;
  OutputPlace place(options.out);
  Tally tally;
  try {
    const auto writer =
        make_recording_writer(place.path(), format, filter.sensor(), options.prefix);
    tally = pump(*events, interruption, filter, *writer);
  } catch (const EventFileError& error) {
    throw EventFileError(place.with_final_name(error.what()));
  } catch (const std::invalid_argument& error) {
    // Of the writer: a time that the format cannot hold.
    throw std::runtime_error(options.out.string() + ": " + error.what() +
                             "; --start-at-zero counts times from the first event");
  }
  check_result(tally, filter, name);
  place.keep();
  for (const std::string& warning : events->warnings()) {
    std::fprintf(stderr, "puck-convert: %s\n", warning.c_str());
  }
  std::FILE* const out = options.out == "-" ? stderr : stdout;
  std::fprintf(out, "%s\n", closing_line(tally, filter, events->counters()).c_str());
  const auto loss = large_loss(events->counters());
  if (loss) std::fprintf(stderr, "puck-convert: %s: %s\n", name.c_str(), loss->c_str());
  return !loss;
}

}  // namespace puck
