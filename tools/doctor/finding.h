#pragma once

#include <string>
#include <vector>

namespace puck {

enum class Verdict {
  kOk,
  kNote,   ///< Worth knowing; nothing arrives less for it.
  kWrong,  ///< Keeps messages from arriving, or will.
};

/// What one check found.
struct Finding {
  Verdict verdict = Verdict::kOk;
  std::string check;   ///< Its name: route, ttl, …
  std::string text;    ///< For a person, a line or two.
  std::string mend{};  ///< The command that mends it, or may; empty: there is none to give.
};

using Findings = std::vector<Finding>;

}  // namespace puck
