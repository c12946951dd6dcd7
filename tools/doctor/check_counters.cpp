#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"

namespace puck {
namespace {

constexpr const char* kLosses = "losses";

/// Reports a loss counter: a fault if it grew while listening, a note if it is not 0.
void look_at(Findings& findings, const std::string& what, std::int64_t before, std::int64_t after,
             const std::string& mend) {
  if (after > before) {
    findings.push_back({Verdict::kWrong, kLosses,
                        what + ": " + std::to_string(after - before) + " more while listening, " +
                            std::to_string(after) + " in all",
                        mend});
  } else if (after > 0) {
    findings.push_back({Verdict::kNote, kLosses,
                        what + ": " + std::to_string(after) + " in all, none while listening"});
  }
}

}  // namespace

Findings check_counters(const Facts& facts) {
  if (!facts.before || !facts.after) {
    return {{Verdict::kNote, kLosses, "not checked: the kernel's counters cannot be read"}};
  }
  constexpr int kLargerBuffer = 16 << 20;
  Findings findings;
  look_at(findings, "IP datagrams with a missing fragment", facts.before->reassembly_failures,
          facts.after->reassembly_failures, "puck-camera --set camera.packet_bytes=1472");
  look_at(findings, "UDP datagrams dropped at a full receive buffer",
          facts.before->buffer_overflows, facts.after->buffer_overflows,
          as_root(facts, {"sysctl -w net.core.rmem_max=" + std::to_string(kLargerBuffer)}));
  look_at(findings, "UDP datagrams with a bad checksum", facts.before->checksum_errors,
          facts.after->checksum_errors, "");
  if (findings.empty()) {
    findings.push_back(
        {Verdict::kOk, kLosses, "no fragment lost, no receive buffer full, no checksum wrong"});
  }
  return findings;
}

}  // namespace puck
