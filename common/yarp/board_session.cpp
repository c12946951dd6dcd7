#include "common/yarp/board_session.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <string>

#include "common/yarp/set_point_message.h"
#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

std::int64_t monotonic_us(SteadyClock::time_point time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
}

std::int64_t now_us() { return monotonic_us(SteadyClock::now()); }

}  // namespace

BoardSession::BoardSession(const YarpParams& params, const PortAddress& name_server,
                           const Waiter& waiter, BoardExchange& exchange)
    : BoardSession(params, find_board_ports(params, name_server, waiter), waiter, exchange) {}

BoardSession::BoardSession(const YarpParams& params, const BoardPorts& ports, const Waiter& waiter,
                           BoardExchange& exchange)
    : params_(params),
      waiter_(waiter),
      exchange_(exchange),
      requests_(at_port(params.port_name("rpc:i"),
                        [&] {
                          return BoardRequests(ports.requests, params.local_name, waiter,
                                               milliseconds(params.answer_timeout_ms),
                                               in_ms(params.connect_timeout_ms));
                        })),
      state_(at_port(params.port_name("state:o"),
                     [&] {
                       return StreamConnection(ports.state, params.local_name, waiter,
                                               in_ms(params.connect_timeout_ms));
                     })),
      command_(at_port(params.port_name("command:i"),
                       [&] {
                         return StreamConnection(ports.command, params.local_name, waiter,
                                                 in_ms(params.connect_timeout_ms));
                       })),
      joints_(at_port(params.port_name("rpc:i"), [&] { return find_joints(params, requests_); })),
      hold_(at_port(params.port_name("rpc:i"),
                    [&] { return JointHold(params, joints_, requests_); })),
      gate_(params) {
  at_port(params_.port_name("state:o"), [&] { begin_to_receive(); });
}

void BoardSession::begin_to_receive() {
  const Deadline deadline = in_ms(params_.answer_timeout_ms);
  state_.turn_round(waiter_, deadline);
  reading_ = take_state(state_.receive(waiter_, deadline));
}

void BoardSession::run() {
  received_at_ = stamp_moved_at_ = command_free_at_ = SteadyClock::now();
  at_port(params_.port_name("state:o"), [&] { wait_for_fresh_encoders(); });
  exchange_.begin_connection(reading_);
  while (!waiter_.is_stopped()) {
    at_port(params_.port_name("state:o"), [&] { receive_encoders(); });
    // The modes first: no set-point is sent once they are known to have changed.
    at_port(params_.port_name("rpc:i"), [&] { attend_hold(); });
    at_port(params_.port_name("command:i"), [&] { send_set_point(); });
    wait_for_more();
  }
}

// Queued encoders are outdated, and a board whose stamp does not advance is unusable.
void BoardSession::wait_for_fresh_encoders() {
  const Deadline deadline = in_ms(params_.answer_timeout_ms);
  while (const auto message = state_.receive_now()) {
    take_state(*message);
    if (SteadyClock::now() >= deadline) throw YarpError("it sends encoders without a pause");
  }
  const double before_s = stamp_->time_s;
  bool is_sending = false;
  while (stamp_->time_s == before_s) {
    if (const auto message = state_.receive_now()) {
      reading_ = take_state(*message);
      is_sending = true;
    } else {
      waiter_.wait_for(state_.descriptor(), POLLIN, deadline);
    }
    if (SteadyClock::now() >= deadline) {
      throw YarpError(is_sending ? "its stamp stands still" : "no encoders in time");
    }
  }
}

void BoardSession::receive_encoders() {
  // More than a board sends in a second; the rest waits for the next cycle.
  constexpr int kMostAtOnce = 64;
  for (int i = 0; i < kMostAtOnce; ++i) {
    const auto message = state_.receive_now();
    if (!message) break;
    reading_ = take_state(*message);
    exchange_.put_encoders(reading_);
  }
  check_silence();
}

JointReading BoardSession::take_state(std::span<const std::uint8_t> message) {
  const StateMessage state = parse_state_message(message);
  if (state.encoders_deg.size() != joints_.axes) {
    throw YarpError("it sent the encoders of " + std::to_string(state.encoders_deg.size()) +
                        " joints: there were " + std::to_string(joints_.axes),
                    YarpError::Kind::kNeedsPerson);
  }
  received_at_ = SteadyClock::now();
  // The count advances even while the board reads no new encoders; the time does not.
  if (!stamp_ || state.stamp.time_s != stamp_->time_s) stamp_moved_at_ = received_at_;
  stamp_ = state.stamp;
  JointReading reading{.received_us = monotonic_us(received_at_)};
  std::array<double, JointAngles::kMost> deg{};
  for (std::size_t i = 0; i < params_.joints.size(); ++i) {
    deg[i] = state.encoders_deg[static_cast<std::size_t>(params_.joints[i])];
  }
  reading.position = JointAngles(std::span(deg).first(params_.joints.size()));
  return reading;
}

void BoardSession::check_silence() const {
  const Deadline now = SteadyClock::now();
  const milliseconds patience(params_.silent_ms);
  const std::string for_ms = " for " + std::to_string(params_.silent_ms) + " ms";
  if (now - received_at_ > patience) throw YarpError("no encoders" + for_ms);
  if (now - stamp_moved_at_ > patience) throw YarpError("its stamp stands still" + for_ms);
}

// The modes change slowly, with new encoders and set-points meanwhile. The newest set-point must
// begin at the encoders received after the joints were taken.
void BoardSession::begin_to_take() {
  const auto first = exchange_.newest_set_point(now_us());
  if (!first) return;
  const std::string refusal = gate_.refusal(*first, reading_.position);
  gate_.restart();
  if (!refusal.empty()) return exchange_.refuse_set_point(refusal);
  hold_.begin_to_take();
}

void BoardSession::send_set_point() {
  command_.attend();
  if (!command_.is_free()) {
    if (SteadyClock::now() - command_free_at_ <= milliseconds(params_.silent_ms)) return;
    throw YarpError("it takes no set-points for " + std::to_string(params_.silent_ms) + " ms");
  }
  command_free_at_ = SteadyClock::now();
  if (hold_.state() == JointHold::State::kNone) begin_to_take();
  if (hold_.state() != JointHold::State::kTaken || received_at_ <= hold_.taken_at()) return;
  const auto set_point = exchange_.take_set_point(now_us());
  if (!set_point) return;
  const std::string refusal = gate_.refusal(*set_point, reading_.position);
  if (!refusal.empty()) return exchange_.refuse_set_point(refusal);
  command_.send(params_.joints.size() == joints_.axes
                    ? set_points_of_all(set_point->deg())
                    : set_points_of_some(params_.joints, set_point->deg()));
  exchange_.count_sent();
}

void BoardSession::attend_hold() {
  const bool is_wanted = exchange_.newest_set_point(now_us()).has_value();
  if (hold_.attend(is_wanted)) exchange_.put_round_trip(requests_.round_trip_us());
  if (hold_.state() == JointHold::State::kTaken) exchange_.put_hold();
}

void BoardSession::wait_for_more() const {
  const milliseconds patience(params_.silent_ms);
  const short command_events = command_.is_free() ? POLLIN : POLLIN | POLLOUT;
  const std::array sockets{pollfd{state_.descriptor(), POLLIN, 0},
                           pollfd{command_.descriptor(), command_events, 0},
                           pollfd{requests_.descriptor(), POLLIN, 0}};
  Deadline next = std::min({received_at_ + patience, stamp_moved_at_ + patience, hold_.next_at()});
  if (!command_.is_free()) next = std::min(next, command_free_at_ + patience);
  waiter_.wait(sockets, next);
}

}  // namespace puck
