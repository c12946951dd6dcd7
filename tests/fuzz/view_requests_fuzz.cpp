// Requests to puck-view's page: the bytes that a browser, or anybody else, sends. Several may
// follow one another, each after a zero.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/messaging/event_packing.h"
#include "tests/fuzz/require.h"
#include "tools/view/live/live_view.h"
#include "tools/view/server/view_pages.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{64, 48};

/// A picture with some events and an estimate.
class StillSource : public ViewSource {
 public:
  StillSource() {
    EventPacker packer({.sensor = kSensor});
    const std::vector<Event> events(100, Event{.x = 3, .y = 4, .polarity = 1});
    packer.pack({1000}, events, [&](event_packet_t& packet) { view_.take(view_of(packet), 1); });
    puck_estimate_t estimate{};
    estimate.image_width = kSensor.width;
    estimate.image_height = kSensor.height;
    estimate.flags = puck_estimate_t::FLAG_POSITION;
    estimate.x_px = 20;
    estimate.y_px = 20;
    estimate.width_px = 8;
    estimate.height_px = 5;
    view_.take(estimate, 1);
  }

  bool fill(const PictureWishes& wishes, ViewScene& scene) override {
    if (!view_.fill(wishes, 1, scene)) return false;
    if (wishes.backdrop == PictureWishes::Backdrop::kHeatMap) scene.no_backdrop = "no size model";
    return true;
  }
  ViewState state(Timestamp since, std::int64_t run) override {
    ViewState state;
    view_.add_to(state, since, run, 1);
    return state;
  }
  ViewTimeline timeline() override { return {}; }
  std::string control(const ViewControl& control) override { return control.name; }
  std::uint64_t version() const override { return 1; }
  void wait_for_change(std::uint64_t, std::chrono::milliseconds) override {}

 private:
  LiveView view_;
};

PageFiles page() {
  const auto folder = std::filesystem::temp_directory_path() / "puck_view_fuzz";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "index.html") << "<!doctype html>";
  return PageFiles(folder);
}

/// Served with a token, and without one.
struct Pages {
  StillSource source;
  ViewPages open{source, page(), RequestGate("", 8080)};
  ViewPages closed{source, page(), RequestGate(std::string(32, 'a'), 8080)};
};

void answer(std::string_view bytes, Pages& pages) {
  const auto request = parse_request(bytes);
  if (!request) return;
  const auto reply = pages.open.answer(*request, std::chrono::milliseconds(1000));
  require(reply.has_value(), "a request is answered within a second");
  require(reply->status >= 200 && reply->status < 600, "the status is one of HTTP's");
  const auto guarded = pages.closed.answer(*request, std::chrono::milliseconds(1000));
  const bool may_know = bytes.find(std::string(32, 'a')) != std::string_view::npos ||
                        bytes.find('%') != std::string_view::npos;
  require(may_know || guarded->status == 403 || guarded->status == 400,
          "without the token nothing is answered");
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static puck::Pages pages;  // Once: it reads files.
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find('\0'));
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
    puck::answer(one, pages);
  }
  return 0;
}
