#pragma once

#include <filesystem>
#include <string>

#include "common/io/event_reader.h"
#include "tools/convert/conversion_filter.h"

namespace puck {

struct ConvertOptions {
  std::filesystem::path in;
  std::filesystem::path out;
  std::string to;      ///< Format; empty: from the ending of `out`.
  std::string prefix;  ///< Of the channels of an LCM log.
  EventFileOptions file;
  ConversionFilterParams filter;
};

/// Converts a recording and prints what was read, written and left out. Returns false where
/// large_loss finds one, after writing what there is. Throws std::exception with
/// a one-line message; then there is no output, and an older one stays.
bool convert(const ConvertOptions& options);

}  // namespace puck
