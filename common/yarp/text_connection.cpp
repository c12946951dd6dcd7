#include "common/yarp/text_connection.h"

#include <array>

#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

constexpr std::size_t kTextPieceBytes = 1024;

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

TextConnection::TextConnection(const PortAddress& address, std::string_view local_name,
                               const Waiter& waiter, Deadline deadline)
    : socket_(address, waiter, deadline) {
  socket_.send(bytes_of("CONNECT " + std::string(local_name) + "\n"), waiter, deadline);
  const std::string answer = receive(waiter, deadline);
  if (!answer.starts_with("Welcome ")) {
    throw YarpError("it greets with " + in_quotes(answer) + " instead of Welcome");
  }
}

void TextConnection::send(std::string_view request, const Waiter& waiter, Deadline deadline) {
  socket_.send(bytes_of("d\n" + std::string(request) + "\n"), waiter, deadline);
}

std::string TextConnection::receive(const Waiter& waiter, Deadline deadline) {
  while (true) {
    if (auto line = lines_.next()) return *line;
    std::array<std::uint8_t, kTextPieceBytes> piece;
    const std::size_t count = socket_.receive(piece, waiter, deadline);
    lines_.feed(std::span(piece).first(count));
  }
}

std::optional<std::string> TextConnection::receive_now() {
  if (auto line = lines_.next()) return line;
  std::array<std::uint8_t, kTextPieceBytes> piece;
  const std::size_t count = socket_.receive_now(piece);
  lines_.feed(std::span(piece).first(count));
  return lines_.next();
}

}  // namespace puck
