#include "services/launch/run_service.h"
#include "services/tracker/tracker_service.h"

int main(int argc, char** argv) {
  return puck::run_service<puck::TrackerService>(
      {.name = "puck-tracker", .description = "Tracks the puck in the events of a camera."}, argc,
      argv);
}
