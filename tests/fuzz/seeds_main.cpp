// puck-fuzz-seeds SOURCE_DIR OUTPUT_DIR: writes valid inputs of every kind, a folder a fuzzer, for
// the fuzzers to begin with.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "common/io/ecf_codec.h"
#include "common/io/event_writer.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/log_file.h"
#include "common/messaging/message_codec.h"
#include "tests/support/random_message.h"
#include "tests/support/test_board_bytes.h"
#include "tests/support/yarp_bottle_encoder.h"
#include "tests/support/yarp_log_encoder.h"

namespace puck {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class Seeds {
 public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder)) {}

  /// A new file for the fuzzer.
  fs::path next(const std::string& fuzzer) {
    fs::create_directories(folder_ / fuzzer);
    return folder_ / fuzzer / ("seed_" + std::to_string(count_++));
  }
  void add(const std::string& fuzzer, const std::string& bytes) {
    std::ofstream(next(fuzzer), std::ios::binary) << bytes;
  }
  /// Content after a byte that selects its kind.
  void add(const std::string& fuzzer, std::size_t choice, const std::string& bytes) {
    add(fuzzer, std::string(1, static_cast<char>(choice)) + bytes);
  }

 private:
  fs::path folder_;
  int count_ = 0;
};

void add_messages(Seeds& seeds) {
  std::mt19937_64 random(1);
  for (std::size_t i = 0; i < kAllChannels.size(); ++i) {
    for (int round = 0; round < 3; ++round) {
      const auto bytes = random_message(kAllChannels[i], random).bytes;
      seeds.add("fuzz_messages", i, {bytes.begin(), bytes.end()});
    }
  }
  seeds.add("fuzz_loss_accounting", std::string(200, '\1'));
  seeds.add("fuzz_fragments", std::string(200, '\2'));
  seeds.add("fuzz_play", std::string(400, '\x44'));
}

// A log of a restarted camera, with packets out of order.
void add_event_log(Seeds& seeds) {
  LogWriter writer(seeds.next("fuzz_log_reader"), true);
  std::vector<std::uint8_t> bytes;
  for (const std::int64_t session : {1, 2}) {
    EventPacker packer({.sensor = {640, 480}, .packet_bytes = 0x100});
    for (const std::int64_t seq : {0, 2, 1, 3}) {
      const std::vector<Event> events(3, Event{.x = 3, .y = 4, .polarity = 1});
      packer.pack({1000 * seq}, events, [&](event_packet_t& packet) {
        packet.session = session;
        packet.seq = seq;
        encode(packet, bytes);
        writer.write(channel_name(Channel::kEvents, ""), 1'000'000 * session + 1000 * seq, bytes);
      });
    }
  }
}

void add_logs(Seeds& seeds) {
  const fs::path path = seeds.next("fuzz_log_reader");
  {
    LogWriter writer(path, true);
    std::mt19937_64 random(2);
    for (const Channel channel : {Channel::kHead, Channel::kGame, Channel::kArmCommand}) {
      writer.write(channel_name(channel, ""), 1'000'000, random_message(channel, random).bytes);
    }
  }
  const std::string log = text_of(path);
  seeds.add("fuzz_log_reader", log.substr(0, log.size() - 5));
  seeds.add("fuzz_log_reader", log + "rubbish" + log);
  add_event_log(seeds);
}

void add_datagrams(Seeds& seeds) {
  using namespace std::string_literals;
  seeds.add("fuzz_datagram", "LC02\0\0\0\1PUCK_EVENTS\0payload"s);
  // The first of two parts of 11 bytes, and the second.
  seeds.add("fuzz_datagram", "LC03\0\0\0\1\0\0\0\13\0\0\0\0\0\0\0\2PUCK_GAME\0first "s);
  seeds.add("fuzz_datagram", "LC03\0\0\0\1\0\0\0\13\0\0\0\6\0\1\0\2parts"s);
}

void add_urls(Seeds& seeds) {
  for (const char* url : {"udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304", "memq://",
                          "udpm://:7667?ttl=1", "LEFT", "LEFT_PUCK_EVENTS", "PUCK_STATUS"}) {
    seeds.add("fuzz_lcm_url", url);
  }
}

void add_settings(Seeds& seeds, const fs::path& source) {
  std::size_t choice = 0;
  for (const char* service : {"arm", "bridge", "camera", "logger", "tracker"}) {
    const std::string text = text_of(source / "config" / (std::string(service) + ".toml"));
    // Without the section of the bus, which is read elsewhere.
    const std::string own = text.substr(text.find("\n[", text.find("[lcm]")) + 1);
    seeds.add("fuzz_config", choice, own);
    seeds.add("fuzz_config", choice++, own + '\0' + service + ".a_key=5");
  }
}

void add_boards(Seeds& seeds) {
  // The choice and the number of cuts are taken from the end.
  const auto add = [&](const std::string& bytes, bool is_text) {
    seeds.add("fuzz_yarp", bytes + '\0' + (is_text ? '\1' : '\0'));
  };
  const std::string end = " [tsta] 0 1795247365.76 [ok]\r\n";
  for (const char* line : {"axes 7", "name joint0", "name \"r shoulder\"", "llim 0.0 100.0",
                           "encs (0.0 1e-3 )", "[cmds] ([pos] [posd])"}) {
    add("[is] " + std::string(line) + end, true);
  }
  add("[fail]\r\n[nak]\r\n", true);
  add("registration name /icub/right_arm/rpc:i ip 192.0.2.2 port 10002 type tcp\r\n"
      "*** end of message\r\n",
      true);
  add(state_message(12, 1795247365.76, {1, -2.5, 3}), false);
  add(state_message_without_stamp({1}), false);
  for (const char* line :
       {"7 1569859363.5 AE (100 4097 112 8195)", "8 1569859364.5 AE 1000 \"abcdefgh\""}) {
    const WireBottle bottle = wire_bottle::of_log_line(line);
    add(bottle.bytes, false);
    add(carrier_message({stamp_block(bottle.count, bottle.time_s), bottle.bytes}), false);
  }
}

// A file or stream of events.
void add_event_bytes(Seeds& seeds, const std::string& bytes) {
  seeds.add("fuzz_event_files", 0, bytes);
  seeds.add("fuzz_event_stream", bytes + std::string(4, '\0'));
}

// Of each kind that is a stream.
void add_event_streams(Seeds& seeds, const fs::path& source) {
  for (const auto& entry : fs::directory_iterator(source / "tests" / "io" / "data")) {
    add_event_bytes(seeds, text_of(entry.path()).substr(0, 800));
  }
  // A time word, and a vector of two events.
  const std::string time("\0\0\0\0\1\0\0\x80", 8);
  const std::string vector("\3\0\0\0\5\0\1\x10", 8);
  add_event_bytes(seeds, "% format EVT21;height=480;width=640;endianness=little\n% end\n" + time +
                             vector + time);
  add_event_bytes(seeds, "% format EVT21;height=480;width=640;endianness=legacy\n% end\n" +
                             time.substr(4) + time.substr(0, 4) + vector.substr(4) +
                             vector.substr(0, 4));
  add_event_bytes(seeds, "% evt 4.0\n% geometry 640x480\n% end\n" +
                             std::string("\1\0\0\xe0\5\x28\x40\xb0\5\x28\x40\xd0\7\0\0\0", 16));
  for (const char* chip : {"DVS128", "DAVIS240C", "DAVIS346"}) {
    add_event_bytes(seeds, std::string("#!AER-DAT2.0\r\n# AEChip: ") + chip + "\r\n" +
                               std::string("\0\0\x20\5\0\0\1\0\0\0\x28\0\0\0\1\5", 16));
  }
  const std::string atis =
      std::string("Event Stream\2\0\0\2\x40\1\xf0\0\x16\1\0\2\0\xff\x15\1\0\2\0", 31);
  add_event_bytes(seeds, atis);
  add_event_bytes(seeds, atis + atis);
  add_event_bytes(seeds, "timestamp;x;y;polarity\n1.5e3;2.0;3;-1\n1600;4;5;true\n");
}

void add_recordings(Seeds& seeds) {
  EventPacket packet;
  std::mt19937_64 random(3);
  for (std::uint32_t i = 0; i < 40; ++i) {
    Event event;
    event.x = static_cast<std::uint16_t>(random() % 640);
    event.y = static_cast<std::uint16_t>(random() % 480) & 0x7fff;
    event.polarity = random() & 1;
    event.offset_us = i * 300;
    packet.events.push_back(event);
  }
  const fs::path scratch = seeds.next("fuzz_event_files");
  for (const char* format : {"evt3", "text"}) {
    const auto writer = make_event_writer(scratch, format, {640, 480});
    writer->write(packet);
    writer->close();
    const std::string bytes = text_of(scratch);
    seeds.add("fuzz_event_files", 0, bytes);
    seeds.add("fuzz_event_stream", bytes + std::string(4, '\0'));
  }
  fs::remove(scratch);
  // Time high, two events, the second after a word of another type.
  const std::string evt2("\x01\x00\x00\x80\x05\x28\x40\x10\x00\x00\x00\xa0\x06\x28\x80\x00", 16);
  const std::string header = "% evt 2.0\n% format EVT2;height=480;width=640\n% end\n";
  seeds.add("fuzz_event_files", 0, header + evt2);
  seeds.add("fuzz_event_files", 0x41, evt2);
  seeds.add("fuzz_event_stream", header + evt2 + std::string(4, '\0'));
  seeds.add("fuzz_event_files", 0x40, "0.001 5 6 1\n0.002 6 7 0\n");
  for (const YarpEncoding encoding :
       {YarpEncoding::kList, YarpEncoding::kStamped, YarpEncoding::kPlain}) {
    YarpLogEncoder log(encoding, packet.start);
    log.add(packet, 500);
    log.add_other(packet.newest(), "IMUS (1 2)");
    seeds.add("fuzz_event_files", 0x40, log.text());
  }
}

void add_containers(Seeds& seeds) {
  std::vector<EcfEvent> events;
  for (int i = 0; i < 60; ++i) {
    events.push_back({static_cast<std::uint16_t>(100 + i % 9), static_cast<std::uint16_t>(i / 9),
                      static_cast<std::int16_t>(i / 30), 1000 + i / 4 * 9});
  }
  std::vector<std::byte> chunk;
  for (const std::size_t step : {1, 7, 13}) {
    encode_ecf(events, chunk);
    const std::string bytes(reinterpret_cast<const char*>(chunk.data()), chunk.size());
    seeds.add("fuzz_ecf", bytes);
    seeds.add("fuzz_hdf5", std::string("\7\x3c"
                                       "640x480\0\0-1000\0\0\0\0",
                                       20) +
                               bytes);
    for (std::size_t i = 0; i < events.size(); ++i) {
      events[i].y = static_cast<std::uint16_t>(i * step % 48);
    }
  }
  const fs::path scratch = seeds.next("fuzz_aedat4");
  const auto writer = make_event_writer(scratch, "aedat4", {64, 48});
  EventPacket packet;
  for (std::uint32_t i = 0; i < 30; ++i) {
    packet.events.push_back(
        {.x = static_cast<std::uint16_t>(i), .y = 5, .polarity = 1, .offset_us = 10 * i});
  }
  writer->write(packet);
  writer->close();
  const std::string bytes = text_of(scratch);
  fs::remove(scratch);
  seeds.add("fuzz_event_files", 0, bytes);
  seeds.add("fuzz_aedat4", std::string(2, '\0') + bytes.substr(14));
  // Behind the header that the fuzzer makes: LZ4.
  const std::size_t header = bytes.find("</dv>") + 6;
  seeds.add("fuzz_aedat4", "\1\1" + bytes.substr(header));
}

void add_data_files(Seeds& seeds, const fs::path& source) {
  const fs::path calibration = source / "config" / "calibration";
  const std::vector<std::string> kinds{
      "t_us,x,y,width,height,visible\n0,10,20,30,40,1\n1000,11,21,30.5,40.5,0.25\n",
      "t_us,x,y,w,h\n1000,11,21,30.5,40.5\n0,1,2,3,4\n",
      "0.5 10 20 30 44\n1 11 21 31 45.5\n",
      text_of(calibration / "simulated_table.csv"),
      text_of(calibration / "simulated_size.toml"),
      text_of(calibration / "simulated_table.toml"),
      "[pixel_mask]\nwidth = 64\nheight = 48\npixels = [\n  1, 2,\n  3, 4,\n]\n",
      "[contour]\nlag_us = 100\nwall_share = 0.5\ngrow_px = 0.1\ntrail_px = 0.2\nlean_deg = -28\n",
      text_of(calibration / "simulated_arm.toml"),
      text_of(calibration / "simulated_arm.csv"),
      "-0.1 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n0.1\t0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n"};
  for (std::size_t i = 0; i < kinds.size(); ++i) seeds.add("fuzz_data_files", i, kinds[i]);
}

}  // namespace
}  // namespace puck

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: puck-fuzz-seeds SOURCE_DIR OUTPUT_DIR\n");
    return 2;
  }
  puck::Seeds seeds(argv[2]);
  puck::add_messages(seeds);
  puck::add_logs(seeds);
  puck::add_datagrams(seeds);
  puck::add_urls(seeds);
  puck::add_settings(seeds, argv[1]);
  puck::add_boards(seeds);
  puck::add_recordings(seeds);
  puck::add_containers(seeds);
  puck::add_event_streams(seeds, argv[1]);
  puck::add_data_files(seeds, argv[1]);
  return 0;
}
