#include "services/bridge/bridge_service.h"
#include "services/launch/run_service.h"

int main(int argc, char** argv) {
  return puck::run_service<puck::BridgeService>(
      {.name = "puck-bridge",
       .description = "From the tracker's estimates to the puck's motion on the table, the game, "
                      "and commands for the arm."},
      argc, argv);
}
