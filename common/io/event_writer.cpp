#include "common/io/event_writer.h"

#include <stdexcept>
#include <string>

#include "common/io/event_reader.h"
#include "common/io/evt3_writer.h"
#include "common/io/text_event_writer.h"

namespace puck {
namespace {

std::string format_of_ending(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".raw") return "evt3";
  if (ending == ".txt" || ending == ".csv") return "text";
  throw EventFileError(path.string() +
                       ": expected an ending .raw, .txt or .csv, or the format as an option (evt3 "
                       "or text)");
}

}  // namespace

std::unique_ptr<EventWriter> make_event_writer(const std::filesystem::path& path,
                                               std::string_view format, SensorSize sensor) {
  const std::string wanted = format.empty() ? format_of_ending(path) : std::string(format);
  try {
    if (wanted == "evt3") return std::make_unique<Evt3Writer>(path, sensor);
    if (wanted == "text") return std::make_unique<TextEventWriter>(path, sensor);
  } catch (const std::invalid_argument& error) {
    throw EventFileError(path.string() + ": " + error.what());
  }
  throw EventFileError(path.string() + ": the format to write must be evt3 or text, got \"" +
                       wanted + "\"");
}

}  // namespace puck
