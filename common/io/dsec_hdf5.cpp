// The layout of the data set DSEC: a list each of x, y, t and p, with t in µs relative to the
// number /t_offset. Its list ms_to_idx only repeats what the times say.
#include <algorithm>
#include <utility>

#include "common/io/event_reader.h"
#include "common/io/hdf5_events.h"
#include "common/io/hdf5_gaps.h"

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

class DsecHdf5 final : public Hdf5Events {
 public:
  DsecHdf5(Hdf5Object file, const std::string& name)
      : file_(std::move(file)),
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
    for (const Hdf5DataSet* list : {&x_, &y_, &p_, &t_}) gaps_.add(*list);
    if (!has_hdf5_object(file_, "t_offset")) return;
    const Hdf5Object offset(H5Dopen2(file_.id(), "t_offset", H5P_DEFAULT), H5Dclose);
    const Hdf5Object space(H5Dget_space(offset.id()), H5Sclose);
    if (H5Sget_simple_extent_npoints(space.id()) != 1 ||
        H5Dread(offset.id(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &offset_us_) < 0) {
      throw EventFileError(name + ": data set /t_offset cannot be read; expected one number, µs");
    }
  }

  bool next(Part& part) override {
    part.missing = 0;
    part.events.clear();
    if (next_ >= x_.elements) return false;
    const Hdf5Gaps::Run run = gaps_.run_from(next_, x_.elements);
    if (run.is_missing) {
      part.missing = run.end - next_;
      part.fault = "data sets /events/x, y, p and t, elements from " + std::to_string(next_) +
                   " on: " + std::to_string(part.missing) + " were never written to the file";
      next_ = run.end;
      return true;
    }
    const std::uint64_t count = std::min(kDsecPartEvents, run.end - next_);
    const std::uint64_t first = std::exchange(next_, next_ + count);
    columns_.resize(count);
    times_us_.resize(count);
    part.events.resize(count);
    part.offset_us = offset_us_;
    const bool is_read =
        read_into(part, x_, first, [](EcfEvent& event, std::uint16_t x) { event.x = x; }) &&
        read_into(part, y_, first, [](EcfEvent& event, std::uint16_t y) { event.y = y; }) &&
        read_into(part, p_, first,
                  [](EcfEvent& event, std::uint16_t p) { event.polarity = p > 0 ? 1 : 0; }) &&
        read_times(part, first);
    if (!is_read) {
      part.events.clear();
      part.missing = count;
    }
    return true;
  }

  void rewind() override { next_ = 0; }
  double share_read() const override {
    return x_.elements == 0 ? 1.0 : static_cast<double>(next_) / static_cast<double>(x_.elements);
  }
  RecordingFacts facts() const override {
    return {"HDF5 (DSEC), " + hdf5_packing(t_), {{"t_offset", std::to_string(offset_us_)}}};
  }

 private:
  // Numbers that do not fit become the nearest that does: below 0 it is 0, as for polarity −1.
  template <typename Set>
  bool read_into(Part& part, const Hdf5DataSet& list, std::uint64_t first, Set set) {
    const std::string cause =
        read_hdf5_list(list, first, columns_.size(), H5T_NATIVE_UINT16, columns_.data());
    if (!cause.empty()) return tell_fault(part, list, first, cause);
    for (std::size_t i = 0; i < columns_.size(); ++i) set(part.events[i], columns_[i]);
    return true;
  }

  bool read_times(Part& part, std::uint64_t first) {
    const std::string cause =
        read_hdf5_list(t_, first, times_us_.size(), H5T_NATIVE_INT64, times_us_.data());
    if (!cause.empty()) return tell_fault(part, t_, first, cause);
    for (std::size_t i = 0; i < times_us_.size(); ++i) {
      part.events[i].t_us = times_us_[i];
    }
    return true;
  }

  static bool tell_fault(Part& part, const Hdf5DataSet& list, std::uint64_t first,
                         const std::string& cause) {
    part.fault =
        "data set /" + list.path + ", elements from " + std::to_string(first) + " on: " + cause;
    return false;
  }

  Hdf5Object file_;
  Hdf5DataSet x_;
  Hdf5DataSet y_;
  Hdf5DataSet p_;
  Hdf5DataSet t_;
  Hdf5Gaps gaps_;
  std::int64_t offset_us_ = 0;  // To add.
  std::uint64_t next_ = 0;
  std::vector<std::uint16_t> columns_;
  std::vector<std::int64_t> times_us_;
};

}  // namespace

std::unique_ptr<Hdf5Events> open_dsec_hdf5(Hdf5Object file, const std::string& name) {
  return std::make_unique<DsecHdf5>(std::move(file), name);
}

}  // namespace puck
