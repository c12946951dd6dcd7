#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/io/ecf_codec.h"
#include "common/io/event_reader.h"
#include "common/io/hdf5_gaps.h"
#include "common/io/hdf5_object.h"

namespace puck {

/// The events of an HDF5 file, part by part. One thread at a time.
class Hdf5Events {
 public:
  virtual ~Hdf5Events() = default;

  /// A part of the list. Events of a part that cannot be read are missing.
  struct Part {
    std::vector<EcfEvent> events;
    std::int64_t offset_us = 0;  ///< To add to their times; the sum may overflow.
    std::uint64_t missing = 0;
    std::string fault;  ///< Why they are missing.
  };

  /// Replaces `part`, reusing its memory. Returns false at the end.
  virtual bool next(Part& part) = 0;
  virtual void rewind() = 0;

  virtual double share_read() const = 0;

  /// What the file says; nothing where it does not.
  virtual std::optional<SensorSize> sensor_size() const { return std::nullopt; }
  /// The layout and the packing, and the attributes of the file.
  virtual RecordingFacts facts() const = 0;
};

/// What the layouts share: the walk over one list of events, or several as long, around what was
/// never written.
class Hdf5EventList : public Hdf5Events {
 public:
  bool next(Part& part) final;
  void rewind() final { next_ = 0; }
  double share_read() const final {
    return elements_ == 0 ? 1.0 : static_cast<double>(next_) / static_cast<double>(elements_);
  }

 protected:
  /// `what`: the elements in messages, as "data set /CD/events, events".
  explicit Hdf5EventList(std::string what) : what_(std::move(what)) {}

  /// One more list, of as many elements as the others; so many are read at once.
  void add_list(const Hdf5DataSet& list, std::uint64_t most_at_once);

  /// Reads `count` events into an empty part. Throws std::invalid_argument with the reason where
  /// they cannot be read.
  virtual void read_part(std::uint64_t first, std::uint64_t count, Part& part) = 0;

 private:
  std::string what_;
  std::uint64_t elements_ = 0;
  std::uint64_t most_at_once_ = 0;
  Hdf5Gaps gaps_;
  std::uint64_t next_ = 0;
};

/// An element of Prophesee's /CD/events, as EcfEvent holds it in memory.
Hdf5Object prophesee_event_type();

/// Prophesee's layout: /CD/events. Throws EventFileError.
std::unique_ptr<Hdf5Events> open_prophesee_hdf5(Hdf5Object file, const std::string& name);

/// DSEC's layout: /events/x, y, t, p and /t_offset. Throws EventFileError.
std::unique_ptr<Hdf5Events> open_dsec_hdf5(Hdf5Object file, const std::string& name);

}  // namespace puck
