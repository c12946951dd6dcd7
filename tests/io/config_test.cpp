#include "common/io/config.h"

#include <limits>

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

const std::string kText = R"(# A comment
[tracker]
half_width_px = 5
decay = 1
preset = "paper"
fast = true
big = 5000000000

[tracker.region]
box = [1, 2.5, 3, 4]
)";

Config config() { return Config::from_text(kText, "config/tracker.toml"); }

template <typename Action>
std::string refusal(Action action) {
  return message_of<ConfigError>(action);
}

TEST_CASE("settings replace defaults, and unset keys keep their defaults") {
  Config settings = config();
  int half_width_px = 3;
  double decay = 0.5;
  double other = 0.25;
  std::string preset = "default";
  bool fast = false;
  std::int64_t big = 0;
  std::array<double, 4> box{};
  std::vector<double> list{7};
  settings.read("tracker.half_width_px", half_width_px, 1, 8);
  settings.read("tracker.decay", decay, 0, 1);
  settings.read("tracker.other", other, 0, 1);
  settings.read("tracker.preset", preset);
  settings.read("tracker.fast", fast);
  settings.read("tracker.big", big, 0, std::numeric_limits<std::int64_t>::max());
  settings.read("tracker.region.box", box, -10, 10);
  settings.read("tracker.list", list, 0, 10);
  CHECK(half_width_px == 5);
  CHECK(decay == 1);
  CHECK(other == 0.25);
  CHECK(preset == "paper");
  CHECK(fast);
  CHECK(big == 5000000000);
  CHECK(box == std::array<double, 4>{1, 2.5, 3, 4});
  CHECK(list == std::vector<double>{7});
  CHECK_NOTHROW(settings.reject_unknown());
  CHECK(settings.effective() ==
        "tracker.half_width_px = 5\ntracker.decay = 1.0\ntracker.other = 0.25\n"
        "tracker.preset = \"paper\"\ntracker.fast = true\ntracker.big = 5000000000\n"
        "tracker.region.box = [1.0, 2.5, 3.0, 4.0]\ntracker.list = [7.0]\n");
  CHECK_NOTHROW(Config::from_text(settings.effective(), "again"));
}

TEST_CASE("a wrong type is refused with file, line, key and what was expected") {
  Config settings = config();
  int number = 0;
  double real = 0;
  bool flag = false;
  std::string text;
  std::array<double, 3> three{};
  CHECK(refusal([&] { settings.read("tracker.preset", number, 1, 8); }) ==
        "config/tracker.toml:5: tracker.preset must be an integer from 1 to 8, got \"paper\"");
  CHECK(refusal([&] { settings.read("tracker.fast", real, 0, 1); }) ==
        "config/tracker.toml:6: tracker.fast must be a number from 0 to 1, got true");
  CHECK(refusal([&] { settings.read("tracker.half_width_px", flag); }) ==
        "config/tracker.toml:3: tracker.half_width_px must be true or false, got 5");
  CHECK(
      contains(refusal([&] { settings.read("tracker.decay", text); }), "must be a text in quotes"));
  CHECK(refusal([&] { settings.read("tracker.region.box", three, 0, 9); }) ==
        "config/tracker.toml:10: tracker.region.box must be a list of 3 numbers from 0 to 9, got "
        "[ 1, 2.5, 3, 4 ]");
}

TEST_CASE("a value out of its range is refused") {
  Config settings =
      Config::from_text("a = 9\nb = 1.5\nc = nan\nd = 5000000000\ne = [0, 11]\n", "f");
  int number = 0;
  double real = 0;
  std::vector<double> list;
  CHECK(refusal([&] { settings.read("a", number, 1, 8); }) ==
        "f:1: a must be an integer from 1 to 8, got 9");
  CHECK(refusal([&] { settings.read("a", number, 10, std::numeric_limits<int>::max()); }) ==
        "f:1: a must be an integer of at least 10, got 9");
  CHECK(refusal([&] { settings.read("b", real, 0, 1); }) ==
        "f:2: b must be a number from 0 to 1, got 1.5");
  CHECK(refusal([&] { settings.read("c", real, 0, 1); }) ==
        "f:3: c must be a number from 0 to 1, got nan");
  CHECK(contains(refusal([&] { settings.read("d", number, 0, 9); }), "got 5000000000"));
  CHECK(contains(refusal([&] { settings.read("e", list, 0, 10); }),
                 "f:5: e must be a list of numbers from 0 to 10"));
  CHECK_NOTHROW(settings.read("a", number, 9, 9));
}

TEST_CASE("a choice must be one of its words") {
  const std::array<std::string_view, 3> choices{"paper", "reference", "default"};
  std::string preset = "default";
  config().read_choice("tracker.preset", preset, choices);
  CHECK(preset == "paper");
  Config wrong = Config::from_text("preset = \"papers\"", "f");
  CHECK(refusal([&] { wrong.read_choice("preset", preset, choices); }) ==
        "f:1: preset must be \"paper\", \"reference\" or \"default\", got \"papers\"");
}

TEST_CASE("an unknown key is refused with the nearest known one") {
  Config settings = Config::from_text("[tracker]\nhalf_widht_px = 5\n", "config/tracker.toml");
  int half_width_px = 3;
  double decay = 0;
  settings.read("tracker.half_width_px", half_width_px, 1, 8);
  settings.read("tracker.decay", decay, 0, 1);
  CHECK(refusal([&] { settings.reject_unknown(); }) ==
        "config/tracker.toml:2: unknown key tracker.half_widht_px; the nearest known key is "
        "tracker.half_width_px");
}

TEST_CASE("an unknown table is refused, even without keys; a known one may be empty") {
  Config settings = Config::from_text("[tracker]\n[trakcer]\n", "f");
  int half_width_px = 3;
  settings.read("tracker.half_width_px", half_width_px, 1, 8);
  CHECK(contains(refusal([&] { settings.reject_unknown(); }), "f:2: unknown key trakcer"));
  CHECK(contains(refusal([] { Config::from_text("[[a]]\nb = 1\n", "f").reject_unknown(); }),
                 "unknown key a"));
}

TEST_CASE("a program that reads one table refuses unknown keys in that table only") {
  Config settings = Config::from_text("[lcm]\nurl = 'x'\n[tracker]\nhalf_width_px = 5\n", "f");
  std::string url;
  settings.read("lcm.url", url);
  CHECK_NOTHROW(settings.reject_unknown_in("lcm"));
  CHECK_THROWS_AS(settings.reject_unknown(), ConfigError);
  settings.override_with("lcm.ulr=y");
  CHECK(refusal([&] { settings.reject_unknown_in("lcm"); }) ==
        "--set lcm.ulr=y: unknown key lcm.ulr; the nearest known key is lcm.url");
}

TEST_CASE("assignments override the file, and the last one wins") {
  Config settings = config();
  int half_width_px = 3;
  std::string preset;
  std::string path;
  std::vector<double> list;
  settings.override_with("tracker.half_width_px=6");
  settings.override_with("tracker.half_width_px=7");
  settings.override_with("tracker.preset=default");
  settings.override_with("tracker.path=/tmp/a b=c.raw");
  settings.override_with("tracker.list=[1, 2]");
  settings.read("tracker.half_width_px", half_width_px, 1, 8);
  settings.read("tracker.preset", preset);
  settings.read("tracker.path", path);
  settings.read("tracker.list", list, 0, 9);
  CHECK(half_width_px == 7);
  CHECK(preset == "default");
  CHECK(path == "/tmp/a b=c.raw");
  CHECK(list == std::vector<double>{1, 2});
}

TEST_CASE("a bad assignment is refused and quoted") {
  Config settings = config();
  int number = 3;
  for (const char* assignment : {"", "a", "=5", "a=", ".a=5", "a.=5", "a..b=5", "a b=5"}) {
    CAPTURE(assignment);
    CHECK(refusal([&] { settings.override_with(assignment); }) ==
          "--set " + std::string(assignment) +
              ": expected KEY=VALUE, as in tracker.half_width_px=5");
  }
  CHECK(refusal([&] { settings.override_with("a\n=5"); }) ==
        "--set a?=5: expected KEY=VALUE, as in tracker.half_width_px=5");
  settings.override_with("tracker.half_width_px=x");
  CHECK(refusal([&] { settings.read("tracker.half_width_px", number, 1, 8); }) ==
        "--set tracker.half_width_px=x: tracker.half_width_px must be an integer from 1 to 8, got "
        "\"x\"");
  settings.override_with("tracker.haste=1");
  Config only = Config();
  only.override_with("tracker.haste=1");
  CHECK(contains(refusal([&] { only.reject_unknown(); }),
                 "--set tracker.haste=1: unknown key tracker.haste"));
}

TEST_CASE("the effective settings are valid TOML for any text") {
  Config settings;
  std::string text = "a \"quoted\" \\ text\n\x01 of µs";
  const std::string same = text;
  settings.read("text", text);
  Config again = Config::from_text(settings.effective(), "f");
  text.clear();
  again.read("text", text);
  CHECK(text == same);
}

TEST_CASE("a line end in a value cannot add a key") {
  Config settings;
  settings.override_with("a=5\nb=6");
  CHECK(settings.has("a"));
  CHECK_FALSE(settings.has("b"));
}

TEST_CASE("a missing file, a folder and a file that is not TOML are refused") {
  const TemporaryFolder folder;
  CHECK(contains(refusal([&] { Config::from_file(folder / "none.toml"); }),
                 "none.toml: cannot be opened: No such file"));
  CHECK(contains(refusal([&] { Config::from_file(folder / ""); }), "is a folder"));
  const auto path = folder.write("bad.toml", "[a]\nb = = 5\n");
  CHECK(contains(refusal([&] { Config::from_file(path); }), "bad.toml:2: is not valid TOML"));
  CHECK(contains(refusal([] { Config::from_text("a = 1\na = 2\n", "f"); }),
                 "f:2: is not valid TOML"));
}

TEST_CASE("a line long enough for endless nesting of keys is refused") {
  std::string key = "a";
  for (int i = 0; i < 100000; ++i) key += ".a";
  CHECK(contains(refusal([&] { Config::from_text("b = 1\n" + key + " = 1\n", "f"); }),
                 "f:2: is longer than 4096 bytes"));
  CHECK(contains(refusal([&] { Config::from_text("[" + key + "]\n", "f"); }), "f:1: is longer"));
  Config settings;
  settings.override_with("text={" + key + "=1}");
  std::string text;
  settings.read("text", text);
  CHECK(text == "{" + key + "=1}");
}

}  // namespace
}  // namespace puck
