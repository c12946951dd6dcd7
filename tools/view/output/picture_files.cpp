#include "tools/view/output/picture_files.h"

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "tools/command_line/progress_bar.h"
#include "tools/view/drawing/heat_map.h"
#include "tools/view/output/picture_sheet.h"
#include "tools/view/recording/recording_run.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

class PictureWriter {
 public:
  virtual ~PictureWriter() = default;
  virtual void write(const cv::Mat& picture, double seconds) = 0;
};

class PngWriter final : public PictureWriter {
 public:
  PngWriter(fs::path folder, std::string name)
      : folder_(std::move(folder)), name_(std::move(name)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (error) {
      throw std::runtime_error(folder_.string() +
                               ": the folder cannot be made: " + error.message());
    }
  }

  void write(const cv::Mat& picture, double seconds) override {
    char number[32];
    std::snprintf(number, sizeof number, "-%09.4fs.png", seconds);
    const fs::path path = folder_ / (name_ + number);
    // Light compression: the files are larger by a tenth, and written much faster.
    if (!cv::imwrite(path.string(), picture, {cv::IMWRITE_PNG_COMPRESSION, 2})) {
      throw std::runtime_error(path.string() + ": cannot be written");
    }
  }

 private:
  fs::path folder_;
  std::string name_;
};

class Mp4Writer final : public PictureWriter {
 public:
  Mp4Writer(const fs::path& path, cv::Size size) : path_(path) {
    if (path.extension() != ".mp4") {
      throw std::runtime_error(path.string() +
                               ": a video is an MP4: give a name that ends in .mp4");
    }
    // H.264, which browsers play; where FFmpeg was built without it, MPEG-4.
    for (const char* codec : {"avc1", "mp4v"}) {
      const int code = cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]);
      if (video_.open(path.string(), cv::CAP_FFMPEG, code, PictureFiles::kVideo_fps, size)) return;
    }
    throw std::runtime_error(path.string() +
                             ": cannot be written: is there such a folder, and may it be written?");
  }

  void write(const cv::Mat& picture, double /*seconds*/) override { video_.write(picture); }

 private:
  fs::path path_;
  cv::VideoWriter video_;
};

std::unique_ptr<PictureWriter> make_writer(const OpenedRecording& recording,
                                           const PictureFiles& files, cv::Size size) {
  if (!files.video.empty()) return std::make_unique<Mp4Writer>(files.video, size);
  return std::make_unique<PngWriter>(files.png_folder, recording.path().stem().string());
}

bool needs_surface(const PictureWishes& wishes) {
  return wishes.view == PictureWishes::View::kCamera &&
         wishes.backdrop != PictureWishes::Backdrop::kEvents;
}

// False when the recording ends before.
bool advance(RecordingRun& run, Timestamp until) {
  auto progress =
      run.now() < until ? RecordingRun::Progress::kAdvanced : RecordingRun::Progress::kReached;
  while (progress == RecordingRun::Progress::kAdvanced) progress = run.step(until);
  return progress == RecordingRun::Progress::kReached;
}

}  // namespace

int write_pictures(const OpenedRecording& recording,
                   const std::array<std::string, kViewSides>& trackers, const PictureFiles& files) {
  if (!recording.has_events() && !recording.is_log()) {
    throw std::invalid_argument("there is no picture without events");
  }
  RecordingRun run(recording);
  for (int side = 0; side < kViewSides; ++side) {
    run.choose(side, trackers[static_cast<std::size_t>(side)]);
  }
  for (const PictureWishes& wishes : files.pictures) {
    if (needs_surface(wishes)) run.keep_surface(wishes.side);
  }
  run.start(recording.first());
  std::optional<HeatMap> heat_map;
  if (recording.size_model() != nullptr) heat_map.emplace(*recording.size_model());
  PictureSheet sheet(files.pictures, {files.width_px, files.height_px});
  const auto writer = make_writer(recording, files, sheet.size());
  ProgressBar bar("pictures");
  ViewScene scene;
  int written = 0;
  Timestamp at = recording.first() + files.from_us;
  while (!files.length_us || at - recording.first() <= files.from_us + *files.length_us) {
    if (!advance(run, at)) break;
    for (std::size_t i = 0; i < sheet.pictures().size(); ++i) {
      const PictureWishes& wishes = sheet.pictures()[i];
      run.fill(wishes, scene);
      const bool has_heat = wishes.backdrop == PictureWishes::Backdrop::kHeatMap &&
                            wishes.view == PictureWishes::View::kCamera &&
                            scene.no_backdrop.empty();
      if (has_heat) heat_map->fill(scene.surface, scene.heat);
      sheet.draw(i, scene);
    }
    writer->write(sheet.sheet(), scene.seconds);
    ++written;
    const double done_us = static_cast<double>(at - recording.first() - files.from_us);
    bar.show(written, files.length_us
                          ? std::optional(done_us / static_cast<double>(*files.length_us))
                          : run.share_read());
    at = at + files.every_us;
  }
  if (written == 0) {
    char text[100];
    std::snprintf(text, sizeof text,
                  "the recording ends at %.3f s: there is no picture from --start on",
                  static_cast<double>(run.now() - run.first()) * 1e-6);
    throw std::invalid_argument(text);
  }
  return written;
}

}  // namespace puck
