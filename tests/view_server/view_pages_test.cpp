#include "tools/view/server/view_pages.h"

#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "tests/support/temporary_folder.h"
#include "tools/view/live/live_source.h"
#include "tools/view/server/url_query.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

/// Pages of a bus on which nothing happens.
struct Pages {
  explicit Pages(const std::string& token = {})
      : pages(source, files(folder.path()), RequestGate(token, 8080)) {}

  static PageFiles files(const std::filesystem::path& folder) {
    std::ofstream(folder / "index.html") << "<!doctype html>";
    std::ofstream(folder / "main.js") << "1;";
    std::ofstream(folder / "secret.toml") << "key = 1";
    return PageFiles(folder);
  }

  static HttpRequest get(const std::string& target) {
    const UrlTarget url = split_target(target);
    return {.method = HttpRequest::Method::kGet,
            .path = url.path,
            .query = url.query,
            .host = "127.0.0.1:8080"};
  }
  static HttpRequest post(const std::string& body) {
    HttpRequest request = get("/control");
    request.method = HttpRequest::Method::kPost;
    request.content_type = "application/json";
    request.body = body;
    return request;
  }

  int status(const HttpRequest& request) { return pages.answer(request, {}).value().status; }

  TemporaryFolder folder;
  LiveSource source{{.bus = {.url = "memq://"}}};
  ViewPages pages;
};

std::string header_of(const HttpReply& reply, const std::string& name) {
  for (const auto& [key, value] : reply.headers) {
    if (key == name) return value;
  }
  return {};
}

}  // namespace

TEST_CASE("only the page's own files are served") {
  Pages pages;
  CHECK(pages.status(Pages::get("/")) == 200);
  CHECK(pages.status(Pages::get("/index.html")) == 200);
  const HttpReply script = pages.pages.answer(Pages::get("/main.js"), {}).value();
  CHECK(script.content_type == "text/javascript; charset=utf-8");
  for (const std::string path : {"/secret.toml", "/../index.html", "/../../etc/passwd", "//main.js",
                                 "main.js", "/main.js/", "/%2e%2e/etc/passwd", ""}) {
    CAPTURE(path);
    CHECK(pages.status(Pages::get(path)) == 404);
  }
}

TEST_CASE("a folder without the page is told with its path") {
  const TemporaryFolder empty;
  CHECK_THROWS_WITH_AS(PageFiles{empty.path()}, doctest::Contains("expected index.html in"),
                       std::runtime_error);
}

TEST_CASE("a picture is waited for at most a second") {
  Pages pages;
  CHECK_FALSE(pages.pages.answer(Pages::get("/picture"), milliseconds(900)));
  CHECK(pages.pages.answer(Pages::get("/picture"), milliseconds(1000)).value().status == 204);
}

TEST_CASE("each path has its method, and a control its type") {
  Pages pages;
  CHECK(pages.status(Pages::get("/control")) == 405);
  HttpRequest state = Pages::post("");
  state.path = "/state";
  CHECK(pages.status(state) == 405);
  CHECK(pages.status(HttpRequest{.host = "localhost"}) == 405);
  HttpRequest form = Pages::post(R"({"action": "pause"})");
  form.content_type = "text/plain";
  CHECK(pages.status(form) == 415);
  CHECK(pages.status(Pages::post("{}")) == 400);
  const HttpReply reply = pages.pages.answer(Pages::post(R"({"action": "pause"})"), {}).value();
  CHECK(reply.status == 200);
  CHECK(reply.body->find("a live camera cannot be paused") != std::string::npos);
}

TEST_CASE("foreign host names and origins are refused") {
  Pages pages;
  HttpRequest request = Pages::get("/state");
  for (const std::string host :
       {"localhost", "LOCALHOST:9", "127.0.0.1", "[::1]:8080", "10.0.0.7:1"}) {
    request.host = host;
    CAPTURE(host);
    CHECK(pages.status(request) == 200);
  }
  for (const std::string host : {"evil.example", "localhost.evil.example:8080",
                                 "127.0.0.1.evil.example", "", "[::1", "127.0.0.1@evil.example"}) {
    request.host = host;
    CAPTURE(host);
    CHECK(pages.status(request) == 403);
  }
  request.host.reset();
  CHECK(pages.status(request) == 400);
  request.host = "localhost:8080";
  request.origin = "http://localhost:8080";
  CHECK(pages.status(request) == 200);
  for (const std::string origin :
       {"http://evil.example", "null", "http://localhost:8081", "https://localhost:8080", ""}) {
    request.origin = origin;
    CAPTURE(origin);
    CHECK(pages.status(request) == 403);
  }
}

TEST_CASE("with a token, only who knows it is answered") {
  const std::string token = random_token();
  CHECK(token.size() == 32);
  CHECK(token != random_token());
  Pages pages(token);
  for (const std::string target : {"/", "/state", "/picture", "/main.js",
                                   "/?token=", "/?token=0123456789abcdef0123456789abcdef"}) {
    CAPTURE(target);
    CHECK(pages.status(Pages::get(target)) == 403);
  }
  CHECK(pages.status(Pages::post(R"({"action": "pause"})")) == 403);

  const HttpReply page = pages.pages.answer(Pages::get("/?token=" + token), {}).value();
  CHECK(page.status == 200);
  const std::string cookie = header_of(page, "Set-Cookie");
  CHECK(cookie.find("HttpOnly") != std::string::npos);
  CHECK(cookie.find("SameSite=Strict") != std::string::npos);
  HttpRequest next = Pages::get("/state");
  next.cookies = "other=1; " + cookie.substr(0, cookie.find(';'));
  CHECK(pages.status(next) == 200);
  next.cookies = "puck_view_9999=" + token;
  CHECK(pages.status(next) == 403);
}

TEST_CASE("every reply forbids content from elsewhere") {
  Pages pages;
  for (const std::string target : {"/", "/state", "/nothing"}) {
    const HttpReply reply = pages.pages.answer(Pages::get(target), {}).value();
    CHECK(header_of(reply, "Content-Security-Policy").starts_with("default-src 'none'"));
    CHECK(header_of(reply, "X-Content-Type-Options") == "nosniff");
  }
}

}  // namespace puck
