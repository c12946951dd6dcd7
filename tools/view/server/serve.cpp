#include "tools/view/server/serve.h"

#include <cstdio>
#include <utility>
#include <vector>

#include <sys/resource.h>

#include "common/messaging/network_interfaces.h"
#include "tools/view/server/view_pages.h"

namespace puck {
namespace {

/// The addresses that a browser can open.
std::vector<ListenAddress> reachable(const ListenAddress& listen) {
  if (listen.address != "0.0.0.0" && listen.address != "::") return {listen};
  std::vector<ListenAddress> found;
  for (const NetworkInterface& interface : list_network_interfaces()) {
    if (interface.is_loopback || !interface.is_up) continue;
    for (const std::string& address : interface.addresses) found.push_back({address, listen.port});
  }
  if (found.empty()) found.push_back({"127.0.0.1", listen.port});
  return found;
}

/// Drawing gives way to a tracker on the same machine. For this thread and those that it makes.
void yield_to_services() {
  constexpr int kNice = 10;
  setpriority(PRIO_PROCESS, 0, kNice);
}

}  // namespace

void serve(ViewSource& source, const std::string& listen) {
  HttpServerParams params{.listen = parse_listen_address(listen)};
  PageFiles files(page_folder());
  HttpServer server(params);
  params.listen.port = server.port();
  const std::string token = params.listen.is_loopback() ? "" : random_token();
  ViewPages pages(source, std::move(files), RequestGate(token, server.port()));
  for (const ListenAddress& address : reachable(params.listen)) {
    std::printf("open http://%s/%s\n", to_string(address).c_str(),
                token.empty() ? "" : ("?token=" + token).c_str());
  }
  std::fflush(stdout);
  yield_to_services();
  server.run(pages);
}

}  // namespace puck
