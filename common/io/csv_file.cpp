#include "common/io/csv_file.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <utility>

#include "common/io/parse_number.h"
#include "common/io/trimmed.h"

namespace puck {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::string text_of(double value) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongestQuote = 60;
  return '"' + std::string(text.substr(0, kLongestQuote)) + '"';
}

std::string names_of(std::span<const CsvColumn> columns) {
  std::string names;
  for (const CsvColumn& column : columns) {
    if (!names.empty()) names += ',';
    if (column.when_missing) names += '[';
    names += column.name;
    if (column.when_missing) names += ']';
  }
  return names;
}

// Index of each requested column in the file.
std::vector<std::size_t> places_of(const std::filesystem::path& path, std::size_t line,
                                   std::span<const std::string_view> header,
                                   std::span<const CsvColumn> columns) {
  std::vector<std::size_t> places;
  for (const CsvColumn& column : columns) {
    std::size_t place = kNone;
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (header[i] != column.name && (header[i].empty() || header[i] != column.other_name))
        continue;
      if (place != kNone) {
        throw_csv_error(path, line, "the column " + std::string(column.name) + " appears twice");
      }
      place = i;
    }
    if (place == kNone && !column.when_missing) {
      throw_csv_error(path, line,
                      "the header lacks the column " + std::string(column.name) + "; expected " +
                          names_of(columns));
    }
    places.push_back(place);
  }
  return places;
}

double parse_value(const std::filesystem::path& path, std::size_t line, const CsvColumn& column,
                   std::string_view text) {
  double value = 0;
  if (!parse_number(text, value) || !std::isfinite(value)) {
    throw_csv_error(path, line,
                    std::string(column.name) + " must be a number, got " + in_quotes(text));
  }
  if (value < column.lowest || value > column.highest) {
    throw_csv_error(path, line,
                    std::string(column.name) + " must be from " + text_of(column.lowest) + " to " +
                        text_of(column.highest) + ", got " + in_quotes(text));
  }
  return value;
}

}  // namespace

std::vector<CsvRow> read_csv(const std::filesystem::path& path,
                             std::span<const CsvColumn> columns) {
  errno = 0;
  std::ifstream file(path);
  if (!file) throw CsvError(path.string() + ": cannot be opened: " + std::strerror(errno));

  std::vector<CsvRow> rows;
  std::vector<std::size_t> places;
  std::size_t width = 0;
  std::size_t line_number = 0;
  for (std::string line; std::getline(file, line);) {
    ++line_number;
    std::string_view content = line;
    // Spreadsheets put a byte order mark first.
    if (line_number == 1 && content.starts_with("\xef\xbb\xbf")) content.remove_prefix(3);
    content = trimmed(content);
    if (content.empty() || content.front() == '#') continue;
    const std::vector<std::string_view> fields = split(content);
    if (places.empty()) {
      places = places_of(path, line_number, fields, columns);
      width = fields.size();
      continue;
    }
    if (fields.size() != width) {
      throw_csv_error(path, line_number,
                      "expected " + std::to_string(width) + " values as in the header, got " +
                          std::to_string(fields.size()));
    }
    CsvRow row;
    row.line = line_number;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      row.values.push_back(places[i] == kNone
                               ? *columns[i].when_missing
                               : parse_value(path, line_number, columns[i], fields[places[i]]));
    }
    rows.push_back(std::move(row));
  }
  if (file.bad() || !file.eof()) throw CsvError(path.string() + ": cannot be read to its end");
  if (rows.empty()) {
    throw_csv_error(path, line_number,
                    "no rows; expected a header " + names_of(columns) + " and rows below it");
  }
  return rows;
}

void write_csv(const std::filesystem::path& path, std::string_view header, std::string_view rows) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << header << '\n' << rows;
  file.close();
  if (!file) throw CsvError(path.string() + ": cannot be written: " + std::strerror(errno));
}

void append_csv_row(std::string& rows, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) rows += ',';
    rows += text_of(values[i]);
  }
  rows += '\n';
}

void throw_csv_error(const std::filesystem::path& path, std::size_t line,
                     const std::string& message) {
  throw CsvError(path.string() + ":" + std::to_string(line) + ": " + message);
}

}  // namespace puck
