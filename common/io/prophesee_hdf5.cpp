// Prophesee's layout: a list of {x, y, p, t}, with t relative to the attribute "offset" of the list
// of indexes beside it.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/io/event_reader.h"
#include "common/io/hdf5_events.h"
#include "common/io/hdf5_gzip.h"
#include "common/io/parse_number.h"

namespace puck {
namespace {

constexpr std::uint64_t kPlainPartEvents = 16384;  // Where the list is not in chunks.
constexpr hsize_t kMostPackedBytes = hsize_t{16} << 20;

/// Who unpacks the chunks.
enum class Unpacking {
  kLibrary,
  kEcf,
  kGzip,
  kShuffledGzip,
};

Unpacking unpacking_of(const Hdf5DataSet& list, hid_t event_type) {
  using Filters = std::vector<int>;
  if (list.filters == Filters{kEcfFilter}) return Unpacking::kEcf;
  // The chunks hold the file's own form of an event.
  const Hdf5Object type(H5Dget_type(list.object.id()), H5Tclose);
  if (H5Tequal(type.id(), event_type) <= 0) return Unpacking::kLibrary;
  if (list.filters == Filters{H5Z_FILTER_DEFLATE}) return Unpacking::kGzip;
  if (list.filters == Filters{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE}) {
    return Unpacking::kShuffledGzip;
  }
  return Unpacking::kLibrary;
}

class PropheseeHdf5 final : public Hdf5EventList {
 public:
  PropheseeHdf5(Hdf5Object file, const std::string& name)
      : Hdf5EventList("data set /CD/events, events"),
        file_(std::move(file)),
        list_(open_hdf5_list(file_, "CD/events", name)),
        type_(prophesee_event_type()),
        unpacking_(unpacking_of(list_, type_.id())) {
    check_members(name);
    const bool is_ecf = unpacking_ == Unpacking::kEcf;
    if (!is_ecf) check_hdf5_filters(list_, name);
    if (is_ecf && list_.chunk_elements > kMostEcfEvents) {
      throw EventFileError(name + ": data set /CD/events has chunks of " +
                           std::to_string(list_.chunk_elements) + " events; ECF holds up to 65535");
    }
    add_list(list_, list_.chunk_elements > 0 ? list_.chunk_elements : kPlainPartEvents);
    find_offset(name);
    find_sensor(name);
  }

  std::optional<SensorSize> sensor_size() const override { return sensor_; }
  RecordingFacts facts() const override {
    return {"HDF5 (Prophesee), " + hdf5_packing(list_),
            hdf5_texts(Hdf5Object(H5Oopen(file_.id(), "/", H5P_DEFAULT), H5Oclose))};
  }

 private:
  void check_members(const std::string& name) const {
    const Hdf5Object type(H5Dget_type(list_.object.id()), H5Tclose);
    bool is_expected = H5Tget_class(type.id()) == H5T_COMPOUND;
    for (const char* member : {"x", "y", "p", "t"}) {
      if (!is_expected) break;
      const int index = H5Tget_member_index(type.id(), member);
      is_expected =
          index >= 0 && H5Tget_member_class(type.id(), static_cast<unsigned>(index)) == H5T_INTEGER;
    }
    // The format packs its own form of an event only.
    if (is_expected && unpacking_ == Unpacking::kEcf)
      is_expected = H5Tequal(type.id(), type_.id()) > 0;
    if (!is_expected) {
      throw EventFileError(name +
                           ": data set /CD/events does not hold events; expected records of "
                           "whole numbers x, y, p and t");
    }
  }

  void find_offset(const std::string& name) {
    if (!has_hdf5_object(file_, "CD/indexes")) return;
    const Hdf5Object indexes(H5Oopen(file_.id(), "CD/indexes", H5P_DEFAULT), H5Oclose);
    const auto text = indexes.is_open() ? hdf5_text(indexes, "offset") : std::nullopt;
    if (!text) return;
    if (!parse_number(*text, offset_us_)) {
      throw EventFileError(name + ": attribute offset of /CD/indexes is \"" + *text +
                           "\"; expected µs");
    }
  }

  void find_sensor(const std::string& name) {
    const Hdf5Object root(H5Oopen(file_.id(), "/", H5P_DEFAULT), H5Oclose);
    const auto text = hdf5_text(root, "geometry");
    if (!text) return;
    const std::size_t cross = std::min(text->find('x'), text->empty() ? 0 : text->size() - 1);
    SensorSize sensor;
    const bool is_size = !text->empty() && parse_number(text->substr(0, cross), sensor.width) &&
                         parse_number(text->substr(cross + 1), sensor.height);
    sensor_ = sensor;
    if (!is_size || !sensor.is_valid()) {
      throw EventFileError(name + ": attribute geometry is \"" + *text +
                           "\"; expected WIDTHxHEIGHT, each from 1 to 2048");
    }
  }

  void read_part(std::uint64_t first, std::uint64_t count, Part& part) override {
    std::vector<EcfEvent>& events = part.events;
    part.offset_us = static_cast<std::int64_t>(-static_cast<std::uint64_t>(offset_us_));
    // HDF5 leaves chunks as they are that packing would make larger.
    if (unpacking_ == Unpacking::kLibrary || !read_packed(first)) {
      events.resize(count);
      const std::string cause = read_hdf5_list(list_, first, count, type_.id(), events.data());
      if (!cause.empty()) throw std::invalid_argument(cause);
      return;
    }
    if (unpacking_ != Unpacking::kEcf) {
      const bool is_shuffled = unpacking_ == Unpacking::kShuffledGzip;
      gzip_.unpack(packed_, is_shuffled, list_.chunk_elements, count, events);
      return;
    }
    decode_ecf(packed_, events);
    if (events.size() < count) {
      throw std::invalid_argument("a chunk of " + std::to_string(events.size()) +
                                  " events, expected " + std::to_string(count));
    }
    events.resize(count);
  }

  // Past the library's filters: no plug-in is needed. Returns false for a chunk that is not packed.
  bool read_packed(std::uint64_t first) {
    const hsize_t start = first;
    hsize_t bytes = 0;
    if (H5Dget_chunk_storage_size(list_.object.id(), &start, &bytes) < 0) {
      throw std::invalid_argument(hdf5_cause());
    }
    if (bytes == 0 || bytes > kMostPackedBytes) {
      throw std::invalid_argument("a chunk of " + std::to_string(bytes) +
                                  " bytes, expected 1 byte to 16 MiB");
    }
    packed_.resize(bytes);
    std::uint32_t left_out = 0;
    if (H5Dread_chunk(list_.object.id(), H5P_DEFAULT, &start, &left_out, packed_.data()) < 0) {
      throw std::invalid_argument(hdf5_cause());
    }
    return left_out == 0;
  }

  Hdf5Object file_;
  Hdf5DataSet list_;
  Hdf5Object type_;
  Unpacking unpacking_ = Unpacking::kLibrary;
  Hdf5Gzip gzip_;
  std::int64_t offset_us_ = 0;  // To subtract.
  std::optional<SensorSize> sensor_;
  std::vector<std::byte> packed_;
};

}  // namespace

Hdf5Object prophesee_event_type() {
  const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(EcfEvent));
  H5Tinsert(type, "x", offsetof(EcfEvent, x), H5T_NATIVE_UINT16);
  H5Tinsert(type, "y", offsetof(EcfEvent, y), H5T_NATIVE_UINT16);
  H5Tinsert(type, "p", offsetof(EcfEvent, polarity), H5T_NATIVE_INT16);
  H5Tinsert(type, "t", offsetof(EcfEvent, t_us), H5T_NATIVE_INT64);
  return {type, H5Tclose};
}

std::unique_ptr<Hdf5Events> open_prophesee_hdf5(Hdf5Object file, const std::string& name) {
  return std::make_unique<PropheseeHdf5>(std::move(file), name);
}

}  // namespace puck
