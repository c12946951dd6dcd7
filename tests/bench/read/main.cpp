// Reads a recording once, as every tool does: prints its events and the seconds of CPU time.
#include <cstdio>
#include <ctime>
#include <exception>

#include "common/io/event_reader.h"

namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: puck-bench-read RECORDING\n");
    return 2;
  }
  // As many as the converter asks for at once.
  constexpr std::size_t kPacketEvents = 16384;
  try {
    const double start = cpu_seconds();
    const auto events = puck::open_event_file(argv[1]);
    puck::EventPacket packet;
    while (events->read(packet, kPacketEvents)) {
    }
    std::printf("%lld %.6f\n", static_cast<long long>(events->counters().events),
                cpu_seconds() - start);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-bench-read: %s\n", error.what());
    return 1;
  }
  return 0;
}
