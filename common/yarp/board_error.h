#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace puck {

/// A control board, or the name server, did not do what it should: one line that says what, and to
/// what it was asked. What it sent is quoted with `?` for what would steer a terminal.
class BoardError : public std::runtime_error {
 public:
  enum class Kind : std::uint8_t {
    kFailed,       ///< It is not there, or not as it should be: may be over by itself.
    kNotReady,     ///< Its joints are not to be taken yet: may be over by itself.
    kNeedsPerson,  ///< Never over by itself: our settings do not fit it, or a joint is at fault.
  };

  explicit BoardError(const std::string& what, Kind kind = Kind::kFailed)
      : std::runtime_error(what), kind_(kind) {}

  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// In double quotes and harmless, shortened if it is long.
std::string in_quotes(std::string_view text);

}  // namespace puck
