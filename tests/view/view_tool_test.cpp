#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "tests/support/child_process.h"
#include "tests/support/contains.h"
#include "tests/support/environment.h"
#include "tests/view/disc_recording.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

Finished view(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), program_path("puck-view"));
  return run_program(arguments);
}

TEST_CASE("--png writes a picture every so often, named by its time") {
  const test::DiscRecording disc;
  const TemporaryFolder folder;
  const Finished run =
      view({disc.path(), "--png", folder / "pictures", "--every", "0.2", "--start", "0.2",
            "--seconds", "0.4", "--size", "640x400", "--tracker", "correlation,off"});
  REQUIRE_MESSAGE(run.exit_code == 0, run.errors);
  CHECK(run.output == "3 pictures\n");
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / "pictures")) {
    names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  REQUIRE(names == std::vector<std::string>{"disc-0000.2000s.png", "disc-0000.4000s.png",
                                            "disc-0000.6000s.png"});
  CHECK(cv::imread((folder / "pictures" / names[0]).string()).size() == cv::Size(640, 400));
}

TEST_CASE("--video writes a video that lasts as long as its speed says") {
  const test::DiscRecording disc;
  const TemporaryFolder folder;
  const Finished run = view({disc.path(), "--video", folder / "disc.mp4", "--speed", "0.5",
                             "--seconds", "0.5", "--show", "events,table", "--size", "321x241"});
  REQUIRE_MESSAGE(run.exit_code == 0, run.errors);
  cv::VideoCapture video((folder / "disc.mp4").string());
  REQUIRE(video.isOpened());
  CHECK(video.get(cv::CAP_PROP_FPS) == doctest::Approx(30));
  CHECK(video.get(cv::CAP_PROP_FRAME_COUNT) == doctest::Approx(30));
  CHECK(video.get(cv::CAP_PROP_FRAME_WIDTH) == 320);
}

TEST_CASE("what cannot be shown or written is said in one line") {
  const test::DiscRecording disc;
  const TemporaryFolder folder;
  struct Case {
    std::vector<std::string> arguments;
    int exit_code;
    std::string words;
  };
  const std::string raw = disc.path();
  const std::string there = folder / "there";
  const std::string empty = folder.write("empty.csv", "t,x,y,p\n");
  for (const Case& bad : {
           Case{{folder / "none.raw", "--png", there}, 1, "none.raw"},
           Case{{empty, "--width", "32", "--height", "24", "--png", there}, 1, "holds no events"},
           Case{{raw, "--png", there, "--tracker", "best"}, 1, "there is no tracker called best"},
           Case{{raw, "--png", there, "--size", "10x10"}, 1, "--size: expected WIDTHxHEIGHT"},
           Case{{raw, "--png", there, "--start", "5"}, 1, "the recording ends at 0.900 s"},
           Case{{raw, "--png", raw}, 1, "cannot be made"},
           Case{{raw, "--video", folder / "x.avi"}, 1, ".mp4"},
           Case{{raw, "--video", folder / "none/x.mp4"}, 1, "cannot be written"},
           Case{{"--png", there}, 1, "need a recording"},
           Case{{"-", "--png", there}, 1, "give a file"},
           Case{{raw, "--png", there, "--video", folder / "x.mp4"}, 2, "excludes"},
           Case{{raw, "--png", there, "--size-model", folder / "no.toml"}, 1, "no.toml"},
       }) {
    CAPTURE(bad.words);
    const Finished run = view(bad.arguments);
    CHECK(run.exit_code == bad.exit_code);
    const std::string& said = run.errors;
    CHECK_MESSAGE(contains(said, bad.words), said);
  }
}

}  // namespace
}  // namespace puck
