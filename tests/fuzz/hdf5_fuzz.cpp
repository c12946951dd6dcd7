// A sound HDF5 file whose chunk, offset and geometry are any bytes: what this project reads past or
// through the library. The library's own parsing is not fuzzed here.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <hdf5.h>

#include "common/io/event_reader.h"
#include "common/io/hdf5_writer.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

namespace puck {
namespace {

void set_text(hid_t object, const char* name, std::string text) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  text += '\0';
  H5Awrite(attribute, type, text.data());
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
}

std::vector<std::uint8_t> made_file(bool is_ecf, hsize_t elements, const std::string& geometry,
                                    const std::string& offset, std::string_view chunk) {
  const hid_t in_memory = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(in_memory, 65536, false);
  const hid_t file = H5Fcreate("fuzz", H5F_ACC_TRUNC, H5P_DEFAULT, in_memory);
  H5Pclose(in_memory);
  require(file >= 0, "a file can be made");
  set_text(file, "geometry", geometry);
  const hid_t group = H5Gcreate2(file, "CD", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Tcreate(H5T_COMPOUND, 16);
  H5Tinsert(type, "x", 0, H5T_STD_U16LE);
  H5Tinsert(type, "y", 2, H5T_STD_U16LE);
  H5Tinsert(type, "p", 4, H5T_STD_I16LE);
  H5Tinsert(type, "t", 8, H5T_STD_I64LE);
  const hsize_t most = H5S_UNLIMITED;
  const hsize_t chunk_elements = 256;
  const hid_t space = H5Screate_simple(1, &elements, &most);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 1, &chunk_elements);
  if (is_ecf) {
    H5Pset_filter(creation, 0x8ECF, H5Z_FLAG_OPTIONAL, 0, nullptr);
  } else {
    H5Pset_deflate(creation, 1);
  }
  const hid_t events = H5Dcreate2(group, "events", type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  const hid_t indexes =
      H5Dcreate2(group, "indexes", H5T_STD_I64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  set_text(indexes, "offset", offset);
  const hsize_t first = 0;
  if (elements > 0 && !chunk.empty()) {
    H5Dwrite_chunk(events, H5P_DEFAULT, 0, &first, chunk.size(), chunk.data());
  }
  for (const hid_t set : {events, indexes}) H5Dclose(set);
  H5Pclose(creation);
  H5Sclose(space);
  H5Tclose(type);
  H5Gclose(group);
  H5Fflush(file, H5F_SCOPE_LOCAL);
  std::vector<std::uint8_t> image(
      static_cast<std::size_t>(std::max<ssize_t>(0, H5Fget_file_image(file, nullptr, 0))));
  H5Fget_file_image(file, image.data(), image.size());
  H5Fclose(file);
  return image;
}

std::int64_t read_all(EventReader& reader, std::size_t max_events) {
  EventPacket packet;
  std::int64_t events = 0;
  while (reader.read(packet, max_events)) {
    for (const Event& event : packet.events) {
      require(reader.sensor_size().contains(event.x, event.y), "events lie inside the sensor");
    }
    events += static_cast<std::int64_t>(packet.events.size());
  }
  for (const std::string& warning : reader.warnings()) require_one_line(warning);
  return events;
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kHead = 20;
  if (size < kHead) return 0;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  puck::MemoryFile file;
  const std::vector<std::uint8_t> image = puck::made_file(
      (data[0] & 1) != 0, data[1], (data[0] & 2) != 0 ? "640x480" : std::string(bytes.substr(2, 9)),
      (data[0] & 4) != 0 ? "-1000" : std::string(bytes.substr(11, 9)), bytes.substr(kHead));
  const auto& path = file.write(image.data(), image.size());
  try {
    const auto reader = puck::open_event_file(path);
    const std::int64_t events = puck::read_all(*reader, 7);
    reader->rewind();
    puck::require(puck::read_all(*reader, 5000) == events, "a second reading gives the same");
  } catch (const puck::EventFileError& error) {
    puck::require_one_line(error.what());
  }
  return 0;
}
