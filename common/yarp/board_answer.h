#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace puck {

/// What a board answered to a request on its port rpc:i, as text: `[is] encs (1.5 2.0 ) [tsta] 0
/// 1795247365.76 [ok]`.
class BoardAnswer {
 public:
  /// Throws BoardError that names the request: `[fail]`, `[nak]`, or no answer at all.
  BoardAnswer(std::string_view request, std::string_view line);

  // What a `get` was about: what stands after `[is] WORD`. They throw BoardError that names the
  // request when it does not.

  /// How many, at least 1 and at most `most`.
  int count(std::string_view word, int most) const;
  std::string name(std::string_view word) const;
  /// Finite numbers, without or with parentheses around them.
  std::vector<double> numbers(std::string_view word, std::size_t how_many) const;
  /// Words of up to four letters in a list.
  std::vector<std::string> vocabs(std::string_view word, std::size_t how_many) const;

 private:
  struct Item {
    std::string text;       // a vocab without its brackets
    bool is_vocab = false;  // [text]
    bool is_list = false;
    std::vector<Item> items;  // of a list
  };

  void parse(std::string_view line);
  std::vector<Item> values_of(std::string_view word) const;
  [[noreturn]] void refuse() const;

  std::string request_;
  std::string line_;
  std::vector<Item> items_;
};

}  // namespace puck
