#include "common/io/hdf5_reader.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>

#include "common/io/event_sink.h"
#include "common/io/hdf5_events.h"
#include "common/io/reader_warnings.h"
#include "common/io/record_run.h"
#include "common/io/sensor_choice.h"
#include "common/io/unnamed_file.h"

namespace puck {
namespace {

bool is_hdf5_file(const std::filesystem::path& path) {
  std::error_code error;
  if (path == "-" || !std::filesystem::is_regular_file(path, error)) return false;
  std::array<char, kHdf5Signature.size()> start{};
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), start.size());
  return std::string_view(start.data(), start.size()) == kHdf5Signature;
}

void write_all(int file, std::span<const std::byte> bytes, const std::string& name) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      throw EventFileError(name + ": HDF5 needs a file, and a copy in the folder " +
                           std::filesystem::temp_directory_path().string() +
                           " cannot be written: " + std::strerror(errno) +
                           "; set TMPDIR to a folder with more space");
    }
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
}

Hdf5Object open_copy(ByteSource& bytes) {
  UnnamedFile copy("puck-hdf5-");
  std::vector<std::byte> block(std::size_t{1} << 20);
  while (const std::size_t count = bytes.read(block)) {
    write_all(copy.number(), std::span(block).first(count), bytes.name());
  }
  // The library keeps it open when its name is removed.
  return open_hdf5_file(copy.give_name(), bytes.name());
}

std::unique_ptr<Hdf5Events> open_events(Hdf5Object file, const std::string& name) {
  if (has_hdf5_object(file, "CD/events")) return open_prophesee_hdf5(std::move(file), name);
  if (has_hdf5_object(file, "events/x")) return open_dsec_hdf5(std::move(file), name);
  throw EventFileError(name +
                       ": is HDF5, but not of events; expected the data set /CD/events (Prophesee) "
                       "or /events/x, y, t and p (DSEC)");
}

class Hdf5Reader final : public EventReader {
 public:
  Hdf5Reader(std::unique_ptr<Hdf5Events> events, std::string name, SensorSize sensor,
             std::int64_t reorder_us, std::uint64_t bytes_behind)
      : name_(std::move(name)),
        bytes_behind_(bytes_behind),
        events_(std::move(events)),
        sensor_(sensor),
        reorder_us_(reorder_us),
        sink_(sensor, reorder_us) {}

  SensorSize sensor_size() const override { return sensor_; }

  bool read(EventPacket& packet, std::size_t max_events) override {
    packet.events.clear();
    sink_.begin(packet, max_events);
    while (sink_.has_room()) {
      if (part_used_ == part_.events.size() && !take_part()) break;
      take_events();
    }
    return !packet.empty();
  }

  bool can_rewind() const override { return true; }  // Of a pipe it holds a copy.
  void rewind() override {
    events_->rewind();
    sink_ = EventSink(sensor_, reorder_us_);
    part_.events.clear();
    part_used_ = 0;
    is_at_end_ = false;
    faults_.clear();
  }

  const EventCounters& counters() const override { return sink_.counters(); }

  RecordingFacts facts() const override {
    silence_hdf5();
    return events_->facts();
  }
  std::optional<double> share_read() const override { return events_->share_read(); }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> lines =
        reader_warnings(name_, counters(), is_at_end_ && !sink_.has_backlog());
    if (bytes_behind_ > 0) {
      lines.push_back(name_ + ": its last " + std::to_string(bytes_behind_) +
                      " bytes follow the end of the HDF5 file, as in joined files; they were left "
                      "out");
    }
    for (const std::string& fault : faults_) lines.push_back(one_line(name_ + ": " + fault));
    return lines;
  }

 private:
  static constexpr std::size_t kMostFaults = 5;

  void take_events() {
    const auto rest = std::span<const EcfEvent>(part_.events).subspan(part_used_);
    part_used_ +=
        take_records(sink_, run_, rest.size(), [&](std::size_t i) { return record_of(rest[i]); });
  }

  // Without the overflow of signed numbers that any bytes may cause.
  EventRecord record_of(const EcfEvent& event) const {
    return {static_cast<std::int64_t>(static_cast<std::uint64_t>(event.t_us) +
                                      static_cast<std::uint64_t>(part_.offset_us)),
            event.x, event.y, event.polarity > 0};
  }

  // False at the end, or after a part without events.
  bool take_part() {
    part_used_ = 0;
    // Another thread than the one that opened the file may read it.
    silence_hdf5();
    do {
      if (!events_->next(part_)) {
        is_at_end_ = true;
        return false;
      }
      if (part_.missing == 0) continue;
      ++sink_.counters().malformed_words;
      sink_.counters().missing += static_cast<std::int64_t>(part_.missing);
      if (faults_.size() < kMostFaults) faults_.push_back(part_.fault);
    } while (part_.events.empty());
    return true;
  }

  std::string name_;
  std::uint64_t bytes_behind_ = 0;
  std::unique_ptr<Hdf5Events> events_;
  SensorSize sensor_;
  std::int64_t reorder_us_;
  EventSink sink_;
  Hdf5Events::Part part_;
  std::size_t part_used_ = 0;
  std::array<Event, 1024> run_{};
  bool is_at_end_ = false;
  std::vector<std::string> faults_;
};

}  // namespace

std::unique_ptr<EventReader> open_hdf5_reader(std::unique_ptr<ByteSource> bytes,
                                              const std::filesystem::path& path,
                                              const EventFileOptions& options) {
  const std::string name = bytes->name();
  Hdf5Object file = is_hdf5_file(path) ? open_hdf5_file(path, name) : open_copy(*bytes);
  const std::uint64_t bytes_behind = bytes_behind_hdf5(file);
  auto events = open_events(std::move(file), name);
  const SensorSize sensor = choose_sensor(name, events->sensor_size(), std::nullopt, options);
  return std::make_unique<Hdf5Reader>(std::move(events), name, sensor, options.reorder_us,
                                      bytes_behind);
}

}  // namespace puck
