#include "services/launch/run_service.h"
#include "services/logger/logger_service.h"

int main(int argc, char** argv) {
  return puck::run_service<puck::LoggerService>(
      {.name = "puck-logger", .description = "Writes every channel to an LCM log."}, argc, argv);
}
