#include <string>
#include <variant>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tools/view/server/control_json.h"
#include "tools/view/server/listen_address.h"
#include "tools/view/server/picture_query.h"
#include "tools/view/server/state_json.h"
#include "tools/view/server/url_query.h"

namespace puck {
namespace {

std::string problem_of(const std::string& text) {
  const auto parsed = parse_control(text);
  const auto* problem = std::get_if<std::string>(&parsed);
  return problem == nullptr ? "" : *problem;
}

HttpRequest with_target(const std::string& target) {
  const UrlTarget url = split_target(target);
  return {.path = url.path, .query = url.query};
}

}  // namespace

TEST_CASE("a target is split and decoded, whatever it holds") {
  const UrlTarget url = split_target("/picture?a=1&b=x%20y+z&c&=d&a=2&bad=%4&worse=%zz");
  CHECK(url.path == "/picture");
  CHECK(url.query.at("a") == "2");
  CHECK(url.query.at("b") == "x y z");
  CHECK(url.query.at("c").empty());
  CHECK(url.query.at("bad") == "%4");
  CHECK(url.query.at("worse") == "%zz");
  CHECK(url.query.size() == 5);
  CHECK(split_target("").path.empty());
  CHECK(split_target("?").query.empty());
}

TEST_CASE("addresses to listen on are read, and others refused with an example") {
  CHECK(to_string(parse_listen_address("127.0.0.1:8080")) == "127.0.0.1:8080");
  CHECK(to_string(parse_listen_address("8090")) == "127.0.0.1:8090");
  CHECK(to_string(parse_listen_address("localhost:0")) == "127.0.0.1:0");
  CHECK(to_string(parse_listen_address("[::1]:80")) == "[::1]:80");
  CHECK(parse_listen_address("[::1]:80").is_loopback());
  CHECK(parse_listen_address("127.9.9.9:80").is_loopback());
  CHECK_FALSE(parse_listen_address("0.0.0.0:80").is_loopback());
  CHECK_FALSE(parse_listen_address("[::]:80").is_loopback());
  for (const std::string text : {"", ":", "host", "1.2.3:80", "::1:80", "127.0.0.1:", "127.0.0.1:x",
                                 "127.0.0.1:65536", "127.0.0.1:-1", "127.0.0.1:80 "}) {
    CAPTURE(text);
    CHECK_THROWS_WITH(parse_listen_address(text), doctest::Contains("expected ADDRESS:PORT"));
  }
}

TEST_CASE("wishes keep their defaults for what is missing or unreadable, and are clamped") {
  CHECK(wishes_of(with_target("/picture?view=moon&width=wide&side=&window_us=1e3")) ==
        PictureWishes{});
  const PictureWishes wishes = wishes_of(
      with_target("/picture?view=table&backdrop=heat&theme=light&side=7&width=99999999&height=-5&"
                  "window_us=99999999999&hide=truth,nothing,,words"));
  CHECK(wishes.view == PictureWishes::View::kTable);
  CHECK(wishes.backdrop == PictureWishes::Backdrop::kHeatMap);
  CHECK(wishes.theme == PictureWishes::Theme::kLight);
  CHECK(wishes.side == 1);
  CHECK(wishes.width_px == 2560);
  CHECK(wishes.height_px == PictureWishes::kLeastSide_px);
  CHECK(wishes.window_us == PictureWishes::kLongestWindow_us);
  CHECK_FALSE(wishes.layers.truth);
  CHECK_FALSE(wishes.layers.words);
  CHECK(wishes.layers.trail);
}

TEST_CASE("a control is read, and any other text refused in words") {
  const auto parsed = parse_control(R"({"action": "seek", "value": 1.5, "side": 1, "name": "x"})");
  REQUIRE(std::holds_alternative<ViewControl>(parsed));
  const auto& control = std::get<ViewControl>(parsed);
  CHECK(control.action == ViewControl::Action::kSeek);
  CHECK(control.value == 1.5);
  CHECK(control.side == 1);
  CHECK(control.name == "x");
  CHECK(problem_of("") == problem_of("[]"));
  CHECK(problem_of(R"({"action": 7})").starts_with("expected a JSON object with an action"));
  CHECK(problem_of(R"({"action": "fly"})").starts_with("unknown action; expected one of play, "));
  CHECK(problem_of(R"({"action": "seek", "value": "1"})") == "value must be a number");
  CHECK(problem_of(R"({"action": "seek", "value": 1e999})") != "");
  CHECK(problem_of(R"({"action": "play", "side": 2})") == "side must be 0 or 1");
  CHECK(problem_of(R"({"action": "play", "name": ")" + std::string(65, 'a') + "\"}") ==
        "name must be a text of up to 64 bytes");
  CHECK(problem_of(std::string(4096, '[')) != "");
}

TEST_CASE("the state is JSON whatever its texts and numbers are") {
  ViewState state;
  state.source = "caf\xe9";
  state.errors_px[0] = std::numeric_limits<double>::quiet_NaN();
  state.messages.push_back({ViewMessage::Level::kError, "\xff\xfe"});
  state.samples.emplace_back().tracks[0].position = Pixel{1.23456, 2};
  const auto json = nlohmann::json::parse(state_json(state));
  CHECK(json["errors_px"][0].is_null());
  CHECK(json["messages"][0]["level"] == "error");
  CHECK(json["samples"]["x"][0][0] == 1.2);
  CHECK(json["samples"]["x"][1][0].is_null());
  CHECK(json["playback"].is_null());
}

}  // namespace puck
