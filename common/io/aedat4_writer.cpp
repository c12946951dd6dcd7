#include "common/io/aedat4_writer.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <span>
#include <string>
#include <string_view>

#include "common/io/aedat4_header.h"
#include "common/io/event_checks.h"
#include "common/io/word_assembler.h"

namespace puck {
namespace {

constexpr std::size_t kPacketEvents = 16384;
constexpr std::size_t kPacketRecordBytes = 16;
constexpr std::size_t kPacketHeadBytes = 32;  // Size, root table and the list's length.

void put_text(std::vector<std::byte>& bytes, std::string_view text) {
  for (const char character : text) bytes.push_back(static_cast<std::byte>(character));
}

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string description_of(SensorSize sensor) {
  const auto attribute = [](const char* key, const char* type, const std::string& value) {
    return std::string("<attr key=\"") + key + "\" type=\"" + type + "\">" + value + "</attr>";
  };
  return "<dv version=\"2.0\"><node name=\"outInfo\" path=\"/mainloop/Recorder/outInfo/\">"
         "<node name=\"0\" path=\"/mainloop/Recorder/outInfo/0/\">" +
         attribute("compression", "string", "LZ4") +
         attribute("originalModuleName", "string", "puck") +
         attribute("originalOutputName", "string", "events") +
         attribute("typeDescription", "string", "Array of events (polarity ON/OFF).") +
         attribute("typeIdentifier", "string", "EVTS") +
         "<node name=\"info\" path=\"/mainloop/Recorder/outInfo/0/info/\">" +
         attribute("sizeX", "int", std::to_string(sensor.width)) +
         attribute("sizeY", "int", std::to_string(sensor.height)) +
         attribute("source", "string", "puck") + "</node></node></node></dv>";
}

// A FlatBuffer with its size before it: root table, table of three fields, text.
std::vector<std::byte> header_of(SensorSize sensor) {
  const std::string description = description_of(sensor);
  std::vector<std::byte> bytes;
  append_word(bytes, static_cast<std::uint32_t>(48 + description.size() + 1));
  append_word(bytes, std::uint32_t{24});  // The table's offset from here.
  put_text(bytes, std::string_view("IOHE\0\0\0\0\0\0", 10));
  // Where the fields are in the table: its bytes, then compression, index, description.
  for (const int value : {10, 20, 4, 12, 8}) append_word(bytes, static_cast<std::uint16_t>(value));
  append_word(bytes, std::uint32_t{10});  // Back to the list of fields.
  append_word(bytes, static_cast<std::uint32_t>(Aedat4Packing::kLz4));
  append_word(bytes, std::uint32_t{12});  // To the text.
  append_word(bytes, ~std::uint64_t{0});  // No index of packets.
  append_word(bytes, static_cast<std::uint32_t>(description.size()));
  put_text(bytes, description);
  bytes.push_back(std::byte{0});
  return bytes;
}

// The same with one field, a list of events; the events follow.
std::vector<std::byte> packet_head(std::size_t events) {
  std::vector<std::byte> bytes;
  append_word(bytes,
              static_cast<std::uint32_t>(kPacketHeadBytes - 4 + events * kPacketRecordBytes));
  append_word(bytes, std::uint32_t{16});
  put_text(bytes, std::string_view("EVTS\0\0", 6));
  for (const int value : {6, 8, 4}) append_word(bytes, static_cast<std::uint16_t>(value));
  append_word(bytes, std::uint32_t{6});
  append_word(bytes, std::uint32_t{4});
  append_word(bytes, static_cast<std::uint32_t>(events));
  return bytes;
}

}  // namespace

Aedat4Writer::Aedat4Writer(const std::filesystem::path& path, SensorSize sensor)
    : sensor_(checked_sensor(sensor)),
      file_(path),
      content_(kPacketHeadBytes + kPacketRecordBytes * kPacketEvents) {
  file_.append(kAedat4Signature);
  file_.append(text_of(header_of(sensor)));
}

Aedat4Writer::~Aedat4Writer() {
  try {
    close();
  } catch (const std::exception&) {
    // A caller that needs the error calls close() first.
  }
}

void Aedat4Writer::close() {
  if (packet_events_ > 0) write_packet();
  file_.flush();
}

void Aedat4Writer::write(const EventPacket& packet) {
  for (const Event& event : packet.events) {
    const Timestamp time = packet.time_of(event);
    check_event(event, time, sensor_, newest_);
    newest_ = time;
    std::byte* record = content_.data() + kPacketHeadBytes + kPacketRecordBytes * packet_events_;
    store_word(static_cast<std::uint64_t>(time.us), record);
    store_word(std::uint16_t{event.x}, record + 8);
    store_word(static_cast<std::uint16_t>(event.y), record + 10);
    record[12] = static_cast<std::byte>(event.polarity);
    if (++packet_events_ == kPacketEvents) write_packet();
  }
}

void Aedat4Writer::write_packet() {
  const std::vector<std::byte> head = packet_head(packet_events_);
  std::copy(head.begin(), head.end(), content_.begin());
  packed_.clear();
  pack_lz4(std::span(content_).first(head.size() + packet_events_ * kPacketRecordBytes), packed_);
  file_.append_word(std::uint32_t{0});  // The stream.
  file_.append_word(static_cast<std::uint32_t>(packed_.size()));
  file_.append(text_of(packed_));
  packet_events_ = 0;
}

}  // namespace puck
