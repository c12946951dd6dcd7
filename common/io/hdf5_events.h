#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/io/ecf_codec.h"
#include "common/io/event_reader.h"
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

/// An element of Prophesee's /CD/events, as EcfEvent holds it in memory.
Hdf5Object prophesee_event_type();

/// Prophesee's layout: /CD/events. Throws EventFileError.
std::unique_ptr<Hdf5Events> open_prophesee_hdf5(Hdf5Object file, const std::string& name);

/// DSEC's layout: /events/x, y, t, p and /t_offset. Throws EventFileError.
std::unique_ptr<Hdf5Events> open_dsec_hdf5(Hdf5Object file, const std::string& name);

}  // namespace puck
