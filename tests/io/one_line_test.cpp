#include <string>

#include <doctest/doctest.h>

#include "common/io/config.h"
#include "common/io/csv_file.h"
#include "common/io/event_reader.h"

namespace puck {

TEST_CASE("a refusal that quotes line breaks or terminal controls is one plain line") {
  const std::string quote = "is \"\x1b[2J\n\r\t\x7f\"";
  const std::string plain = "is \"?[2J????\"";
  CHECK(ConfigError(quote).what() == plain);
  CHECK(CsvError(quote).what() == plain);
  CHECK(EventFileError(quote).what() == plain);
  CHECK(ConfigError("µs in äöü").what() == std::string("µs in äöü"));
}

}  // namespace puck
