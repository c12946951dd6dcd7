#pragma once

#include "tools/view/interface/view_source.h"
#include "tools/view/server/http_server.h"
#include "tools/view/server/page_files.h"
#include "tools/view/server/picture_desk.h"
#include "tools/view/server/request_gate.h"

namespace puck {

/// Answers the page's requests:
/// - `GET /picture?…&seen=VERSION`: the newest picture (picture_query.h) as soon as its version
///   differs, else 204 after a second; the header Puck-Version has its version.
/// - `GET /state?since_us=T&run=R`, `GET /timeline`: JSON (state_json.h).
/// - `POST /control`: a JSON object (control_json.h); the reply's `problem` is empty on success.
/// - `GET` of the page's files.
/// Safe from any thread.
class ViewPages : public HttpHandler {
 public:
  /// `source` must live longer.
  ViewPages(ViewSource& source, PageFiles files, RequestGate gate);

  std::optional<HttpReply> answer(const HttpRequest& request,
                                  std::chrono::milliseconds waited) override;

 private:
  std::optional<HttpReply> route(const HttpRequest& request, std::chrono::milliseconds waited);
  std::optional<HttpReply> picture(const HttpRequest& request, std::chrono::milliseconds waited);
  HttpReply control(const HttpRequest& request);
  HttpReply file(const HttpRequest& request) const;

  ViewSource& source_;
  PageFiles files_;
  RequestGate gate_;
  PictureDesk desk_;
};

}  // namespace puck
