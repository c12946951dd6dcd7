#include "common/io/event_writer.h"

#include <stdexcept>
#include <string>

#include "common/io/aedat4_writer.h"
#include "common/io/dat_writer.h"
#include "common/io/es_writer.h"
#include "common/io/event_reader.h"
#include "common/io/evt21_writer.h"
#include "common/io/evt2_writer.h"
#include "common/io/evt3_writer.h"
#include "common/io/hdf5_writer.h"
#include "common/io/text_event_writer.h"

namespace puck {
namespace {

std::string listed_formats() {
  std::string list;
  for (const WrittenFormat& format : kWrittenFormats) {
    list += (list.empty() ? "" : ", ") + std::string(format.name);
  }
  return list;
}

std::unique_ptr<EventWriter> make_named_writer(const std::filesystem::path& path,
                                               std::string_view format, SensorSize sensor) {
  using Text = TextEventWriter::Form;
  if (format == "evt3") return std::make_unique<Evt3Writer>(path, sensor);
  if (format == "evt2") return std::make_unique<Evt2Writer>(path, sensor);
  if (format == "evt21") return std::make_unique<Evt21Writer>(path, sensor);
  if (format == "dat") return std::make_unique<DatWriter>(path, sensor);
  if (format == "hdf5") return make_hdf5_writer(path, sensor, Hdf5Packing::kGzip);
  if (format == "hdf5-ecf") return make_hdf5_writer(path, sensor, Hdf5Packing::kEcf);
  if (format == "aedat4") return std::make_unique<Aedat4Writer>(path, sensor);
  if (format == "es") return std::make_unique<EsWriter>(path, sensor);
  if (format == "csv") return std::make_unique<TextEventWriter>(path, sensor, Text::kCommas);
  if (format == "text") return std::make_unique<TextEventWriter>(path, sensor, Text::kBlanks);
  return nullptr;
}

}  // namespace

std::string_view format_of_ending(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  std::string endings;
  for (const WrittenFormat& format : kWrittenFormats) {
    if (format.ending.empty()) continue;
    if (ending == format.ending) return format.name;
    endings += std::string(format.ending) + ", ";
  }
  if (ending == ".h5") return "hdf5";
  throw EventFileError(path.string() + ": the name does not end with a format; expected " +
                       endings + ".h5, or the format as an option (" + listed_formats() + ")");
}

std::unique_ptr<EventWriter> make_event_writer(const std::filesystem::path& path,
                                               std::string_view format, SensorSize sensor) {
  const std::string_view wanted = format.empty() ? format_of_ending(path) : format;
  try {
    if (auto writer = make_named_writer(path, wanted, sensor)) return writer;
  } catch (const std::invalid_argument& error) {
    throw EventFileError(path.string() + ": " + error.what());
  }
  throw EventFileError(path.string() + ": the format to write must be one of " + listed_formats() +
                       ", got \"" + std::string(wanted) + "\"");
}

}  // namespace puck
