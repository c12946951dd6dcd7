#include "services/launch/line_writer.h"

#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <mutex>
#include <string_view>
#include <utility>

#include <poll.h>
#include <unistd.h>

namespace puck {
namespace {

void write_whole(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count >= 0) {
      text.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {
      pollfd room{descriptor, POLLOUT, 0};
      poll(&room, 1, -1);
    } else if (errno != EINTR) {
      return;
    }
  }
}

}  // namespace

struct LineWriter::Lines {
  std::mutex mutex;
  std::condition_variable changed;
  // Guarded by mutex.
  std::deque<std::string> waiting;
  std::size_t lost = 0;
  bool is_ending = false;
  bool has_ended = false;
};

LineWriter::LineWriter(int descriptor)
    : lines_(std::make_shared<Lines>()),
      thread_([lines = lines_, descriptor] { write_lines(*lines, descriptor); }) {}

LineWriter::~LineWriter() {
  std::unique_lock lock(lines_->mutex);
  lines_->is_ending = true;
  lines_->changed.notify_all();
  const bool has_ended =
      lines_->changed.wait_for(lock, kPatience, [&] { return lines_->has_ended; });
  lines_->waiting.clear();
  lock.unlock();
  // A thread that hangs in write() cannot be interrupted.
  if (has_ended) {
    thread_.join();
  } else {
    thread_.detach();
  }
}

void LineWriter::put(std::string line) {
  const std::lock_guard lock(lines_->mutex);
  if (lines_->waiting.size() == kMostLines) {
    lines_->waiting.pop_front();
    ++lines_->lost;
  }
  lines_->waiting.push_back(std::move(line));
  lines_->changed.notify_all();
}

std::size_t LineWriter::lost() const {
  const std::lock_guard lock(lines_->mutex);
  return lines_->lost;
}

void LineWriter::write_lines(Lines& lines, int descriptor) {
  // A closed pipe must not end the service.
  sigset_t broken_pipe;
  sigemptyset(&broken_pipe);
  sigaddset(&broken_pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &broken_pipe, nullptr);

  std::unique_lock lock(lines.mutex);
  for (;;) {
    lines.changed.wait(lock, [&] { return lines.is_ending || !lines.waiting.empty(); });
    if (lines.waiting.empty()) break;
    const std::string line = std::move(lines.waiting.front());
    lines.waiting.pop_front();
    lock.unlock();
    write_whole(descriptor, line);
    lock.lock();
  }
  lines.has_ended = true;
  lines.changed.notify_all();
}

}  // namespace puck
