#include "tools/view/server/http_server.h"

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <unistd.h>

#include "tests/support/process_usage.h"
#include "tests/support/wait_until.h"
#include "tests/view_server/raw_client.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

/// Answers with the path and the body; `/large` with much, `/held` after a time, `/never` and
/// `/throws` not.
class Echo : public HttpHandler {
 public:
  static constexpr std::size_t kLarge = 4 << 20;

  std::optional<HttpReply> answer(const HttpRequest& request, milliseconds waited) override {
    ++asked;
    if (request.path == "/throws") throw std::runtime_error("no such thing");
    if (request.path == "/never") return std::nullopt;
    if (request.path == "/held" && waited < milliseconds(50)) return std::nullopt;
    if (request.path == "/large") return HttpReply{.body = large_};
    return text_reply(200, request.path + ' ' + request.body);
  }

  std::atomic<int> asked{0};

 private:
  std::shared_ptr<const std::string> large_ = std::make_shared<const std::string>(kLarge, 'x');
};

struct Served {
  explicit Served(HttpServerParams params = {}) : server(with_any_port(params)) {
    thread = std::jthread([this] { server.run(echo); });
  }
  ~Served() { server.stop(); }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  static HttpServerParams with_any_port(HttpServerParams params) {
    params.listen.port = 0;
    params.stop_on_signals = false;
    return params;
  }
  std::string ask(const std::string& bytes) {
    RawClient client(server.port());
    client.send(bytes);
    return client.receive();
  }

  Echo echo;
  HttpServer server;
  std::jthread thread;
};

std::string get(const std::string& path, const std::string& more = "Connection: close\r\n") {
  return "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n" + more + "\r\n";
}

}  // namespace

TEST_CASE("a connection serves one request after the other") {
  Served served;
  RawClient client(served.server.port());
  for (const std::string path : {"/one", "/two", "/three"}) {
    client.send(get(path, ""));
    const std::string reply = client.receive(path + " \n");
    CHECK(reply.starts_with("HTTP/1.1 200 "));
    CHECK(reply.find("\r\n\r\n" + path) != std::string::npos);
  }
}

TEST_CASE("a request without news is asked again until there is some") {
  Served served;
  CHECK(served.ask(get("/held")).find("/held") != std::string::npos);
  CHECK(served.echo.asked > 2);
}

TEST_CASE("a waiting request whose browser has given up frees its place") {
  Served served({.most_connections = 2});
  for (int i = 0; i < 5; ++i) {
    RawClient first(served.server.port());
    first.send(get("/never"));
    RawClient second(served.server.port());
    second.send(get("/never"));
  }
  CHECK(wait_until([&] { return served.ask(get("/after")).starts_with("HTTP/1.1 200 "); }));
}

TEST_CASE("an exception of a handler becomes a reply") {
  Served served;
  const std::string reply = served.ask(get("/throws"));
  CHECK(reply.starts_with("HTTP/1.1 500 "));
  CHECK(reply.find("no such thing") != std::string::npos);
  CHECK(served.ask(get("/after")).starts_with("HTTP/1.1 200 "));
}

TEST_CASE("headers and bodies above the limits are refused, and the connection ends") {
  Served served;
  const std::string long_line(2 * HttpServer::kMostHeaderBytes, 'a');
  CHECK(served.ask(get("/" + long_line)).starts_with("HTTP/1.1 431 "));
  CHECK(served.ask(get("/", "Cookie: " + long_line + "\r\n")).starts_with("HTTP/1.1 431 "));
  const std::string head = "POST /x HTTP/1.1\r\nHost: a\r\n";
  CHECK(served.ask(head + "Content-Length: 4097\r\n\r\n").starts_with("HTTP/1.1 413 "));
  CHECK(served.ask(head + "Content-Length: 99999999999999999999\r\n\r\n")
            .starts_with("HTTP/1.1 400 "));
  const std::string chunk = "1000\r\n" + std::string(4096, 'b') + "\r\n";
  CHECK(served.ask(head + "Transfer-Encoding: chunked\r\n\r\n" + chunk + chunk)
            .starts_with("HTTP/1.1 413 "));
  CHECK(served.echo.asked == 0);
}

TEST_CASE("bytes that are no request get status 400") {
  Served served;
  for (const std::string bytes : {"\r\n\r\n\r\nhello\r\n\r\n", "GET / HTTP/9.9\r\n\r\n",
                                  "\x16\x03\x01\x02\x01\xfc\x03\r\n\r\n"}) {
    CHECK(served.ask(bytes).starts_with("HTTP/1.1 400 "));
  }
}

TEST_CASE("a connection that never finishes its request is closed") {
  Served served({.request_time = milliseconds(200)});
  RawClient client(served.server.port());
  client.send("GET / HTTP/1.1\r\nHo");
  CHECK(client.is_closed_within(milliseconds(10'000)));
}

TEST_CASE("peers that stop reading cost one reply between them, and are closed") {
  Served served({.most_connections = 16, .reply_time = milliseconds(500)});
  const double before_mb = resident_mb(getpid());
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 16; ++i) {
    clients.push_back(std::make_unique<RawClient>(served.server.port()));
    // All at once, of which the server takes one.
    for (int request = 0; request < 20; ++request) clients.back()->send(get("/large", ""));
  }
  std::this_thread::sleep_for(milliseconds(200));
  CHECK(resident_mb(getpid()) - before_mb < 16);
  CHECK(served.echo.asked == 16);
  for (auto& client : clients) {
    const bool is_closed = client->is_closed_within(milliseconds(10'000));
    CHECK(is_closed);
  }
}

TEST_CASE("a new connection replaces the one that is idle for longest") {
  Served served({.most_connections = 2});
  RawClient first(served.server.port());
  first.send(get("/a", ""));
  first.receive("/a \n");
  RawClient second(served.server.port());
  second.send(get("/b", ""));
  second.receive("/b \n");
  CHECK(served.ask(get("/c")).starts_with("HTTP/1.1 200 "));
  CHECK(first.is_closed_within(milliseconds(10'000)));
  second.send(get("/d", ""));
  CHECK(second.receive("/d \n").starts_with("HTTP/1.1 200 "));
}

TEST_CASE("a port in use is told with a remedy") {
  Served served;
  HttpServerParams params;
  params.listen.port = served.server.port();
  try {
    const HttpServer other(params);
    FAIL("it listens");
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    CHECK(text.find("127.0.0.1:" + std::to_string(params.listen.port)) != std::string::npos);
    CHECK(text.find("already in use") != std::string::npos);
    CHECK(text.find("--listen 127.0.0.1:0") != std::string::npos);
  }
}

TEST_CASE("an address of no interface is told with what was expected") {
  HttpServerParams params;
  params.listen = {"192.0.2.77", 8080};
  CHECK_THROWS_WITH_AS(HttpServer{params}, doctest::Contains("expected an address of this machine"),
                       std::runtime_error);
}

}  // namespace puck
