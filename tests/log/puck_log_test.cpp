// The real puck-log on intact and damaged logs, and on other files.
#include <algorithm>
#include <array>
#include <filesystem>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "common/messaging/event_packing.h"
#include "common/messaging/log_file.h"
#include "common/messaging/message_seal.h"
#include "tests/support/child_process.h"
#include "tests/support/environment.h"
#include "tests/support/random_message.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

using Json = nlohmann::json;

Finished puck_log(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), program_path("puck-log"));
  return run_program(arguments);
}

/// A channel of a log.
std::string name_of(Channel channel) { return channel_name(channel, ""); }

template <typename Message>
void put(LogWriter& writer, std::int64_t utime, Message message) {
  std::vector<std::uint8_t> bytes;
  encode(message, bytes);
  writer.write(name_of(kChannelOf<Message>), utime, bytes);
}

/// One second: 101 packets of 1000 events, one of them lost, from two sessions of the camera; heads
/// with a gap of 500 ms; a foreign message.
void write_known_log(const std::filesystem::path& path) {
  LogWriter writer(path);
  EventPacker packer({.sensor = {640, 480}, .packet_bytes = EventPackerParams::kMaxBytes});
  for (int i = 0; i <= 100; ++i) {
    packer.pack({i * 10'000}, std::vector<Event>(1000), [&](event_packet_t& packet) {
      packet.session = i < 60 ? 11 : 12;
      packet.seq = i < 60 ? i : i - 60;
      if (i >= 60) packet.events_before -= 60'000;
      if (i != 30) put(writer, 1'000'000 + i * 10'000, packet);
    });
    head_state_t head{};
    head.session = 5;
    head.seq = i;
    if (i < 20 || i > 70) head.seq = i < 20 ? i : i - 51;
    if (i < 20 || i > 70) put(writer, 1'000'000 + i * 10'000, head);
  }
  writer.write("OTHER", 2'000'000, std::vector<std::uint8_t>{1, 2, 3});
}

constexpr std::size_t kRounds = 3;

/// Three messages of every type, each on its channel. Returns their places in the file.
std::vector<std::size_t> write_all_types(const std::filesystem::path& path) {
  std::mt19937_64 random(4);
  LogWriter writer(path);
  std::vector<std::size_t> offsets;
  for (std::size_t round = 0; round < kRounds; ++round) {
    for (const Channel channel : kAllChannels) {
      offsets.push_back(static_cast<std::size_t>(writer.bytes()));
      writer.write(name_of(channel), 1'000'000 + static_cast<std::int64_t>(round),
                   random_message(channel, random).bytes);
    }
  }
  return offsets;
}

/// The number of these messages that are left.
std::string messages(std::size_t lost) {
  return std::to_string(kRounds * kAllChannels.size() - lost) + " messages";
}

void flip(const std::filesystem::path& path, std::size_t offset) {
  std::string text = read_text(path);
  text[offset] = static_cast<char>(text[offset] ^ 0x10);
  write_text(path, text);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("info summarises a log") {
  const TemporaryFolder folder;
  write_known_log(folder / "a.lcm");
  const Finished finished = puck_log({"info", folder / "a.lcm", "--json"});
  CHECK(finished.exit_code == 0);
  const Json json = Json::parse(finished.output);
  CHECK(json["messages"] == 100 + 50 + 1);
  CHECK(json["duration_s"] == doctest::Approx(1.0));
  CHECK(json["foreign"] == 1);
  CHECK(json["damaged_places"] == 0);
  CHECK(json["bytes"] == std::filesystem::file_size(folder / "a.lcm"));
  REQUIRE(json["channels"].size() == 3);

  const Json& other = json["channels"][0];
  CHECK(other["channel"] == "OTHER");
  CHECK(other["type"].is_null());
  CHECK(other["rate_hz"].is_null());

  const Json& events = json["channels"][1];
  CHECK(events["channel"] == "PUCK_EVENTS");
  CHECK(events["type"] == "event_packet_t");
  CHECK(events["messages"] == 100);
  CHECK(events["rate_hz"] == doctest::Approx(99.0));
  CHECK(events["sessions"] == 2);
  CHECK(events["lost"] == 1);
  CHECK(events["events"] == 100'000);
  CHECK(events["events_lost"] == 1000);
  CHECK(events["event_rate_mev_s"] == doctest::Approx(0.1));

  const Json& head = json["channels"][2];
  CHECK(head["channel"] == "PUCK_HEAD");
  CHECK(head["lost"] == 0);
  CHECK(head["longest_gap_ms"] == doctest::Approx(520.0));
  CHECK(head["longest_gap_at_s"] == doctest::Approx(0.19));

  const Finished table = puck_log({"info", folder / "a.lcm"});
  CHECK(table.exit_code == 0);
  CHECK(table.output.find("PUCK_EVENTS: 100000 events, 0.100 Mev/s, 1000 events lost") !=
        std::string::npos);
  CHECK(table.output.find("the log is valid") != std::string::npos);
}

TEST_CASE("verify accepts an intact log of every type") {
  const TemporaryFolder folder;
  write_all_types(folder / "a.lcm");
  const Finished finished = puck_log({"verify", folder / "a.lcm"});
  CHECK(finished.exit_code == 0);
  CHECK(finished.output == messages(0) + ": the log is valid\n");
}

TEST_CASE("a report that cannot be written is not reported as fine") {
  const TemporaryFolder folder;
  write_known_log(folder / "a.lcm");
  const std::string program = program_path("puck-log");
  for (const char* command : {"info", "verify"}) {
    CAPTURE(command);
    ChildProcess to_full_disk({program, command, folder / "a.lcm"}, {.output = "/dev/full"});
    CHECK(to_full_disk.wait() == 1);
  }
}

TEST_CASE("verify names the byte of malformed, corrupt or truncated records") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  const auto offsets = write_all_types(path);
  flip(path, offsets[3] + 28 + name_of(kAllChannels[3]).size());  // Its fingerprint.
  flip(path, offsets[10]);                                        // Its mark.
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  const Finished finished = puck_log({"verify", path});
  CHECK(finished.exit_code == 1);
  const auto lines = lines_of(finished.output);
  REQUIRE(lines.size() == 4);
  CHECK(lines[0] == "byte " + std::to_string(offsets[3]) +
                        ": PUCK_ARM_COMMAND: arm_command_t has the fingerprint of another type or "
                        "version");
  CHECK(lines[1] == "byte " + std::to_string(offsets[10]) + ": " +
                        std::to_string(offsets[11] - offsets[10]) +
                        " bytes are no message: no message begins");
  CHECK(lines[2].starts_with("byte " + std::to_string(offsets[offsets.size() - 1]) + ": "));
  CHECK(lines[2].ends_with("bytes are no message: the log ends within a message"));
  CHECK(lines[3].starts_with(messages(2) + ": "));
  CHECK(lines[3].ends_with("at 2 places belong to no message, 1 messages are malformed"));
}

TEST_CASE("verify reports messages sealed with a key that the logger did not have") {
  const TemporaryFolder folder;
  const auto key_file = folder.write("key", std::string(32, 'k'));
  std::filesystem::permissions(key_file, std::filesystem::perms::owner_read);
  const SharedKey key(key_file);
  std::mt19937_64 random(4);
  auto bytes = random_message(Channel::kHead, random).bytes;
  MessageSealer(key).seal("PUCK_HEAD", bytes);
  LogWriter(folder / "a.lcm").write("PUCK_HEAD", 1, bytes);
  const Finished finished = puck_log({"verify", folder / "a.lcm"});
  CHECK(finished.exit_code == 1);
  CHECK(lines_of(finished.output).at(0) ==
        "byte 0: PUCK_HEAD: is sealed; the logger had no key (lcm.key_file)");
}

TEST_CASE("repair makes a damaged log intact, and reports the omitted parts") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  const auto offsets = write_all_types(path);
  flip(path, offsets[3] + 28 + name_of(kAllChannels[3]).size());
  flip(path, offsets[10]);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  const std::string before = read_text(path);
  const Finished finished = puck_log({"repair", path, folder / "b.lcm"});
  CHECK(finished.exit_code == 0);
  CHECK(lines_of(finished.output).size() == 4);
  CHECK(finished.output.find("byte " + std::to_string(offsets[10]) + ": left out") !=
        std::string::npos);
  CHECK(finished.output.find(messages(3) + " copied to") != std::string::npos);
  CHECK(read_text(path) == before);
  const Finished verified = puck_log({"verify", folder / "b.lcm"});
  CHECK(verified.exit_code == 0);
  CHECK(verified.output == messages(3) + ": the log is valid\n");

  const Finished again = puck_log({"repair", path, folder / "b.lcm"});
  CHECK(again.exit_code == 1);
  CHECK(again.errors.find("exists already and is not overwritten") != std::string::npos);
}

TEST_CASE("repair of an intact log changes no byte") {
  const TemporaryFolder folder;
  write_known_log(folder / "a.lcm");
  CHECK(puck_log({"repair", folder / "a.lcm", folder / "b.lcm"}).exit_code == 0);
  CHECK(read_text(folder / "a.lcm") == read_text(folder / "b.lcm"));
}

TEST_CASE("export writes a table for each channel, with equal numbers of cells in all lines") {
  const TemporaryFolder folder;
  write_all_types(folder / "a.lcm");
  const auto csv = folder / "csv";
  const Finished finished = puck_log({"export", folder / "a.lcm", "--output", csv});
  CHECK(finished.exit_code == 0);
  // Without a folder name it uses the log's name.
  CHECK(puck_log({"export", folder / "a.lcm"}).exit_code == 0);
  CHECK(read_text(folder / "a-csv" / "PUCK_HEAD.csv") == read_text(csv / "PUCK_HEAD.csv"));
  for (const Channel channel : kAllChannels) {
    CAPTURE(name_of(channel));
    const auto lines = lines_of(read_text(csv / (name_of(channel) + ".csv")));
    REQUIRE(lines.size() == 4);
    CHECK(lines[0].starts_with("received_utime,utime,session,seq,"));
    for (std::size_t round = 0; round < 3; ++round) {
      CHECK(lines[round + 1].starts_with(std::to_string(1'000'000 + round) + ","));
      if (channel == Channel::kStatus || channel == Channel::kArmState) continue;  // Hold text.
      CHECK(std::ranges::count(lines[round + 1], ',') == std::ranges::count(lines[0], ','));
    }
  }
}

TEST_CASE("export of one channel goes to stdout, and arrays and text stay in their cells") {
  const TemporaryFolder folder;
  {
    LogWriter writer(folder / "a.lcm");
    puck_trajectory_t trajectory{};
    trajectory.session = 1;
    trajectory.covariance[15] = 0.5;
    trajectory.path_t_s = {0.0, 0.25};
    trajectory.path_x_m = {1.0, 2.0};
    trajectory.path_y_m = {-1.0, -2.0};
    put(writer, 7, trajectory);
    service_status_t status{};
    status.session = 1;
    status.service = "a \"b\", c";
    status.counter_name = {"x;y", "back\\slash"};
    status.counter_value = {1, -2};
    put(writer, 8, status);
  }
  const Finished path = puck_log({"export", folder / "a.lcm", "--channel", "PUCK_TRAJECTORY"});
  CHECK(path.exit_code == 0);
  const auto lines = lines_of(path.output);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].find(",covariance_0,covariance_1,") != std::string::npos);
  CHECK(lines[0].find(",covariance_15,path_length,path_t_s,path_x_m,path_y_m,crosses,") !=
        std::string::npos);
  CHECK(lines[1].find(",0.5,2,0;0.25,1;2,-1;-2,0,") != std::string::npos);

  const Finished status = puck_log({"export", folder / "a.lcm", "--channel", "PUCK_STATUS"});
  CHECK(lines_of(status.output).at(1) ==
        R"(8,0,1,0,"a ""b"", c",,0,,0,,0,2,x\;y;back\\slash,1;-2,0,,,,,,0,,,)");

  const Finished none = puck_log({"export", folder / "a.lcm", "--channel", "PUCK_GAME"});
  CHECK(none.exit_code == 1);
  CHECK(none.errors.find("no PUCK message on PUCK_GAME") != std::string::npos);
}

TEST_CASE("a channel with a prefix is recognised, any other name is not") {
  const TemporaryFolder folder;
  std::mt19937_64 random(4);
  {
    LogWriter writer(folder / "a.lcm");
    const auto bytes = random_message(Channel::kHead, random).bytes;
    for (const char* name : {"LEFT_PUCK_HEAD", "PUCK_HEAD", "left_PUCK_HEAD", "_PUCK_HEAD",
                             "XPUCK_HEAD", "../_PUCK_HEAD", "PUCK_HEAD2", "A\x1b[2J_PUCK_HEAD"}) {
      writer.write(name, 1, bytes);
    }
  }
  const auto csv = folder / "csv";
  CHECK(puck_log({"export", folder / "a.lcm", "--output", csv}).exit_code == 0);
  CHECK(std::distance(std::filesystem::directory_iterator(csv), {}) == 2);
  CHECK(std::filesystem::exists(csv / "LEFT_PUCK_HEAD.csv"));
  const Finished info = puck_log({"info", folder / "a.lcm"});
  CHECK(info.output.find('\x1b') == std::string::npos);
}

TEST_CASE("files that are no log and usage errors have different exit codes") {
  const TemporaryFolder folder;
  write_text(folder / "text", "t,x,y,p\n");
  for (const std::string command : {"info", "verify"}) {
    CHECK(puck_log({command, folder / "none"}).exit_code == 1);
    CHECK(puck_log({command, folder / "text"}).exit_code == 1);
    CHECK(puck_log({command}).exit_code == 2);
  }
  CHECK(puck_log({}).exit_code == 2);
  CHECK(puck_log({"mend", folder / "text"}).exit_code == 2);
  CHECK(puck_log({"repair", folder / "text"}).exit_code == 2);
  CHECK(puck_log({"export"}).exit_code == 2);
  CHECK(puck_log({"export", folder / "text"}).exit_code == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "text-csv"));
  CHECK(puck_log({"--help"}).exit_code == 0);
  CHECK(puck_log({"repair", folder / "text", folder / "out"}).exit_code == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("with any bit of a log flipped every command ends, and the repaired log is intact") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  const auto whole_path = folder / "whole.lcm";
  write_all_types(whole_path);
  const std::string whole = read_text(whole_path);
  std::mt19937_64 random(11);
  for (int round = 0; round < 15; ++round) {
    std::string text = whole;
    for (int i = 0; i < 20; ++i)
      text[4 + random() % (text.size() - 4)] = static_cast<char>(random());
    text.resize(text.size() - random() % 100);
    write_text(path, text);
    std::filesystem::remove(folder / "b.lcm");
    CHECK(puck_log({"info", path, "--json"}).exit_code >= 0);
    CHECK(puck_log({"verify", path}).exit_code >= 0);
    CHECK(puck_log({"export", path, "--output", folder / "csv"}).exit_code >= 0);
    CHECK(puck_log({"repair", path, folder / "b.lcm"}).exit_code == 0);
    CHECK(puck_log({"verify", folder / "b.lcm"}).exit_code == 0);
  }
}

}  // namespace puck
