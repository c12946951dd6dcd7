#include "common/yarp/board_answer.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

template <typename Number>
bool read_whole(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

BoardAnswer::BoardAnswer(std::string_view request, std::string_view line)
    : request_(request), line_(line) {
  parse(line);
  if (items_.empty() || !items_.back().is_vocab) refuse();
  const std::string& verdict = items_.back().text;
  if (verdict == "fail" || verdict == "nak") {
    throw YarpError("it refused " + in_quotes(request_) + " with [" + verdict + "]");
  }
  if (verdict != "ok") refuse();
}

// Words, "words in quotes", [vocabs], and lists of these without nesting.
void BoardAnswer::parse(std::string_view line) {
  std::vector<Item>* into = &items_;
  for (std::size_t at = 0; at < line.size();) {
    const char c = line[at];
    if (is_blank(c)) {
      ++at;
    } else if (c == '(') {
      if (into != &items_) refuse();
      items_.push_back({.is_list = true});
      into = &items_.back().items;
      ++at;
    } else if (c == ')') {
      if (into == &items_) refuse();
      into = &items_;
      ++at;
    } else if (c == '[' || c == '"') {
      const std::size_t end = line.find(c == '[' ? ']' : '"', at + 1);
      if (end == std::string_view::npos) refuse();
      into->push_back(
          {.text = std::string(line.substr(at + 1, end - at - 1)), .is_vocab = c == '['});
      at = end + 1;
    } else {
      const std::size_t end = std::min(line.find_first_of(" \t()[]\"", at), line.size());
      if (end == at) refuse();
      into->push_back({.text = std::string(line.substr(at, end - at))});
      at = end;
    }
  }
  if (into != &items_) refuse();
}

std::vector<BoardAnswer::Item> BoardAnswer::values_of(std::string_view word) const {
  const bool is_about_it = items_.size() >= 3 && items_[0].is_vocab && items_[0].text == "is" &&
                           !items_[1].is_list && items_[1].text == word;
  if (!is_about_it) refuse();
  std::vector<Item> values;
  // A time stamp and the verdict follow the list.
  for (std::size_t i = 2; i < items_.size() && !items_[i].is_vocab; ++i) {
    values.push_back(items_[i]);
  }
  if (values.size() == 1 && values[0].is_list) return values[0].items;
  return values;
}

int BoardAnswer::count(std::string_view word, int most) const {
  const auto values = values_of(word);
  int count = 0;
  if (values.size() != 1 || !read_whole(values[0].text, count) || count < 1 || count > most) {
    refuse();
  }
  return count;
}

std::string BoardAnswer::name(std::string_view word) const {
  const auto values = values_of(word);
  if (values.size() != 1 || values[0].text.empty()) refuse();
  return values[0].text;
}

std::vector<double> BoardAnswer::numbers(std::string_view word, std::size_t how_many) const {
  std::vector<double> numbers;
  for (const Item& item : values_of(word)) {
    double number = 0;
    if (!read_whole(item.text, number) || !std::isfinite(number)) refuse();
    numbers.push_back(number);
  }
  if (numbers.size() != how_many) refuse();
  return numbers;
}

std::vector<std::string> BoardAnswer::vocabs(std::string_view word, std::size_t how_many) const {
  std::vector<std::string> vocabs;
  for (const Item& item : values_of(word)) {
    if (!item.is_vocab) refuse();
    vocabs.push_back(item.text);
  }
  if (vocabs.size() != how_many) refuse();
  return vocabs;
}

void BoardAnswer::refuse() const {
  throw YarpError("it answered " + in_quotes(line_) + " to " + in_quotes(request_));
}

}  // namespace puck
