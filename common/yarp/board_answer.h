#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace puck {

/// A board's text answer to a request on its port rpc:i, such as `[is] encs (1.5 2.0 ) [tsta] 0
/// 1795247365.76 [ok]`.
class BoardAnswer {
 public:
  /// Throws YarpError that names the request: `[fail]`, `[nak]`, or not an answer.
  BoardAnswer(std::string_view request, std::string_view line);

  // The values after `[is] WORD` in the answer to a `get`. Each function throws YarpError that
  // names the request when the answer has other contents.

  /// A number from 1 to `most`.
  int count(std::string_view word, int most) const;
  std::string name(std::string_view word) const;
  /// Finite numbers, with or without parentheses around them.
  std::vector<double> numbers(std::string_view word, std::size_t how_many) const;
  /// A list of vocabs (words of up to four letters).
  std::vector<std::string> vocabs(std::string_view word, std::size_t how_many) const;

 private:
  struct Item {
    std::string text;       // A vocab without its brackets.
    bool is_vocab = false;  // [text]
    bool is_list = false;
    std::vector<Item> items;  // Items of a list.
  };

  void parse(std::string_view line);
  std::vector<Item> values_of(std::string_view word) const;
  [[noreturn]] void refuse() const;

  std::string request_;
  std::string line_;
  std::vector<Item> items_;
};

}  // namespace puck
