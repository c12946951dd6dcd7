// Data of a control board, a camera's port and a name server: lines of text, messages and their
// content. The division of the bytes must make no difference.
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <fuzzer/FuzzedDataProvider.h>

#include "common/io/yarp_stream.h"
#include "common/yarp/binary_carrier.h"
#include "common/yarp/board_answer.h"
#include "common/yarp/name_server.h"
#include "common/yarp/port_message.h"
#include "common/yarp/state_message.h"
#include "common/yarp/text_lines.h"
#include "common/yarp/yarp_error.h"
#include "tests/fuzz/require.h"

namespace puck {
namespace {

void may_refuse(const std::function<void()>& work) {
  try {
    work();
  } catch (const YarpError& error) {
    require_one_line(error.what());
  }
}

struct Outcome {
  std::vector<std::string> parts;
  bool is_refused = false;

  bool operator==(const Outcome&) const = default;
};

template <typename Reader>
Outcome cut(const Bytes& bytes, const std::vector<std::uint8_t>& pieces) {
  Outcome outcome;
  Reader reader;
  std::size_t piece = 0;
  may_refuse([&] {
    // Until it comes to its end, it is refused.
    outcome.is_refused = true;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t most = pieces.empty() ? bytes.size() : 1U + pieces[piece++ % pieces.size()];
      const std::size_t size = std::min(most, bytes.size() - at);
      reader.feed(std::span(bytes).subspan(at, size));
      at += size;
      while (const auto part = reader.next())
        outcome.parts.emplace_back(part->begin(), part->end());
    }
    outcome.is_refused = false;
  });
  return outcome;
}

template <typename Reader>
Outcome cut_both_ways(const Bytes& bytes, const std::vector<std::uint8_t>& pieces) {
  const Outcome whole = cut<Reader>(bytes, {});
  require(cut<Reader>(bytes, pieces) == whole, "where the bytes are cut makes no difference");
  return whole;
}

void read_state(const std::string& message) {
  may_refuse([&] {
    const StateMessage state = parse_state_message(
        {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()});
    require(!state.encoders_deg.empty() && state.encoders_deg.size() <= kMostBoardJoints,
            "a board has joints, and not too many");
    for (const double deg : state.encoders_deg) require(std::isfinite(deg), "encoders are finite");
    require(std::isfinite(state.stamp.time_s), "a stamp is finite");
  });
}

// Events of a camera's port.
class CameraMessages {
 public:
  CameraMessages() : stream_("/eye", {.sensor = kSensor}) {}

  void add(const std::string& text) {
    may_refuse([&] {
      const PortMessage message =
          parse_port_message({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
      add_bottle(message.content, message.stamp ? message.stamp->time_s : 1);
    });
  }
  void add_bottle(std::span<const std::uint8_t> bottle, double sent_s) {
    stream_.add(bottle, sent_s);
    take();
  }
  void finish() {
    stream_.finish();
    take();
    require(events_ == stream_.counters().events, "every event is counted once");
  }

 private:
  static constexpr SensorSize kSensor{304, 240};

  void take() {
    EventPacket packet;
    while (stream_.take(packet, 64)) {
      require(!packet.empty() && packet.events.size() <= 64, "a packet holds events");
      for (const Event& event : packet.events) {
        require(kSensor.contains(event.x, event.y), "events are in the sensor");
        require(packet.time_of(event) >= newest_, "times do not go back");
        newest_ = packet.time_of(event);
        ++events_;
      }
    }
  }

  YarpStream stream_;
  // A record a little before the first one has a time below 0.
  Timestamp newest_{std::numeric_limits<std::int64_t>::min()};
  std::int64_t events_ = 0;
};

void read_line(const std::string& line) {
  may_refuse([&] {
    const PortAddress address = parse_registration(line, "/icub/right_arm/rpc:i");
    require(address.port > 0, "an address has a port");
  });
  may_refuse([&] {
    const BoardAnswer answer("get it", line);
    may_refuse([&] { require(answer.count("axes", 64) <= 64, "a count is bounded"); });
    may_refuse([&] { require(!answer.name("name").empty(), "a name has letters"); });
    may_refuse([&] { require(answer.vocabs("cmds", 2).size() == 2, "so many modes"); });
    may_refuse([&] {
      for (const double deg : answer.numbers("llim", 2)) require(std::isfinite(deg), "finite");
    });
  });
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider input(data, size);
  const bool is_text = input.ConsumeBool();
  const auto pieces = input.ConsumeBytes<std::uint8_t>(input.ConsumeIntegralInRange(0, 8));
  const auto bytes = input.ConsumeRemainingBytes<std::uint8_t>();
  if (is_text) {
    for (const auto& line : puck::cut_both_ways<puck::TextLines>(bytes, pieces).parts) {
      puck::read_line(line);
    }
    return 0;
  }
  puck::read_state({bytes.begin(), bytes.end()});
  puck::CameraMessages camera;
  camera.add_bottle(bytes, 0);
  for (const auto& message : puck::cut_both_ways<puck::MessageReader>(bytes, pieces).parts) {
    puck::read_state(message);
    camera.add(message);
  }
  camera.finish();
  return 0;
}
