#include "common/yarp/board_requests.h"

#include "common/yarp/state_message.h"
#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

constexpr const char* kGetModes = "get icmd cmds";

std::string mode_request(int joint, std::string_view mode) {
  return "set icmd cmod " + std::to_string(joint) + " " + std::string(mode);
}

}  // namespace

BoardRequests::BoardRequests(const PortAddress& address, std::string_view local_name,
                             const Waiter& waiter, SteadyClock::duration patience,
                             Deadline connected_by)
    : waiter_(waiter),
      patience_(patience),
      connection_(address, local_name, waiter, connected_by) {}

int BoardRequests::axes() {
  return ask("get axes").count("axes", static_cast<int>(kMostBoardJoints));
}

std::string BoardRequests::name(int joint) {
  return ask("get name " + std::to_string(joint)).name("name");
}

JointRange BoardRequests::range(int joint) {
  const auto ends = ask("get llim " + std::to_string(joint)).numbers("llim", 2);
  return {ends[0], ends[1]};
}

std::vector<std::string> BoardRequests::modes(std::size_t axes) {
  return ask(kGetModes).vocabs("cmds", axes);
}

void BoardRequests::begin_modes() { begin(kGetModes); }

void BoardRequests::begin_set_mode(int joint, std::string_view mode) {
  begin(mode_request(joint, mode));
}

void BoardRequests::begin(const std::string& request) {
  const SteadyClock::time_point now = SteadyClock::now();
  connection_.send(request, waiter_, now + patience_);
  // Set after sending: a stop may have prevented that, and then no answer comes.
  asked_ = request;
  asked_at_ = now;
}

std::optional<BoardAnswer> BoardRequests::answer_now() {
  const auto line = connection_.receive_now();
  if (!line) return std::nullopt;
  if (!asked_at_) throw YarpError("it sent " + in_quotes(*line) + " without being asked");
  note_answer();
  return BoardAnswer(asked_, *line);
}

void BoardRequests::leave_mode(const std::vector<int>& joints, std::size_t axes,
                               std::string_view from, std::string_view to, const Waiter& waiter,
                               Deadline deadline) {
  if (asked_at_) {
    connection_.receive(waiter, deadline);
    note_answer();
  }
  const auto modes = ask(kGetModes, waiter, deadline).vocabs("cmds", axes);
  for (const int joint : joints) {
    if (modes[static_cast<std::size_t>(joint)] != from) continue;
    ask(mode_request(joint, to), waiter, deadline);
  }
}

BoardAnswer BoardRequests::ask(const std::string& request) {
  return ask(request, waiter_, SteadyClock::now() + patience_);
}

BoardAnswer BoardRequests::ask(const std::string& request, const Waiter& waiter,
                               Deadline deadline) {
  asked_at_ = SteadyClock::now();
  try {
    connection_.send(request, waiter, deadline);
    const std::string line = connection_.receive(waiter, deadline);
    note_answer();
    return {request, line};
  } catch (const YarpError& error) {
    const std::string what = error.what();
    const bool names_it = what.find(in_quotes(request)) != std::string::npos;
    throw YarpError(names_it ? what : what + ", asked " + in_quotes(request), error.kind());
  }
}

void BoardRequests::note_answer() {
  round_trip_us_ =
      std::chrono::duration_cast<std::chrono::microseconds>(SteadyClock::now() - *asked_at_)
          .count();
  asked_at_.reset();
}

}  // namespace puck
