#include "services/arm/back_end.h"

#include <stdexcept>

namespace puck {

std::unique_ptr<ArmBackEnd> make_back_end(const BackEndParams& params,
                                          const ArmControllerParams& /*controller*/,
                                          bool authenticated) {
  if (params.name == "simulated") return nullptr;
  if (!authenticated && !params.allow_unauthenticated) {
    throw std::invalid_argument(
        "arm.back_end \"yarp\" moves a real arm: give lcm.key_file, so that only those who have "
        "the "
        "key move it, or set arm.allow_unauthenticated = true");
  }
  throw std::invalid_argument("arm.back_end \"" + params.name + "\" is not part of this build");
}

}  // namespace puck
