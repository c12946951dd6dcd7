#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace puck {

/// A fault of a test board.
enum class BoardTrouble : std::uint8_t {
  kNone,
  kNamesMute,        ///< The name server does not answer,
  kNamesUnknown,     ///< knows no port,
  kNamesGarbage,     ///< answers nonsense,
  kNamesNoAddress,   ///< or an address that is none.
  kRequestsLate,     ///< Port rpc:i answers after TestBoardParams::late_ms,
  kRequestsMute,     ///< not at all,
  kRequestsFail,     ///< everything with [fail],
  kRequestsNak,      ///< or [nak],
  kRequestsGarbage,  ///< nonsense,
  kRequestsEndless,  ///< a line without an end,
  kRequestsDrip,     ///< the same, a byte each 20 ms,
  kRequestsClose,    ///< or closes each connection.
  kAxesChange,       ///< There is one joint fewer than before,
  kModesStay,        ///< joints do not change their mode,
  kModeLost,         ///< or joint 0 falls out of it, as in an emergency stop.
  kStateMute,        ///< Port state:o sends nothing,
  kStateGarbage,     ///< nonsense,
  kStateTruncated,   ///< a vector that ends early,
  kStateHuge,        ///< a message of 2 GB,
  kStateNan,         ///< an encoder that is NaN,
  kStateFrozen,      ///< the same time again and again,
  kStateStampless,   ///< no stamp,
  kStateClose,       ///< or closes each connection.
  kCommandDeaf,      ///< Port command:i reads nothing,
  kCommandClose,     ///< or closes each connection.
  kHelloWrong,       ///< The binary carrier is another,
  kByteAtATime,      ///< or every byte comes alone.
};

/// By its name on command lines, `state_mute`; nothing for an unknown name.
std::optional<BoardTrouble> board_trouble(std::string_view name);
std::vector<std::string> board_trouble_names();

struct TestBoardParams {
  int port = 0;  ///< Of the name server; 0: any free port.
  std::string robot = "/icub";
  std::string part = "right_arm";
  std::size_t axes = 7;
  double lowest_deg = -90;
  double highest_deg = 90;
  int period_ms = 20;  ///< Between two messages with encoders.
  int late_ms = 50;
};

/// A name server and a control board in one, on ports of this machine. They behave as observed with
/// real ones: set-points sent as text are dropped silently, text to state:o kills the board, NaN is
/// accepted, and joints are at their set-points at the next reading. A thread of its own; all calls
/// are safe from any thread.
class TestBoard {
 public:
  explicit TestBoard(const TestBoardParams& params = {});
  ~TestBoard();

  /// Port of the name server.
  int port() const;

  void set_trouble(BoardTrouble trouble);
  /// Moves a joint as a hand would.
  void move_joint(std::size_t joint, double deg);
  /// Changes the mode of all joints, as another client would.
  void put_into_mode(const std::string& mode);
  /// Closes all connections and ports, as the death of the process does; then a new one.
  void die();
  void revive();

  bool is_dead() const;
  std::vector<double> encoders() const;
  std::vector<std::string> modes() const;
  /// Binary set-points that were executed, and those that could not be read.
  std::int64_t set_points() const;
  std::int64_t unreadable() const;
  /// Requests to change a joint's mode, executed or not.
  std::int64_t mode_requests() const;
  /// Lines of text received at command:i.
  std::int64_t text_dropped() const;
  /// Present number, over all ports.
  std::size_t connections() const;

 private:
  class Ports;
  std::unique_ptr<Ports> ports_;
  std::jthread thread_;
};

}  // namespace puck
