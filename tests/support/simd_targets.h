#pragma once

#include <string>

#include <hwy/targets.h>

namespace puck {

/// Calls `test(name)` once for each compiled instruction set that this machine has, with that one
/// forced.
template <typename Test>
void with_each_simd_target(Test&& test) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    test(std::string(hwy::TargetName(target)));
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace puck
