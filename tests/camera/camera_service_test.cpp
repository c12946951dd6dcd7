#include "services/camera/camera_service.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <thread>

#include <doctest/doctest.h>

#include "common/io/pixel_mask_file.h"
#include "tests/camera/camera_fixtures.h"
#include "tests/camera/camera_run.h"
#include "tests/camera/tcp_server.h"
#include "tests/support/contains.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

std::string file_settings(const std::filesystem::path& path, const std::string& more = "") {
  return "[camera]\nsource = \"file\"\nfile = \"" + path.string() + "\"\n" + more;
}

TEST_CASE("a recording is published whole, in order and unchanged, then the camera ends") {
  const CameraFolder folder;
  const auto expected = even_events(20000, 7'139'845, 3);
  write_recording(folder / "a.raw", expected);
  CameraRun run(file_settings(folder / "a.raw"));
  run.run();
  CHECK(run.events_ == expected);
  CHECK(run.in_order_);
  CHECK(run.packets_.front().width == 64);
  CHECK(run.packets_.front().height == 48);
  CHECK(run.packets_.back().events_before + run.packets_.back().count == 20000);
  CHECK(run.last_counter("events_sent") == 20000);
  CHECK(run.last_counter("packets_sent") == static_cast<std::int64_t>(run.packets_.size()));
  CHECK(run.last_counter("events_dropped") == 0);
  CHECK(run.statuses_.back().state == service_status_t::STATE_STOPPING);
  CHECK(run.log_text_.str().find("has ended after 20000 events") != std::string::npos);
}

TEST_CASE("no packet is published before its events have happened") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(1000, 1000, 50));
  CameraRun run(file_settings(folder / "a.raw", "quiet_flush_us = 500\n"));
  run.run();
  REQUIRE(run.packets_.size() > 50);
  const std::int64_t zero_utime = run.packets_.front().sensor_zero_utime;
  for (const event_packet_t& packet : run.packets_) {
    // The plan reads the two clocks one after the other.
    constexpr std::int64_t kClocksApartUs = 1000;
    CHECK(packet.utime + kClocksApartUs >=
          packet.sensor_zero_utime + packet.first_event_us + packet.duration_us);
    CHECK(packet.sensor_zero_utime >= zero_utime);
    CHECK(packet.duration_us < 500);
  }
}

TEST_CASE("packets due every 150 us are published one by one") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(240'000, 1000, 4));
  CameraRun run(file_settings(folder / "a.raw", "flush_us = 150\n"));
  run.run();
  REQUIRE(run.packets_.size() > 1000);
  // A busy machine may still send bursts: the best 3 ms count.
  constexpr std::size_t kPart = 20;
  std::size_t fewest_at_once = kPart;
  for (std::size_t first = 1; first + kPart <= run.packets_.size(); first += kPart) {
    std::size_t at_once = 0;
    for (std::size_t i = first; i < first + kPart; ++i) {
      if (run.packets_[i].utime - run.packets_[i - 1].utime < 50) ++at_once;
    }
    fewest_at_once = std::min(fewest_at_once, at_once);
  }
  MESSAGE("fewest of ", kPart, " at once: ", fewest_at_once);
  CHECK(fewest_at_once < kPart / 5);
}

TEST_CASE("packets have a bounded size in bytes") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(20000, 0, 1));
  CameraRun run(file_settings(folder / "a.raw", "packet_bytes = 1472\nflush_us = 5000\n"));
  run.run();
  CHECK(run.events_.size() == 20000);
  for (const event_packet_t& packet : run.packets_) CHECK(packet.count <= (1472 - 93) / 4);
  CHECK(run.packets_.front().count > 300);
}

TEST_CASE(
    "at another playing speed sensor time has no zero on the host's clock, and is unchanged") {
  const CameraFolder folder;
  const auto expected = even_events(1000, 1000, 1000);
  write_recording(folder / "a.raw", expected);
  CameraRun run(file_settings(folder / "a.raw", "speed = 20.0\n"));
  run.run();
  CHECK(run.events_ == expected);
  CHECK(run.packets_.front().sensor_zero_utime == 0);
}

TEST_CASE("the images of a robot's inverted eyes are turned upright") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", {{0, 0, 0, 1}, {1, 63, 47, 0}, {2, 10, 20, 1}});
  CameraRun run(file_settings(folder / "a.raw", "rotate_180 = true\n"));
  run.run();
  CHECK(run.events_ == std::vector<SeenEvent>{{0, 63, 47, 1}, {1, 0, 0, 0}, {2, 53, 27, 1}});
}

TEST_CASE("events of masked pixels are dropped before any rotation, and counted") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", {{0, 5, 6, 1}, {1, 58, 41, 0}, {2, 5, 6, 0}, {3, 9, 9, 1}});
  write_pixel_mask_file(folder / "mask.toml", PixelMask({64, 48}, std::vector<PixelPlace>{{5, 6}}),
                        "");
  const std::string mask = "hot_pixel_mask = \"" + (folder / "mask.toml").string() + "\"\n";
  CameraRun run(file_settings(folder / "a.raw", "rotate_180 = true\n" + mask));
  run.run();
  CHECK(run.events_ == std::vector<SeenEvent>{{1, 5, 6, 0}, {3, 54, 38, 1}});
  CHECK(run.last_counter("events_masked") == 2);
  CHECK(run.last_counter("events_sent") == 2);
}

TEST_CASE("each filter of the camera counts in STATUS, and the log tells the counts") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", {{0, 5, 6, 1},      // A masked pixel.
                                     {1, 63, 6, 1},     // Outside the crop.
                                     {2, 9, 9, 0},      // Of the other polarity.
                                     {3, 9, 9, 1},      // Without a neighbour.
                                     {4, 9, 9, 1},      // In the refractory period.
                                     {5, 10, 9, 1},     // Left.
                                     {6, 30, 20, 1}});  // Without a neighbour.
  write_pixel_mask_file(folder / "mask.toml", PixelMask({64, 48}, std::vector<PixelPlace>{{5, 6}}),
                        "");
  CameraRun run(file_settings(folder / "a.raw",
                              "crop = [0, 0, 60, 48]\npolarity = \"on\"\nrefractory_us = 100\n"
                              "background_activity_us = 50\nflip_x = true\nrotate_deg = 90\n"
                              "hot_pixel_mask = \"" +
                                  (folder / "mask.toml").string() + "\"\n"));
  run.run();
  CHECK(run.events_ == std::vector<SeenEvent>{{5, 38, 53, 1}});
  // The size is that of the rotated sensor, not of the crop.
  CHECK(run.packets_.front().width == 48);
  CHECK(run.packets_.front().height == 64);
  CHECK(run.last_counter("events_sent") == 1);
  CHECK(run.last_counter("events_dropped") == 0);
  CHECK(run.last_counter("events_masked") == 1);
  CHECK(run.last_counter("events_outside_crop") == 1);
  CHECK(run.last_counter("events_other_polarity") == 1);
  CHECK(run.last_counter("events_refractory") == 1);
  CHECK(run.last_counter("events_background") == 2);
  CHECK(contains(run.log_text_.str(), "2 events of background activity were left out"));
}

TEST_CASE("a lens is undistorted, and what leaves the picture is counted") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", {{0, 0, 0, 1}, {1, 32, 24, 0}, {2, 42, 24, 1}});
  std::ofstream(folder / "lens.toml")
      << "[lens]\nwidth = 64\nheight = 48\nfx = 20\nfy = 20\ncx = 32\ncy = 24\n"
         "model = \"fisheye\"\n";
  CameraRun run(
      file_settings(folder / "a.raw", "undistort = \"" + (folder / "lens.toml").string() + "\"\n"));
  run.run();
  // 20 tan(0.5) = 10.93.
  CHECK(run.events_ == std::vector<SeenEvent>{{1, 32, 24, 0}, {2, 43, 24, 1}});
  CHECK(run.last_counter("events_outside_picture") == 1);
}

TEST_CASE("a looped recording goes on until it is stopped") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", even_events(500, 0, 10));
  CameraRun run(file_settings(folder / "a.raw", "loop = true\n"));
  run.run(1700);
  REQUIRE(run.events_.size() >= 1700);
  for (std::size_t i = 1; i < run.events_.size(); ++i) {
    REQUIRE(run.events_[i].t_us > run.events_[i - 1].t_us);
  }
}

TEST_CASE("events outside the sensor are counted in every packet and in STATUS") {
  const CameraFolder folder;
  {
    const auto writer = make_event_writer(folder / "a.txt", "text", {64, 48});
    writer->close();
  }
  std::FILE* file = std::fopen((folder / "a.txt").c_str(), "a");
  REQUIRE(file != nullptr);
  std::fputs("0 64 0 1\n1 0 48 1\n2 5 6 1\n", file);
  std::fclose(file);
  CameraRun run(file_settings(folder / "a.txt"));
  run.run();
  CHECK(run.events_ == std::vector<SeenEvent>{{2, 5, 6, 1}});
  CHECK(run.packets_.front().events_dropped == 2);
  CHECK(run.last_counter("events_dropped") == 2);
  CHECK(run.log_text_.str().find("2 events lie outside the sensor") != std::string::npos);
}

TEST_CASE("a stream above the publishing limit loses its oldest events, with a warning") {
  const CameraFolder folder;
  // 2.4 s of publishing at the limit, sent without pacing.
  constexpr int kEvents = 1'200'000;
  write_recording(folder / "a.raw", even_events(kEvents, 0, 1));
  const TcpServer server;
  CameraRun run("[camera]\nsource = \"tcp\"\ntcp_host = \"127.0.0.1\"\ntcp_port = " +
                std::to_string(server.port()) + "\narrival_limit_mev_s = 0.5\n");
  const std::string bytes = read_text(folder / "a.raw");
  std::jthread sender([&] { server.serve(bytes); });
  // The newest events come last, after any loss.
  run.stop_when_ = [&] { return run.events_.back().t_us == kEvents - 1; };
  run.run();
  REQUIRE(!run.events_.empty());
  CHECK(run.events_.size() < kEvents);
  CHECK(run.in_order_);
  const std::int64_t dropped = run.last_counter("events_dropped").value();
  CHECK(dropped > 0);
  CHECK(static_cast<std::int64_t>(run.events_.size()) + dropped == kEvents);
  CHECK(run.packets_.back().events_dropped == dropped);
  bool was_degraded = false;
  for (const service_status_t& status : run.statuses_) {
    was_degraded = was_degraded || (status.state == service_status_t::STATE_DEGRADED &&
                                    status.state_text.find("drops events") == 0);
  }
  CHECK(was_degraded);
}

TEST_CASE("a camera that waits through a gap in a recording reports its length") {
  const CameraFolder folder;
  write_recording(folder / "a.raw", {{1000, 1, 1, 0}, {2'500'000, 2, 2, 1}});
  CameraRun run(file_settings(folder / "a.raw"));
  run.run();
  CHECK(run.events_.size() == 2);
  const auto says_so = [](const service_status_t& status) {
    return status.state == service_status_t::STATE_WAITING &&
           status.state_text == "for the next events in 2 s";
  };
  CHECK(std::any_of(run.statuses_.begin(), run.statuses_.end(), says_so));
  CHECK(contains(run.log_text_.str(), "waiting for the next events in 2 s"));
}

TEST_CASE("a gap longer than camera.skip_gaps_s is not waited for, a shorter one is") {
  const CameraFolder folder;
  const std::vector<SeenEvent> events{{1000, 1, 1, 0}, {301'000, 1, 2, 0}, {900'000'000, 2, 2, 1}};
  write_recording(folder / "a.raw", events);
  CameraRun run(file_settings(folder / "a.raw", "skip_gaps_s = 0.5\n"));
  run.run();
  CHECK(run.events_ == events);
  REQUIRE(run.packets_.size() == 3);
  CHECK(run.packets_[1].utime - run.packets_[0].utime > 200'000);
  CHECK(contains(run.log_text_.str(), "skipped a gap of 899.69"));
  // Sensor time goes on, and its zero moves with the jump.
  CHECK(run.packets_[2].session == run.packets_[0].session);
  CHECK(run.packets_[0].sensor_zero_utime - run.packets_[2].sensor_zero_utime > 899'000'000);
}

TEST_CASE("the simulated table publishes events, truth and head") {
  CameraRun run("");
  run.run(3000);
  CHECK(run.packets_.front().width == 640);
  REQUIRE(run.truths_us_.size() > 5);
  CHECK(run.truths_us_[0] == 0);
  CHECK(run.truths_us_[1] == 1000);
  CHECK(run.heads_ == static_cast<int>(run.truths_us_.size()));
  // Truth is published before the later events: at most a packet's age ahead of them.
  CHECK(run.truths_us_.back() + 2000 >= run.events_.back().t_us);
}

TEST_CASE("the arm's state moves the simulated mallet, which the camera sees") {
  const auto events_in_first_300_ms = [](bool arm_moves) {
    CameraRun run("[simulation.sensor]\nnoise_hz = 0.0\nhot_pixel_fraction = 0.0\n");
    run.on_truth_ = [&] {
      if (run.truths_us_.size() >= 310) run.stop_.request_stop();
      if (!arm_moves) return;
      arm_state_t state{};
      state.line_x_m = 0.15;
      state.line_min_m = -0.3;
      state.line_max_m = 0.3;
      state.back_end = "simulated";
      state.position_m = 0.25;
      REQUIRE(run.bus_.publish(state));
    };
    run.run();
    return std::count_if(run.events_.begin(), run.events_.end(),
                         [](const SeenEvent& event) { return event.t_us < 300'000; });
  };
  const auto still = events_in_first_300_ms(false);
  const auto moved = events_in_first_300_ms(true);
  MESSAGE("events: mallet still " << still << ", moved " << moved);
  CHECK(moved > still + 1000);
}

TEST_CASE("impossible settings are refused with their key") {
  const auto refusal = [](const std::string& toml) -> std::string {
    try {
      CameraRun run(toml);
      run.run(0);
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  };
  CHECK(
      contains(refusal("[camera]\nsource = \"usb\"\n"),
               "camera.toml:2: camera.source must be \"simulated\", \"file\", \"log\", \"stdin\""));
  CHECK(contains(refusal("[camera]\nsource = \"file\"\n"), "camera.file must name a recording"));
  CHECK(contains(refusal("[camera]\npacket_bytes = 100\n"), "camera.toml:2: camera.packet_bytes"));
  CHECK(contains(refusal("[camera]\nlog_prefix = \"left\"\n"),
                 "camera.log_prefix must be up to 16 of A-Z, 0-9 and _, got \"left\""));
  for (const std::string key : {"start_s = 1.0", "seconds = 2.0", "loop = true", "paused = true",
                                "rate_mev_s = 0.5", "step_us = 1000"}) {
    const std::string name = "camera." + key.substr(0, key.find(' ')) + " must be ";
    for (const std::string source : {"simulated", "stdin", "tcp"}) {
      const std::string said = refusal("[camera]\nsource = \"" + source + "\"\n" + key + "\n");
      CAPTURE(said);
      CHECK(contains(said, name));
      CHECK(
          contains(said, " when camera.source is \"" + source + "\" and not \"file\" or \"log\""));
    }
  }
  CHECK(contains(refusal("[camera]\nfile = \"game.raw\"\n"),
                 "camera.file must be \"\" when camera.source is \"simulated\""));
  CHECK(contains(refusal("[camera]\nsource = \"tcp\"\nspeed = 2.0\n"),
                 "camera.speed must be 1 when camera.source is \"tcp\" and camera.pace \"auto\""));
  CHECK(contains(refusal("[camera]\nsource = \"file\"\nfile = \"a.raw\"\npace = \"arrival\"\n"
                         "paused = true\n"),
                 "camera.paused must be false when camera.pace is \"arrival\", got true"));
  CHECK(contains(refusal("[camera]\nstep_us = 10000001\n"), "camera.step_us"));
  CHECK(contains(refusal("[camera]\nflush_us = 5\n"), "must be an integer from 50 to 100000"));
  CHECK(
      contains(refusal("[camera]\nflash_us = 500\n"), "the nearest known key is camera.flush_us"));
  CHECK(contains(refusal("[camera]\nscene = \"/nowhere.toml\"\n"),
                 "/nowhere.toml: cannot be opened"));
  CHECK(contains(refusal("[simulation.camera]\nfocal_px = -1\n"),
                 "camera.toml:2: simulation.camera.focal_px must be a number from 50 to 5000"));
  CHECK(contains(refusal("[camera]\nsource = \"file\"\nfile = \"/nowhere.raw\"\n"),
                 "/nowhere.raw: cannot be opened"));
  CHECK(contains(refusal("[camera]\nhot_pixel_mask = \"/nowhere.toml\"\n"),
                 "/nowhere.toml: cannot be opened"));
  CHECK(refusal("[camera]\ncrop = [600, 0, 100, 100]\n") ==
        "camera.crop must lie within the sensor of 640 x 480 px, got [600, 0, 100, 100]");
  CHECK(contains(
      refusal("[camera]\nrotate_deg = 90\n"),
      "camera.toml:2: camera.rotate_deg must be 0 or 180 for the simulated table, got 90"));
  const CameraFolder folder;
  write_pixel_mask_file(folder / "mask.toml", PixelMask({64, 48}, {}), "");
  CHECK(
      contains(refusal("[camera]\nhot_pixel_mask = \"" + (folder / "mask.toml").string() + "\"\n"),
               "camera.hot_pixel_mask is of a sensor of 64x48 px, the events are of one of "
               "640x480 px"));
}

}  // namespace
}  // namespace puck
