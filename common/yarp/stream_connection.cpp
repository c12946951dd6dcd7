#include "common/yarp/stream_connection.h"

#include <array>

namespace puck {
namespace {

constexpr std::size_t kPieceBytes = 16384;

}  // namespace

StreamConnection::StreamConnection(const PortAddress& address, std::string_view local_name,
                                   const Waiter& waiter, Deadline deadline, std::size_t most_bytes)
    : socket_(address, waiter, deadline), messages_(most_bytes) {
  socket_.send(hello(local_name), waiter, deadline);
  std::array<std::uint8_t, kHelloAnswerBytes> answer{};
  for (std::size_t at = 0; at < answer.size();) {
    at += socket_.receive(std::span(answer).subspan(at), waiter, deadline);
  }
  check_hello_answer(answer);
}

void StreamConnection::turn_round(const Waiter& waiter, Deadline deadline) {
  Bytes message;
  append_message(PortCommand::kTurnRound, {}, message);
  socket_.send(message, waiter, deadline);
}

std::span<const std::uint8_t> StreamConnection::receive(const Waiter& waiter, Deadline deadline) {
  while (true) {
    if (const auto message = messages_.next()) return *message;
    std::array<std::uint8_t, kPieceBytes> piece;
    const std::size_t count = socket_.receive(piece, waiter, deadline);
    messages_.feed(std::span(piece).first(count));
  }
}

std::optional<std::span<const std::uint8_t>> StreamConnection::receive_now() {
  while (true) {
    if (const auto message = messages_.next()) return message;
    std::array<std::uint8_t, kPieceBytes> piece;
    const std::size_t count = socket_.receive_now(piece);
    if (count == 0) return std::nullopt;
    messages_.feed(std::span(piece).first(count));
  }
}

void StreamConnection::send(std::span<const std::uint8_t> payload) {
  append_message(PortCommand::kData, payload, unsent_);
  attend();
}

void StreamConnection::attend() {
  if (!unsent_.empty()) {
    const std::size_t sent = socket_.send_now(unsent_);
    unsent_.erase(unsent_.begin(), unsent_.begin() + static_cast<std::ptrdiff_t>(sent));
  }
  // The port sends nothing; a read only detects a closed connection.
  std::array<std::uint8_t, kPieceBytes> piece;
  socket_.receive_now(piece);
}

}  // namespace puck
