#include "tools/log/message_csv.h"

#include <string_view>

#include "common/messaging/message_fields.h"
#include "common/messaging/wire_layout.h"

namespace puck {
namespace {

bool has_one_cell(const WireField& field) {
  return !field.count_field.empty() || field.fixed_count == 1;
}

std::string csv_quoted(std::string_view cell) {
  if (cell.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(cell);
  std::string text = "\"";
  for (const char c : cell) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

void append_element(std::string_view value, bool is_first, std::string& cell) {
  if (!is_first) cell += ';';
  for (const char c : value) {
    if (c == ';' || c == '\\') cell += '\\';
    cell += c;
  }
}

/// Builds the cells of a line from visit_fields(), which does not report empty variable-length
/// arrays: the layout gives the next cell.
class LineWriter {
 public:
  LineWriter(const WireLayout& layout, std::string& line) : layout_(layout), line_(line) {}

  void add(std::string_view name, std::optional<std::size_t> index, std::string_view value) {
    while (layout_.fields[field_].name != name) finish_field();
    const WireField& field = layout_.fields[field_];
    if (!index) {
      cell_ = value;
    } else if (has_one_cell(field)) {
      append_element(value, *index == 0, cell_);
    } else {
      if (*index > 0) finish_cell();
      cell_ = value;
    }
  }
  void finish() {
    while (field_ < layout_.fields.size()) finish_field();
  }

 private:
  void finish_cell() {
    const bool is_text = layout_.fields[field_].kind == WireKind::kString;
    line_.append(",").append(is_text ? csv_quoted(cell_) : cell_);
    cell_.clear();
  }
  void finish_field() {
    finish_cell();
    ++field_;
  }

  const WireLayout& layout_;
  std::string& line_;
  std::size_t field_ = 0;
  std::string cell_;
};

}  // namespace

std::string csv_header(Channel channel) {
  std::string line = "received_utime";
  for (const WireField& field : wire_layout(channel).fields) {
    if (has_one_cell(field)) {
      line.append(",").append(field.name);
      continue;
    }
    for (int i = 0; i < field.fixed_count; ++i) {
      line.append(",").append(field.name).append("_").append(std::to_string(i));
    }
  }
  return line + '\n';
}

std::string csv_line(Channel channel, std::int64_t received_utime,
                     std::span<const std::uint8_t> bytes) {
  std::string line = std::to_string(received_utime);
  LineWriter writer(wire_layout(channel), line);
  visit_fields(channel, bytes,
               [&](std::string_view name, std::optional<std::size_t> index,
                   std::string_view value) { writer.add(name, index, value); });
  writer.finish();
  return line + '\n';
}

}  // namespace puck
