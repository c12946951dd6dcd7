#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/one_line.h"

namespace puck {

/// An error in a CSV file; the message is `file:line: what was expected`.
class CsvError : public std::runtime_error {
 public:
  explicit CsvError(const std::string& message) : std::runtime_error(one_line(message)) {}
};

/// A column of numbers, requested by name.
struct CsvColumn {
  std::string_view name;
  std::string_view other_name = {};                   ///< Also accepted in the header.
  std::optional<double> when_missing = std::nullopt;  ///< If unset, the column is required.
  double lowest = -1e18;
  double highest = 1e18;
};

struct CsvRow {
  std::size_t line = 0;        ///< In the file, from 1.
  std::vector<double> values;  ///< In the order of the requested columns.
};

/// Reads the requested columns of a comma-separated file with a header; other columns are ignored.
/// Skips empty lines, lines that begin with `#`, and a byte order mark. Throws CsvError for a file
/// that cannot be read, has no rows, lacks a column, or has a row with a missing, malformed or
/// out-of-range value.
std::vector<CsvRow> read_csv(const std::filesystem::path& path, std::span<const CsvColumn> columns);

/// Appends a line with the values; reading it back gives the same bits.
void append_csv_row(std::string& rows, std::span<const double> values);

/// Writes a header and the lines in `rows`. Throws CsvError when the file cannot be written.
void write_csv(const std::filesystem::path& path, std::string_view header, std::string_view rows);

/// Throws CsvError with `path:line: ` before the message.
[[noreturn]] void throw_csv_error(const std::filesystem::path& path, std::size_t line,
                                  const std::string& message);

}  // namespace puck
