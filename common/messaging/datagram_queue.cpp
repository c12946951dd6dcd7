#include "common/messaging/datagram_queue.h"

#include <algorithm>
#include <cstring>
#include <ctime>

#include <arpa/inet.h>
#include <sys/socket.h>

namespace puck {
namespace {

// Space for the kernel's time stamp.
struct alignas(cmsghdr) Control {
  std::array<char, CMSG_SPACE(sizeof(timespec))> bytes{};
};

std::int64_t stamp_utime(msghdr& message) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr;
       part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_TIMESTAMPNS) continue;
    timespec stamp{};
    std::memcpy(&stamp, CMSG_DATA(part), sizeof stamp);
    return static_cast<std::int64_t>(stamp.tv_sec) * 1'000'000 + stamp.tv_nsec / 1000;
  }
  return 0;
}

}  // namespace

DatagramQueue::DatagramQueue(std::size_t capacity)
    : capacity_(capacity),
      memory_(std::make_unique_for_overwrite<std::uint8_t[]>(capacity * kSlotBytes)),
      slots_(std::make_unique<Slot[]>(capacity)) {}

DatagramQueue::Entry DatagramQueue::front() const {
  const Slot& slot = slots_[first_];
  return {{bytes_of(first_), slot.size},
          {ntohl(slot.sender.sin_addr.s_addr), ntohs(slot.sender.sin_port)},
          slot.utime};
}

std::size_t DatagramQueue::fill(int socket) {
  if (is_empty()) first_ = end_ = 0;
  std::array<mmsghdr, kAtOnce> headers{};
  std::array<iovec, kAtOnce> vectors{};
  std::array<Control, kAtOnce> controls;
  const std::size_t room = std::min(capacity_ - end_, kAtOnce);
  for (std::size_t i = 0; i < room; ++i) {
    vectors[i] = {bytes_of(end_ + i), kSlotBytes};
    msghdr& header = headers[i].msg_hdr;
    header.msg_name = &slots_[end_ + i].sender;
    header.msg_namelen = sizeof(sockaddr_in);
    header.msg_iov = &vectors[i];
    header.msg_iovlen = 1;
    header.msg_control = controls[i].bytes.data();
    header.msg_controllen = controls[i].bytes.size();
  }
  const int taken = room == 0 ? 0
                              : recvmmsg(socket, headers.data(), static_cast<unsigned>(room),
                                         MSG_DONTWAIT, nullptr);
  for (int i = 0; i < taken; ++i) {
    Slot& slot = slots_[end_++];
    slot.size = headers[static_cast<std::size_t>(i)].msg_len;
    slot.utime = stamp_utime(headers[static_cast<std::size_t>(i)].msg_hdr);
  }
  return static_cast<std::size_t>(std::max(taken, 0));
}

}  // namespace puck
