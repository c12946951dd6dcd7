#include "tests/support/test_board.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <limits>
#include <list>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/support/test_board_bytes.h"

namespace puck {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr std::array<std::pair<std::string_view, BoardTrouble>, 28> kTroubles{{
    {"none", BoardTrouble::kNone},
    {"names_mute", BoardTrouble::kNamesMute},
    {"names_unknown", BoardTrouble::kNamesUnknown},
    {"names_garbage", BoardTrouble::kNamesGarbage},
    {"names_no_address", BoardTrouble::kNamesNoAddress},
    {"requests_late", BoardTrouble::kRequestsLate},
    {"requests_mute", BoardTrouble::kRequestsMute},
    {"requests_fail", BoardTrouble::kRequestsFail},
    {"requests_nak", BoardTrouble::kRequestsNak},
    {"requests_garbage", BoardTrouble::kRequestsGarbage},
    {"requests_endless", BoardTrouble::kRequestsEndless},
    {"requests_drip", BoardTrouble::kRequestsDrip},
    {"requests_close", BoardTrouble::kRequestsClose},
    {"axes_change", BoardTrouble::kAxesChange},
    {"modes_stay", BoardTrouble::kModesStay},
    {"mode_lost", BoardTrouble::kModeLost},
    {"state_mute", BoardTrouble::kStateMute},
    {"state_garbage", BoardTrouble::kStateGarbage},
    {"state_truncated", BoardTrouble::kStateTruncated},
    {"state_huge", BoardTrouble::kStateHuge},
    {"state_nan", BoardTrouble::kStateNan},
    {"state_frozen", BoardTrouble::kStateFrozen},
    {"state_stampless", BoardTrouble::kStateStampless},
    {"state_close", BoardTrouble::kStateClose},
    {"command_deaf", BoardTrouble::kCommandDeaf},
    {"command_close", BoardTrouble::kCommandClose},
    {"hello_wrong", BoardTrouble::kHelloWrong},
    {"byte_at_a_time", BoardTrouble::kByteAtATime},
}};

enum class Role : std::uint8_t { kNames, kRequests, kCommand, kState };
constexpr std::array kRoles{Role::kNames, Role::kRequests, Role::kCommand, Role::kState};
constexpr std::array<const char*, 4> kSuffixes{"", "/rpc:i", "/command:i", "/state:o"};

struct Connection {
  int socket = -1;
  Role role = Role::kNames;
  std::string in;
  std::string out;
  Clock::time_point send_from;  // output waits until then
  bool is_greeted = false;
  bool is_text = false;
  bool is_data_next = false;  // text: the `d` has come
  bool acknowledges = false;  // text
  bool is_turned_round = false;
  bool is_over = false;
};

// An open port of this machine; throws std::runtime_error.
int listen_on(int port) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  const int few_bytes = 4096;  // so that a port without a reader is soon full
  setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  setsockopt(listener, SOL_SOCKET, SO_RCVBUF, &few_bytes, sizeof few_bytes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      listen(listener, 16) != 0) {
    const std::string why = std::strerror(errno);
    close(listener);
    throw std::runtime_error("cannot listen on port " + std::to_string(port) + ": " + why);
  }
  return listener;
}

int port_of(int listener) {
  sockaddr_in address{};
  socklen_t length = sizeof address;
  getsockname(listener, reinterpret_cast<sockaddr*>(&address), &length);
  return ntohs(address.sin_port);
}

std::optional<std::string> take_line(std::string& input) {
  const std::size_t end = input.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = input.substr(0, end);
  input.erase(0, end + 1);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

std::string in_text(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

}  // namespace

std::optional<BoardTrouble> board_trouble(std::string_view name) {
  for (const auto& [known, trouble] : kTroubles) {
    if (known == name) return trouble;
  }
  return std::nullopt;
}

std::vector<std::string> board_trouble_names() {
  std::vector<std::string> names;
  for (const auto& known : kTroubles) names.emplace_back(known.first);
  return names;
}

class TestBoard::Ports {
 public:
  explicit Ports(const TestBoardParams& params)
      : params_(params), encoders_(params.axes), modes_(params.axes, "pos") {
    for (const Role role : kRoles) open(role);
    names_port_ = port_of(listeners_[0]);
  }
  ~Ports() {
    for (const Role role : kRoles) shut(role);
    for (Connection& connection : connections_) close(connection.socket);
  }
  Ports(const Ports&) = delete;
  Ports& operator=(const Ports&) = delete;

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      wait();
      const std::lock_guard lock(mutex_);
      for (const Role role : kRoles) accept_all(role);
      for (Connection& connection : connections_) attend(connection);
      send_states();
      for (Connection& connection : connections_) flush(connection);
      remove_over();
    }
  }

  std::mutex& mutex() { return mutex_; }

  void die() {
    is_dead_ = true;
    for (const Role role : {Role::kRequests, Role::kCommand, Role::kState}) shut(role);
    for (Connection& connection : connections_) {
      if (connection.role != Role::kNames) connection.is_over = true;
    }
  }
  void revive() {
    is_dead_ = false;
    modes_.assign(params_.axes, "pos");
    for (const Role role : {Role::kRequests, Role::kCommand, Role::kState}) open(role);
  }

  TestBoardParams params_;
  BoardTrouble trouble_ = BoardTrouble::kNone;
  std::vector<double> encoders_;
  std::vector<std::string> modes_;
  int names_port_ = 0;
  bool is_dead_ = false;
  std::int64_t set_points_ = 0;
  std::int64_t unreadable_ = 0;
  std::int64_t mode_requests_ = 0;
  std::int64_t text_dropped_ = 0;
  std::list<Connection> connections_;

 private:
  static std::size_t index(Role role) { return static_cast<std::size_t>(role); }
  bool has(BoardTrouble trouble) const { return trouble_ == trouble; }

  void open(Role role) {
    listeners_[index(role)] = listen_on(role == Role::kNames ? params_.port : 0);
    if (role != Role::kNames) ports_[index(role)] = port_of(listeners_[index(role)]);
  }
  void shut(Role role) {
    if (listeners_[index(role)] >= 0) close(listeners_[index(role)]);
    listeners_[index(role)] = -1;
  }

  void wait() {
    std::vector<pollfd> sockets;
    bool is_busy = false;
    {
      const std::lock_guard lock(mutex_);
      for (const int listener : listeners_) sockets.push_back({listener, POLLIN, 0});
      for (const Connection& connection : connections_) {
        if (!is_deaf(connection)) sockets.push_back({connection.socket, POLLIN, 0});
        if (!connection.out.empty() && connection.send_from <= Clock::now()) is_busy = true;
      }
    }
    poll(sockets.data(), sockets.size(), is_busy ? 0 : 2);
  }

  void accept_all(Role role) {
    while (listeners_[index(role)] >= 0) {
      const int socket =
          accept4(listeners_[index(role)], nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (socket < 0) return;
      const int on = 1;
      setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      connections_.push_back({.socket = socket, .role = role});
    }
  }

  bool is_deaf(const Connection& connection) const {
    return connection.role == Role::kCommand && connection.is_greeted &&
           has(BoardTrouble::kCommandDeaf);
  }

  bool closes(Role role) const {
    return (role == Role::kRequests && has(BoardTrouble::kRequestsClose)) ||
           (role == Role::kState && has(BoardTrouble::kStateClose)) ||
           (role == Role::kCommand && has(BoardTrouble::kCommandClose));
  }

  void attend(Connection& connection) {
    if (closes(connection.role)) connection.is_over = true;
    if (connection.is_over || is_deaf(connection)) return;
    std::array<char, 4096> piece{};
    const ssize_t count = recv(connection.socket, piece.data(), piece.size(), 0);
    if (count == 0) connection.is_over = true;
    if (count <= 0) return;
    connection.in.append(piece.data(), static_cast<std::size_t>(count));
    try {
      understand(connection);
    } catch (const std::runtime_error&) {
      ++unreadable_;
      connection.is_over = true;
    }
  }

  void understand(Connection& connection) {
    const bool is_binary_port =
        connection.role == Role::kCommand || connection.role == Role::kState;
    if (!connection.is_greeted && is_binary_port && connection.in.front() == 'Y') {
      if (!take_hello(connection.in)) return;
      connection.is_greeted = true;
      using namespace std::string_literals;
      connection.out += has(BoardTrouble::kHelloWrong) ? "HTTP/1.1"s : "YA\x1A\x27\0\0RP"s;
    }
    if (connection.is_greeted && !connection.is_text) return understand_messages(connection);
    // As observed with a real board.
    if (connection.role == Role::kState) return die();
    understand_lines(connection);
  }

  void understand_messages(Connection& connection) {
    while (const auto blocks = take_message(connection.in)) {
      if (connection.role == Role::kState) {
        if (blocks->size() == 1 && (*blocks)[0][5] == 'r') connection.is_turned_round = true;
      } else {
        obey(read_set_points(*blocks));
      }
    }
  }

  void obey(const SetPointMessage& message) {
    ++set_points_;
    for (std::size_t i = 0; i < message.deg.size(); ++i) {
      const std::size_t joint = message.kind == "dpog" ? message.joints[i] : i;
      if (joint >= encoders_.size()) throw std::runtime_error("a joint that is not there");
      if (modes_[joint] == "posd") encoders_[joint] = message.deg[i];
    }
  }

  void understand_lines(Connection& connection) {
    while (const auto line = take_line(connection.in)) {
      if (!connection.is_greeted) {
        const bool acknowledges = line->starts_with("CONNACK ");
        if (!acknowledges && !line->starts_with("CONNECT "))
          throw std::runtime_error("no greeting");
        connection.is_greeted = connection.is_text = true;
        connection.acknowledges = acknowledges;
        connection.out += "Welcome " + line->substr(8) + "\r\n";
      } else if (connection.role == Role::kCommand) {
        ++text_dropped_;
      } else if (!connection.is_data_next) {
        if (*line != "d") throw std::runtime_error("no data");
        connection.is_data_next = true;
      } else {
        connection.is_data_next = false;
        if (connection.out.empty()) {
          const bool is_late =
              connection.role == Role::kRequests && has(BoardTrouble::kRequestsLate);
          connection.send_from = Clock::now() + milliseconds(is_late ? params_.late_ms : 0);
        }
        connection.out +=
            connection.role == Role::kNames ? name_answer(*line) : request_answer(*line);
        if (connection.acknowledges) connection.out += "<ACK>\r\n";
      }
    }
  }

  std::string name_answer(const std::string& line) const {
    const std::string end = "*** end of message\r\n";
    if (has(BoardTrouble::kNamesMute)) return {};
    if (has(BoardTrouble::kNamesGarbage)) return "registration \x1b[31m of nobody\r\n" + end;
    const std::string part = params_.robot + "/" + params_.part;
    for (std::size_t i = 1; i < kSuffixes.size() && !has(BoardTrouble::kNamesUnknown); ++i) {
      if (line != "query " + part + kSuffixes[i]) continue;
      const bool is_none = has(BoardTrouble::kNamesNoAddress);
      return "registration name " + part + kSuffixes[i] + " ip " +
             (is_none ? "nowhere" : "127.0.0.1") + " port " + std::to_string(ports_[i]) +
             " type tcp\r\n" + end;
    }
    return end;
  }

  std::string request_answer(const std::string& line) {
    if (has(BoardTrouble::kRequestsMute)) return {};
    if (has(BoardTrouble::kRequestsFail)) return "[fail]\r\n";
    if (has(BoardTrouble::kRequestsNak)) return "[nak]\r\n";
    if (has(BoardTrouble::kRequestsGarbage)) return "[is] (((( \x07 [ok]\r\n";
    if (has(BoardTrouble::kRequestsDrip)) return std::string(1000, 'x');
    if (has(BoardTrouble::kRequestsEndless)) return std::string(100'000, 'x');
    std::istringstream words(line);
    std::string verb;
    std::string what;
    words >> verb >> what;
    if (verb == "get") {
      const std::string is = get(what, words);
      return is.empty() ? "[fail]\r\n" : "[is] " + is + " [tsta] 0 1795247365.76 [ok]\r\n";
    }
    if (verb == "set") return set(what, words) ? "[ok]\r\n" : "[fail]\r\n";
    return "[nak]\r\n";
  }

  std::size_t axes() const { return encoders_.size() - (has(BoardTrouble::kAxesChange) ? 1 : 0); }

  std::string get(const std::string& what, std::istream& words) const {
    if (what == "axes") return "axes " + std::to_string(axes());
    if (what == "encs") {
      std::string text = "encs (";
      for (const double deg : encoders_) text += in_text(deg) + " ";
      return text + ")";
    }
    if (what == "icmd") {
      std::string text = "[cmds] (";
      for (std::size_t i = 0; i < modes_.size(); ++i) {
        text += (i > 0 ? " [" : "[") + modes_[i] + "]";
      }
      return text + ")";
    }
    std::size_t joint = 0;
    if (!(words >> joint) || joint >= axes()) return {};
    if (what == "name") return "name joint" + std::to_string(joint);
    if (what == "llim") {
      return "llim " + in_text(params_.lowest_deg) + " " + in_text(params_.highest_deg);
    }
    return {};
  }

  bool set(const std::string& what, std::istream& words) {
    std::string order;
    if (what == "icmd" && words >> order) {
      ++mode_requests_;
      std::size_t joint = 0;
      std::string mode;
      if (order != "cmod" || !(words >> joint >> mode) || joint >= axes()) return false;
      const bool is_lost = joint == 0 && has(BoardTrouble::kModeLost);
      if (!has(BoardTrouble::kModesStay) && !is_lost) modes_[joint] = mode;
      return true;
    }
    std::size_t joint = 0;
    std::string deg;
    if (what != "pos" || !(words >> joint >> deg) || joint >= axes()) return false;
    if (modes_[joint] == "pos") encoders_[joint] = std::stod(deg);  // NaN, too
    return true;
  }

  void send_states() {
    const Clock::time_point now = Clock::now();
    if (now < next_state_ || has(BoardTrouble::kStateMute)) return;
    next_state_ = std::max(next_state_ + milliseconds(params_.period_ms), now);
    ++state_count_;
    if (!has(BoardTrouble::kStateFrozen)) {
      state_time_s_ = std::chrono::duration<double>(now.time_since_epoch()).count();
    }
    for (Connection& connection : connections_) {
      // A port drops messages for a slow reader.
      if (connection.is_turned_round && connection.out.empty()) connection.out += state_bytes();
    }
  }

  std::string state_bytes() const {
    if (has(BoardTrouble::kStateGarbage)) return "HTTP/1.1 404 Not Found\r\n\r\n";
    std::vector<double> deg = encoders_;
    if (has(BoardTrouble::kAxesChange)) deg.pop_back();
    if (has(BoardTrouble::kStateNan)) deg.back() = std::numeric_limits<double>::quiet_NaN();
    if (has(BoardTrouble::kStateStampless)) return state_message_without_stamp(deg);
    std::string bytes = state_message(state_count_, state_time_s_, deg);
    if (has(BoardTrouble::kStateHuge)) bytes[18 + 3] = '\x7F';
    if (has(BoardTrouble::kStateTruncated)) {
      // The vector's count is one more than its items.
      const std::size_t count_at = bytes.size() - 8 * deg.size() - 4;
      bytes[count_at] = static_cast<char>(deg.size() + 1);
    }
    return bytes;
  }

  void flush(Connection& connection) {
    if (connection.is_over || connection.out.empty() || connection.send_from > Clock::now()) return;
    const bool drips = connection.role == Role::kRequests && has(BoardTrouble::kRequestsDrip);
    if (drips) connection.send_from = Clock::now() + milliseconds(20);
    const bool is_single = drips || has(BoardTrouble::kByteAtATime);
    const std::size_t most = is_single ? 1 : connection.out.size();
    const ssize_t sent = send(connection.socket, connection.out.data(), most, MSG_NOSIGNAL);
    if (sent > 0) connection.out.erase(0, static_cast<std::size_t>(sent));
  }

  void remove_over() {
    std::erase_if(connections_, [](const Connection& connection) {
      if (connection.is_over) close(connection.socket);
      return connection.is_over;
    });
  }

  std::mutex mutex_;
  std::array<int, 4> listeners_{-1, -1, -1, -1};
  std::array<int, 4> ports_{};
  Clock::time_point next_state_;
  long long state_count_ = 0;
  double state_time_s_ = 0;
};

TestBoard::TestBoard(const TestBoardParams& params)
    : ports_(std::make_unique<Ports>(params)),
      thread_([this](const std::stop_token& stop) { ports_->run(stop); }) {}

TestBoard::~TestBoard() = default;

int TestBoard::port() const { return ports_->names_port_; }

void TestBoard::set_trouble(BoardTrouble trouble) {
  const std::lock_guard lock(ports_->mutex());
  ports_->trouble_ = trouble;
  if (trouble == BoardTrouble::kModeLost) ports_->modes_[0] = "hwf";
}

void TestBoard::move_joint(std::size_t joint, double deg) {
  const std::lock_guard lock(ports_->mutex());
  ports_->encoders_.at(joint) = deg;
}

void TestBoard::put_into_mode(const std::string& mode) {
  const std::lock_guard lock(ports_->mutex());
  ports_->modes_.assign(ports_->modes_.size(), mode);
}

void TestBoard::die() {
  const std::lock_guard lock(ports_->mutex());
  ports_->die();
}

void TestBoard::revive() {
  const std::lock_guard lock(ports_->mutex());
  ports_->revive();
}

bool TestBoard::is_dead() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->is_dead_;
}

std::vector<double> TestBoard::encoders() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->encoders_;
}

std::vector<std::string> TestBoard::modes() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->modes_;
}

std::int64_t TestBoard::set_points() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->set_points_;
}

std::int64_t TestBoard::unreadable() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->unreadable_;
}

std::int64_t TestBoard::mode_requests() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->mode_requests_;
}

std::int64_t TestBoard::text_dropped() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->text_dropped_;
}

std::size_t TestBoard::connections() const {
  const std::lock_guard lock(ports_->mutex());
  return ports_->connections_.size();
}

}  // namespace puck
