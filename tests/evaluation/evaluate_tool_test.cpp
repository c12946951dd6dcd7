#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/event_writer.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/log_file.h"
#include "common/messaging/message_codec.h"
#include "common/recording/event_log_reader.h"
#include "tests/support/contains.h"
#include "tests/support/temporary_folder.h"
#include "tools/evaluate/runs.h"
#include "tools/evaluate/scoring.h"

namespace puck {
namespace {

constexpr SensorSize kRecordedSensor{64, 48};

TrackerSetup setup() {
  TrackerSetup setup;
  setup.size_model.width_0 = 12;
  setup.size_model.height_0 = 10;
  return setup;
}

EventPacket one_event_at(std::int64_t t_us) {
  EventPacket packet;
  packet.start = {t_us};
  packet.events.resize(1);
  return packet;
}

std::filesystem::path recording_of(const TemporaryFolder& folder,
                                   const std::vector<std::int64_t>& times_us) {
  const std::filesystem::path path = folder / "events.txt";
  const auto writer = make_event_writer(path, "text", kRecordedSensor);
  for (const std::int64_t t_us : times_us) writer->write(one_event_at(t_us));
  writer->close();
  return path;
}

// Two events at this distance in time.
std::filesystem::path recording_with_pause(const TemporaryFolder& folder, std::int64_t pause_us) {
  return recording_of(folder, {1000, 1000 + pause_us});
}

TEST_CASE("only the presets that correlate take another surface than EROS") {
  TrackerSetup other = setup();
  other.surface = SurfaceKind::kTos;
  CHECK_THROWS_AS(other.pipeline_params(), std::invalid_argument);
  other.preset = Preset::kPaper;
  CHECK(search_params(other.pipeline_params()).surface == SurfaceKind::kTos);
  other.algorithm = Algorithm::kParticleFilterEros;
  CHECK_THROWS_AS(other.pipeline_params(), std::invalid_argument);
}

TEST_CASE("only the presets that correlate can keep a region of the surface alone") {
  TrackerSetup other = setup();
  other.roi_only = true;
  CHECK_THROWS_AS(other.pipeline_params(), std::invalid_argument);
  other.preset = Preset::kReference;
  CHECK(is_roi_only(other.pipeline_params()));
}

TEST_CASE("in a pause of a recording an estimate is requested at every tick") {
  const TemporaryFolder folder;
  const auto events = open_event_file(recording_with_pause(folder, 1'000'000));
  std::vector<std::int64_t> ticks;
  run_at_rate(*events, setup(), 10, [&](const EvaluatedTick& t) { ticks.push_back(t.tick.us); });
  REQUIRE(ticks.size() == 11);
  CHECK(ticks.front() == 100'000);
  CHECK(ticks.back() == 1'100'000);
}

TEST_CASE("a recording with a damaged time is refused and ends") {
  const TemporaryFolder folder;
  const auto events = open_event_file(recording_with_pause(folder, 8'000'000'000'000'000));
  const auto nothing = [](const EvaluatedTick&) {};
  std::string at_rate;
  try {
    run_at_rate(*events, setup(), 1000, nothing);
  } catch (const std::runtime_error& error) {
    at_rate = error.what();
  }
  CHECK(at_rate ==
        "the recording pauses from 1000 to 8000000000001000 µs, more than an hour: is a time "
        "damaged?");
  events->rewind();
  CHECK_THROWS_AS(run_in_real_time(*events, setup(), nothing), std::runtime_error);
}

TEST_CASE("in real time the ticks are those with events, and no wait exceeds the run") {
  const TemporaryFolder folder;
  // The first packet comes after the tracking thread's first estimate, the last one late enough for
  // an answer to those before it.
  const auto events = open_event_file(recording_of(folder, {1000, 1499, 301'000}));
  const auto began = std::chrono::steady_clock::now();
  std::vector<EvaluatedTick> ticks;
  run_in_real_time(*events, setup(), [&](const EvaluatedTick& tick) { ticks.push_back(tick); });
  const auto ran = std::chrono::steady_clock::now() - began;
  REQUIRE(!ticks.empty());
  CHECK(ticks.front().tick.us >= 1000);
  for (const EvaluatedTick& tick : ticks) {
    CHECK(std::chrono::microseconds(tick.latency_us.value()) <= ran);
  }
}

TEST_CASE("a log's events are those of its first session, and the other sessions are reported") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.lcm";
  {
    LogWriter log(path);
    EventPacker packer({.sensor = kRecordedSensor});
    std::vector<std::uint8_t> bytes;
    std::int64_t seq = 0;
    for (const std::int64_t session : {7, 7, 8}) {
      const EventPacket packet = one_event_at(1000 * (seq + 1));
      packer.pack(packet.start, packet.events, [&](event_packet_t& message) {
        message.utime = 1;
        message.session = session;
        message.seq = seq++;
        encode(message, bytes);
        log.write("PUCK_EVENTS", 1, bytes);
      });
    }
  }
  const auto events = open_event_log(path, "", EventLog::Sessions::kFirst);
  EventPacket packet;
  std::vector<std::int64_t> times;
  while (events->read(packet, 10)) times.push_back(packet.start.us);
  CHECK(times == std::vector<std::int64_t>{1000, 2000});
  REQUIRE(events->warnings().size() == 1);
  CHECK(events->warnings()[0].find("1 packets of events left out") != std::string::npos);
}

std::vector<TruthRow> truth_until(std::int64_t last_us) {
  std::vector<TruthRow> rows;
  for (std::int64_t t_us = 0; t_us <= last_us; t_us += 10'000) {
    rows.push_back({{t_us}, {10 + static_cast<double>(t_us) * 1e-5, 10}, {12, 10}, 1});
  }
  return rows;
}

EvaluatedTick silent_tick_at(std::int64_t t_us, bool is_mark = false) {
  return {{t_us}, PuckEstimate{}, std::nullopt, is_mark};
}

TEST_CASE("truth that ends early, has gaps or does not match the events is reported") {
  EvaluationReport report;
  report.run.first = {0};
  report.run.last = {3'000'000};
  const auto warnings_after = [&](std::vector<TruthRow> truth, std::int64_t tick_us) {
    Scoring scoring({}, std::move(truth), kRecordedSensor);
    scoring.add(silent_tick_at(tick_us));
    scoring.write_to(report);
    return scoring.warnings(report);
  };
  CHECK(warnings_after(truth_until(2'950'000), 2'900'000).empty());
  const auto half = warnings_after(truth_until(1'500'000), 1'400'000);
  REQUIRE(half.size() == 1);
  CHECK(half[0] ==
        "the truth goes from 0.000 to 1.500 s, the events from 0.000 to 3.000 s: only the ticks "
        "that the truth covers count");
  const auto nothing = warnings_after(truth_until(1'500'000), 1'600'000);
  REQUIRE(nothing.size() == 1);
  CHECK(contains(nothing[0], "not one tick counts"));
  std::vector<TruthRow> sparse = truth_until(3'000'000);
  sparse.erase(sparse.begin() + 100, sparse.begin() + 200);
  const auto gap = warnings_after(sparse, 1'500'000);
  REQUIRE(gap.size() == 2);
  CHECK(contains(gap[0],
                 "100.0 % of the ticks within the truth do not count, as its rows are too far "
                 "apart (1010 ms"));
}

TEST_CASE("at marks estimates are requested at each row's own time, and only these are scored") {
  const TemporaryFolder folder;
  const auto events = open_event_file(recording_with_pause(folder, 1'000'000));
  const std::vector<Timestamp> marks{{500}, {150'000}, {200'000}, {250'500}, {9'000'000}};
  std::vector<std::pair<std::int64_t, bool>> ticks;
  run_at_rate(
      *events, setup(), 10,
      [&](const EvaluatedTick& tick) {
        if (tick.tick.us < 400'000) ticks.emplace_back(tick.tick.us, tick.is_mark);
      },
      marks);
  CHECK(ticks ==
        std::vector<std::pair<std::int64_t, bool>>{
            {100'000, false}, {150'000, true}, {200'000, true}, {250'500, true}, {300'000, false}});
  EvaluateOptions options;
  options.score_at_marks = true;
  Scoring scoring(options, truth_until(2'000'000), kRecordedSensor);
  CHECK(scoring.marks().size() == 201);
  scoring.add(silent_tick_at(1'000'000, true));
  scoring.add(silent_tick_at(1'001'000, false));
  CHECK(scoring.samples().size() == 1);
  CHECK_THROWS_AS(Scoring(options, {}, kRecordedSensor), std::invalid_argument);
}

TEST_CASE("without a puck every tracked tick is said and wrong") {
  EvaluateOptions options;
  options.no_puck = true;
  Scoring scoring(options, {}, kRecordedSensor);
  EvaluatedTick tracked = silent_tick_at(1000);
  tracked.estimate.state = TrackState::kTracking;
  scoring.add(tracked);
  for (int ms = 2; ms <= 4; ++ms) scoring.add(silent_tick_at(ms * 1000));
  EvaluationReport report;
  scoring.write_to(report);
  CHECK(report.said_and_wrong_percent == 25);
  CHECK_FALSE(report.errors.has_value());
}

TEST_CASE("at a rate the cost of the tracker is measured and the events get real times") {
  const TemporaryFolder folder;
  const auto events = open_event_file(recording_with_pause(folder, 1'000'000));
  const RunSummary run = run_at_rate(*events, setup(), 10, [](const EvaluatedTick&) {});
  CHECK(run.first.us == 1000);
  CHECK(run.last.us == 1'001'000);
  REQUIRE(run.cpu_us_per_ms.has_value());
  CHECK(*run.cpu_us_per_ms > 0);
}

TEST_CASE("a detection region is four numbers of at most five digits") {
  CHECK(parse_region("60,150,500,80").right() == 560);
  CHECK_THROWS_AS(parse_region("2147483647,1,2147483647,3"), std::invalid_argument);
  CHECK_THROWS_AS(parse_region("60,150,500"), std::invalid_argument);
  CHECK_THROWS_AS(parse_region("60,150,500,80,1"), std::invalid_argument);
}

TEST_CASE("a decision's number is multiplied, each by its name") {
  CHECK_FALSE(scaled_decision({}).has_value());
  const DecisionParams plain;
  const auto scaled = scaled_decision({"confirm=0.5", "settled_us=2", "hide=3"});
  REQUIRE(scaled.has_value());
  CHECK(scaled->confirm == plain.confirm * 0.5);
  CHECK(scaled->settled_us == plain.settled_us * 2);
  CHECK(scaled->rates.hide == plain.rates.hide * 3);
  CHECK(scaled->rates.show == plain.rates.show);
  for (const char* wrong : {"confirm", "confirm=", "confirm=0", "confirm=x", "firm=2", "=2"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(scaled_decision({wrong}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace puck
