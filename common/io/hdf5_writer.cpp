#include "common/io/hdf5_writer.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/io/ecf_codec.h"
#include "common/io/event_checks.h"
#include "common/io/event_reader.h"
#include "common/io/hdf5_events.h"
#include "common/io/hdf5_gzip.h"
#include "common/io/output_file.h"
#include "common/io/unnamed_file.h"

namespace puck {
namespace {

constexpr std::size_t kChunkElements = 16384;  // As Prophesee's own files have.
constexpr std::int64_t kIndexPeriod_us = 2000;
constexpr unsigned kGzipLevel = 1;
// An index entry for every 2 ms fills the file in a longer one.
constexpr std::int64_t kLongestHdf5Pause_us = std::int64_t{24} * 3600 * 1000000;

struct IndexEntry {
  std::uint64_t event = 0;
  std::int64_t t_us = 0;
};
struct Trigger {
  std::int16_t value = 0;
  std::int64_t t_us = 0;
  std::int16_t id = 0;
};

Hdf5Object index_type() {
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(IndexEntry));
  H5Tinsert(type, "id", offsetof(IndexEntry, event), H5T_NATIVE_UINT64);
  H5Tinsert(type, "ts", offsetof(IndexEntry, t_us), H5T_NATIVE_INT64);
  return {type, H5Tclose};
}

Hdf5Object trigger_type() {
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(Trigger));
  H5Tinsert(type, "p", offsetof(Trigger, value), H5T_NATIVE_INT16);
  H5Tinsert(type, "t", offsetof(Trigger, t_us), H5T_NATIVE_INT64);
  H5Tinsert(type, "id", offsetof(Trigger, id), H5T_NATIVE_INT16);
  return {type, H5Tclose};
}

/// A list that grows chunk by chunk.
class GrowingList {
 public:
  GrowingList(hid_t group, const char* name, Hdf5Object type, Hdf5Packing packing)
      : type_(std::move(type)) {
    const hsize_t none = 0;
    const hsize_t no_limit = H5S_UNLIMITED;
    const hsize_t chunk = kChunkElements;
    const Hdf5Object space(H5Screate_simple(1, &none, &no_limit), H5Sclose);
    const Hdf5Object creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(creation.id(), 1, &chunk);
    if (packing == Hdf5Packing::kEcf) {
      // Optional, or the library would look for a plug-in that packs; this writer does.
      H5Pset_filter(creation.id(), kEcfFilter, H5Z_FLAG_OPTIONAL, 0, nullptr);
    } else {
      H5Pset_shuffle(creation.id());
      H5Pset_deflate(creation.id(), kGzipLevel);
    }
    object_ = Hdf5Object(
        H5Dcreate2(group, name, type_.id(), space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
        H5Dclose);
  }

  bool is_open() const { return object_.is_open(); }
  hid_t id() const { return object_.id(); }

  bool append(const void* elements, std::size_t count) {
    const hsize_t first = size_;
    const hsize_t length = count;
    if (!grow(count)) return false;
    const Hdf5Object memory(H5Screate_simple(1, &length, nullptr), H5Sclose);
    const Hdf5Object part(H5Dget_space(object_.id()), H5Sclose);
    H5Sselect_hyperslab(part.id(), H5S_SELECT_SET, &first, nullptr, &length, nullptr);
    return H5Dwrite(object_.id(), type_.id(), memory.id(), part.id(), H5P_DEFAULT, elements) >= 0;
  }

  /// A whole chunk, already packed, of which `count` elements count.
  bool append_packed(const std::vector<std::byte>& packed, std::size_t count) {
    const hsize_t first = size_;
    return grow(count) &&
           H5Dwrite_chunk(object_.id(), H5P_DEFAULT, 0, &first, packed.size(), packed.data()) >= 0;
  }

 private:
  bool grow(std::size_t count) {
    size_ += count;
    return H5Dset_extent(object_.id(), &size_) >= 0;
  }

  Hdf5Object type_;
  Hdf5Object object_;
  hsize_t size_ = 0;
};

void set_text(hid_t object, const char* name, const std::string& text) {
  const Hdf5Object type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), H5T_VARIABLE);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  const Hdf5Object space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Object attribute(
      H5Acreate2(object, name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* value = text.c_str();
  H5Awrite(attribute.id(), type.id(), static_cast<const void*>(&value));
}

class Hdf5Writer final : public EventWriter {
 public:
  Hdf5Writer(const std::filesystem::path& path, SensorSize sensor, Hdf5Packing packing)
      : sensor_(checked_sensor(sensor)),
        name_(path == "-" ? "stdout" : path.string()),
        packing_(packing) {
    silence_hdf5();
    if (path == "-") copied_.emplace("puck-hdf5-");
    const std::filesystem::path target = copied_ ? copied_->give_name() : path;
    // Opened as a plain file first, for the system's words on what is wrong.
    OutputFile(target).flush();
    file_ =
        Hdf5Object(H5Fcreate(target.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    // The library keeps it open.
    if (copied_) copied_->drop_name();
    if (!file_.is_open()) fail();
    set_text(file_.id(), "version", "1.0");
    set_text(file_.id(), "format", packing == Hdf5Packing::kEcf ? "ECF" : "HDF5");
    set_text(file_.id(), "geometry",
             std::to_string(sensor.width) + "x" + std::to_string(sensor.height));
    const Hdf5Object cd = new_group("CD");
    events_.emplace(cd.id(), "events", prophesee_event_type(), packing);
    indexes_.emplace(cd.id(), "indexes", index_type(), Hdf5Packing::kGzip);
    const Hdf5Object triggers = new_group("EXT_TRIGGER");
    const GrowingList no_triggers(triggers.id(), "events", trigger_type(), Hdf5Packing::kGzip);
    if (!events_->is_open() || !indexes_->is_open() || !no_triggers.is_open()) fail();
    block_.reserve(kChunkElements);
    index_block_.reserve(kChunkElements);
  }

  ~Hdf5Writer() override {
    try {
      close();
    } catch (const std::exception&) {
      // A caller that needs the error calls close() first.
    }
  }

  void write(const EventPacket& packet) override {
    for (const Event& event : packet.events) {
      const Timestamp time = packet.time_of(event);
      check_event(event, time, sensor_, newest_);
      if (!start_) start(time);
      if (time - newest_ > kLongestHdf5Pause_us) {
        throw std::invalid_argument("HDF5 holds pauses of up to 24 h, got " +
                                    std::to_string((time - newest_) / 1000000) + " s");
      }
      pauses_.add(time - newest_, "HDF5");
      newest_ = time;
      add_indexes_until(time - *start_);
      block_.push_back({event.x, static_cast<std::uint16_t>(event.y),
                        static_cast<std::int16_t>(event.polarity), time - *start_});
      ++written_;
      if (block_.size() == kChunkElements) write_block();
    }
  }

  void close() override {
    if (!file_.is_open()) return;
    if (!start_) start({0});
    write_block();
    // One more that ends the last 2 ms.
    add_indexes_until(next_index_us_);
    write_indexes();
    const bool is_written = H5Fflush(file_.id(), H5F_SCOPE_LOCAL) >= 0;
    if (!is_written) fail();
    events_.reset();
    indexes_.reset();
    file_ = {};
    if (copied_) copy_to_stdout(copied_->path());
  }

 private:
  Hdf5Object new_group(const char* name) const {
    return {H5Gcreate2(file_.id(), name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose};
  }

  [[noreturn]] void fail() {
    const std::string cause = hdf5_cause();
    // Nothing more is written, also not on destruction.
    events_.reset();
    indexes_.reset();
    file_ = {};
    throw EventFileError(name_ + ": cannot be written: " + cause);
  }

  // Times in the file count from the first event, as Prophesee's do.
  void start(Timestamp first) {
    start_ = first;
    newest_ = first;
    set_text(indexes_->id(), "offset", std::to_string(-first.us));
  }

  // For every 2 ms up to `t_us`.
  void add_indexes_until(std::int64_t t_us) {
    for (; next_index_us_ <= t_us; next_index_us_ += kIndexPeriod_us) {
      index_block_.push_back({written_, next_index_us_});
      if (index_block_.size() == kChunkElements) write_indexes();
    }
  }

  void write_indexes() {
    if (index_block_.empty()) return;
    if (!indexes_->append(index_block_.data(), index_block_.size())) fail();
    index_block_.clear();
  }

  void write_block() {
    if (block_.empty()) return;
    const std::size_t count = block_.size();
    // A chunk is always whole; what is beyond the list's end has no meaning.
    block_.resize(kChunkElements, block_.back());
    if (packing_ == Hdf5Packing::kEcf) {
      encode_ecf(block_, packed_);
    } else {
      gzip_.pack(block_, packed_);
    }
    if (!events_->append_packed(packed_, count)) fail();
    block_.clear();
  }

  SensorSize sensor_;
  std::string name_;
  Hdf5Packing packing_;
  std::optional<UnnamedFile> copied_;
  Hdf5Object file_;
  std::optional<GrowingList> events_;
  std::optional<GrowingList> indexes_;
  std::optional<Timestamp> start_;
  Timestamp newest_{0};
  PauseSum pauses_;
  std::uint64_t written_ = 0;
  std::int64_t next_index_us_ = 0;
  std::vector<EcfEvent> block_;
  std::vector<IndexEntry> index_block_;
  Hdf5Gzip gzip_;
  std::vector<std::byte> packed_;
};

}  // namespace

std::unique_ptr<EventWriter> make_hdf5_writer(const std::filesystem::path& path, SensorSize sensor,
                                              Hdf5Packing packing) {
  return std::make_unique<Hdf5Writer>(path, sensor, packing);
}

}  // namespace puck
