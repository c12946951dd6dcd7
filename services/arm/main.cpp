#include "services/arm/arm_service.h"
#include "services/arm/operator_command.h"
#include "services/launch/run_service.h"

int main(int argc, char** argv) {
  puck::OperatorCommand by_hand;
  return puck::run_service<puck::ArmService>(
      {.name = "puck-arm",
       .description = "Moves the robot's mallet while commands are fresh and the track is "
                      "live; otherwise holds still.",
       .add_options = [&](CLI::App& app) { by_hand.add_options(app); },
       .instead = [&](const puck::BusParams& params,
                      std::stop_token stop) { return by_hand.run(params, stop); }},
      argc, argv);
}
