#pragma once

#include <filesystem>
#include <memory>

#include "common/io/byte_source.h"
#include "common/io/event_reader.h"

namespace puck {

/// The first bytes of an HDF5 file.
inline constexpr std::string_view kHdf5Signature("\x89HDF\r\n\x1a\n", 8);

/// Opens HDF5 files of events in Prophesee's layout (plain, gzip, ECF) and DSEC's. `bytes`: those
/// of `path`, of which nothing may have been read. The format needs a file, so other bytes than those of a file, or
/// compressed ones, are copied to a temporary file without a name first. Throws EventFileError.
std::unique_ptr<EventReader> open_hdf5_reader(std::unique_ptr<ByteSource> bytes,
                                              const std::filesystem::path& path,
                                              const EventFileOptions& options);

}  // namespace puck
