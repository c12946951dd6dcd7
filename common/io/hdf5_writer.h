#pragma once

#include <filesystem>
#include <memory>

#include "common/events/sensor_size.h"
#include "common/io/event_writer.h"

namespace puck {

enum class Hdf5Packing { kGzip, kEcf };

/// HDF5 in Prophesee's layout: /CD/events in chunks, /CD/indexes with the number of the first event
/// of every 2 ms, no triggers. `path` "-": a temporary file, which `close` copies to standard
/// output. Throws EventFileError, std::invalid_argument for an invalid sensor.
std::unique_ptr<EventWriter> make_hdf5_writer(const std::filesystem::path& path, SensorSize sensor,
                                              Hdf5Packing packing);

}  // namespace puck
