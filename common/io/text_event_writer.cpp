#include "common/io/text_event_writer.h"

#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "common/io/event_checks.h"

namespace puck {

TextEventWriter::TextEventWriter(const std::filesystem::path& path, SensorSize sensor, Form form)
    : FileEventWriter(path, sensor), separator_(form == Form::kCommas ? ',' : ' ') {
  file_.append("%geometry:" + std::to_string(sensor.width) + "," + std::to_string(sensor.height) +
               (form == Form::kCommas ? "\nt,x,y,p\n" : "\n# t_us x y p\n"));
}

void TextEventWriter::write(const EventPacket& packet) {
  for (const Event& event : packet.events) {
    const Timestamp time = packet.time_of(event);
    check_event(event, time, sensor_, newest_);
    newest_ = time;

    std::array<char, 64> line{};
    char* end = std::to_chars(line.data(), line.data() + 24, time.us).ptr;
    const auto append_column = [&](int value) {
      *end++ = separator_;
      end = std::to_chars(end, end + 8, value).ptr;
    };
    append_column(event.x);
    append_column(event.y);
    append_column(event.polarity);
    *end++ = '\n';
    file_.append(std::string_view(line.data(), static_cast<std::size_t>(end - line.data())));
  }
}

}  // namespace puck
