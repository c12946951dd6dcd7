#include "services/bridge/bridge_service.h"
#include "services/launch/run_service.h"

int main(int argc, char** argv) {
  return puck::run_service<puck::BridgeService>(
      {.name = "puck-bridge",
       .description = "Predicts the puck's motion on the table from the tracker's estimates, "
                      "and commands the arm."},
      argc, argv);
}
