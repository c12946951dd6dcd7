#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kBuffer = "buffer";

}  // namespace

Findings check_buffer(const Facts& facts) {
  if (!facts.buffer_bytes) {
    return {{Verdict::kNote, kBuffer, "not checked: no socket could be opened"}};
  }
  const std::string given = std::to_string(*facts.buffer_bytes) + " bytes of receive buffer";
  if (!facts.url.recv_buf_size) {
    LcmUrl larger = facts.url;
    larger.recv_buf_size = parse_lcm_url(kDefaultLcmUrl).recv_buf_size;
    return {{Verdict::kNote, kBuffer,
             "the URL asks for no receive buffer, so the kernel gives " +
                 std::to_string(*facts.buffer_bytes) + " bytes; bursts need more",
             lcm_url_option(larger)}};
  }
  const int asked = *facts.url.recv_buf_size;
  if (*facts.buffer_bytes >= asked)
    return {{Verdict::kOk, kBuffer, "the kernel gives the " + given}};
  std::string text = "the URL asks for " + std::to_string(asked) + ", the kernel gives " + given;
  if (facts.rmem_max_bytes) {
    text += " (net.core.rmem_max=" + std::to_string(*facts.rmem_max_bytes) + ")";
  }
  return {{Verdict::kWrong, kBuffer,
           text + ": bursts are lost. In a container, this has to be done on the host:",
           as_root(facts, {"sysctl -w net.core.rmem_max=" + std::to_string(asked)})}};
}

}  // namespace puck
