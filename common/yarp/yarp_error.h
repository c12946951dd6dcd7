#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace puck {

/// A fault of a port's owner or the name server, in one line that names the request. Quotes what
/// they sent, with `?` for control characters.
class YarpError : public std::runtime_error {
 public:
  enum class Kind : std::uint8_t {
    kFailed,       ///< Missing, or not as expected: may recover by itself.
    kNotReady,     ///< Its joints cannot be taken yet: may recover by itself.
    kNeedsPerson,  ///< Does not recover by itself: our settings do not fit the board, or a joint
                   ///< has a fault.
  };

  explicit YarpError(const std::string& what, Kind kind = Kind::kFailed)
      : std::runtime_error(what), kind_(kind) {}

  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// In double quotes, without control characters, shortened if long.
std::string in_quotes(std::string_view text);

/// Adds the port's name to the message of a YarpError from `work`.
template <typename Work>
auto at_port(const std::string& name, Work work) {
  try {
    return work();
  } catch (const YarpError& error) {
    throw YarpError(name + ": " + error.what(), error.kind());
  }
}

}  // namespace puck
