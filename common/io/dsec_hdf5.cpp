// The layout of the data set DSEC: a list each of x, y, t and p, with t in µs relative to the
// number /t_offset. Its list ms_to_idx only repeats what the times say.
#include <stdexcept>
#include <utility>

#include "common/io/event_reader.h"
#include "common/io/hdf5_events.h"

namespace puck {
namespace {

constexpr std::uint64_t kDsecPartEvents = 65536;

Hdf5DataSet open_numbers(const Hdf5Object& file, const char* path, const std::string& name) {
  Hdf5DataSet list = open_hdf5_list(file, path, name);
  const Hdf5Object type(H5Dget_type(list.object.id()), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.id());
  if (kind != H5T_INTEGER && kind != H5T_ENUM) {
    throw EventFileError(name + ": data set /" + path +
                         " does not hold whole numbers; expected pixels, µs, or 0 and 1");
  }
  check_hdf5_filters(list, name);
  return list;
}

class DsecHdf5 final : public Hdf5EventList {
 public:
  DsecHdf5(Hdf5Object file, const std::string& name)
      : Hdf5EventList("data sets /events/x, y, p and t, elements"),
        file_(std::move(file)),
        x_(open_numbers(file_, "events/x", name)),
        y_(open_numbers(file_, "events/y", name)),
        p_(open_numbers(file_, "events/p", name)),
        t_(open_numbers(file_, "events/t", name)) {
    if (y_.elements != x_.elements || p_.elements != x_.elements || t_.elements != x_.elements) {
      throw EventFileError(name + ": data sets /events/x, y, p and t have " +
                           std::to_string(x_.elements) + ", " + std::to_string(y_.elements) + ", " +
                           std::to_string(p_.elements) + " and " + std::to_string(t_.elements) +
                           " elements; expected the same number");
    }
    for (const Hdf5DataSet* list : {&x_, &y_, &p_, &t_}) add_list(*list, kDsecPartEvents);
    if (!has_hdf5_object(file_, "t_offset")) return;
    const Hdf5Object offset(H5Dopen2(file_.id(), "t_offset", H5P_DEFAULT), H5Dclose);
    if (offset.is_open()) check_hdf5_is_inside(offset, name + ": data set /t_offset");
    const Hdf5Object space(H5Dget_space(offset.id()), H5Sclose);
    if (H5Sget_simple_extent_npoints(space.id()) != 1 ||
        H5Dread(offset.id(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &offset_us_) < 0) {
      throw EventFileError(name + ": data set /t_offset cannot be read; expected one number, µs");
    }
  }

  RecordingFacts facts() const override {
    return {"HDF5 (DSEC), " + hdf5_packing(t_), {{"t_offset", std::to_string(offset_us_)}}};
  }

 private:
  void read_part(std::uint64_t first, std::uint64_t count, Part& part) override {
    columns_.resize(count);
    times_us_.resize(count);
    part.events.resize(count);
    part.offset_us = offset_us_;
    // Numbers that do not fit become the nearest that does: below 0 it is 0, as for polarity −1.
    const auto read_column = [&](const Hdf5DataSet& list, auto set) {
      read_list(list, first, count, H5T_NATIVE_UINT16, columns_.data());
      for (std::size_t i = 0; i < count; ++i) set(part.events[i], columns_[i]);
    };
    read_column(x_, [](EcfEvent& event, std::uint16_t x) { event.x = x; });
    read_column(y_, [](EcfEvent& event, std::uint16_t y) { event.y = y; });
    read_column(p_, [](EcfEvent& event, std::uint16_t p) { event.polarity = p > 0 ? 1 : 0; });
    read_list(t_, first, count, H5T_NATIVE_INT64, times_us_.data());
    for (std::size_t i = 0; i < count; ++i) part.events[i].t_us = times_us_[i];
  }

  static void read_list(const Hdf5DataSet& list, std::uint64_t first, std::uint64_t count,
                        hid_t memory_type, void* room) {
    const std::string cause = read_hdf5_list(list, first, count, memory_type, room);
    if (!cause.empty()) throw std::invalid_argument("/" + list.path + ": " + cause);
  }

  Hdf5Object file_;
  Hdf5DataSet x_;
  Hdf5DataSet y_;
  Hdf5DataSet p_;
  Hdf5DataSet t_;
  std::int64_t offset_us_ = 0;  // To add.
  std::vector<std::uint16_t> columns_;
  std::vector<std::int64_t> times_us_;
};

}  // namespace

std::unique_ptr<Hdf5Events> open_dsec_hdf5(Hdf5Object file, const std::string& name) {
  return std::make_unique<DsecHdf5>(std::move(file), name);
}

}  // namespace puck
