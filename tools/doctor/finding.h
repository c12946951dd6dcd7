#pragma once

#include <string>
#include <vector>

namespace puck {

enum class Verdict {
  kOk,
  kNote,   ///< For information; no message is lost by it.
  kWrong,  ///< Loses messages, or will.
};

/// A check's finding.
struct Finding {
  Verdict verdict = Verdict::kOk;
  std::string check;   ///< Its name: route, ttl, …
  std::string text;    ///< For people, a line or two.
  std::string mend{};  ///< A command that repairs it, or may; empty: none is known.
};

using Findings = std::vector<Finding>;

}  // namespace puck
