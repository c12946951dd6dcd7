#include <cstdio>
#include <exception>

#include "tools/view/live/live_source.h"
#include "tools/view/server/serve.h"

int main(int argc, char** argv) {
  try {
    puck::BusParams params;
    if (argc > 2) params.url = argv[2];
    puck::LiveSource source({.bus = params});
    puck::serve(source, argc > 1 ? argv[1] : "127.0.0.1:8080");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "puck-view: %s\n", error.what());
    return 1;
  }
}
