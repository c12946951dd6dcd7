#include "tools/view/server/http_server.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <exception>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/span_body.hpp>
#include <boost/beast/http/write.hpp>
#include <sys/socket.h>

#include "tools/view/server/http_parsing.h"

namespace puck {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::system::error_code;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using tcp = asio::ip::tcp;

constexpr milliseconds kAskAgain{4};
constexpr milliseconds kAcceptRetry{100};
constexpr std::size_t kAnsweringThreads = 2;

[[noreturn]] void refuse_to_listen(const ListenAddress& address, const error_code& error) {
  std::string text = "cannot listen on " + to_string(address) + ": " + error.message();
  if (error == asio::error::address_in_use) {
    ListenAddress other = address;
    other.port = 0;
    text += "; end the program that has the port, or take a free one: --listen " + to_string(other);
  } else if (error == asio::error::access_denied) {
    text += "; ports below 1024 belong to root: take a higher one";
  } else {
    text += "; expected an address of this machine (ip address), such as 127.0.0.1:8080";
  }
  throw std::runtime_error(text);
}

int status_of(const error_code& error) {
  if (error == http::error::header_limit) return 431;
  if (error == http::error::body_limit) return 413;
  return 400;
}

/// Whether the peer sent something that is not a request, rather than going away.
bool is_malformed(const error_code& error) {
  return error.category() == http::make_error_code(http::error::header_limit).category() &&
         error != http::error::end_of_stream && error != http::error::partial_message;
}

}  // namespace

/// The io thread owns all connections; the pool's threads only answer.
class HttpServer::Impl {
 public:
  explicit Impl(const HttpServerParams& params)
      : params_(params), acceptor_(io_), signals_(io_), retry_(io_) {
    error_code error;
    const tcp::endpoint endpoint(asio::ip::make_address(params.listen.address), params.listen.port);
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(static_cast<int>(params.most_connections), error);
    if (error) refuse_to_listen(params.listen, error);
    port_ = acceptor_.local_endpoint().port();
  }
  ~Impl() { stop(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::uint16_t port() const { return port_; }

  void run(HttpHandler& handler) {
    handler_ = &handler;
    if (params_.stop_on_signals) {
      for (const int signal : {SIGINT, SIGTERM, SIGHUP}) signals_.add(signal);
      signals_.async_wait([this](const error_code& error, int) {
        if (!error) stop();
      });
    }
    asio::thread_pool answering(kAnsweringThreads);
    answering_ = &answering;
    accept();
    io_.run();
    answering.stop();
    answering.join();
  }

  void stop() { io_.stop(); }

 private:
  class Connection;

  void accept() {
    acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
      if (!error) {
        admit(std::move(socket));
        accept();
        return;
      }
      // Such as no free file descriptor: the queue keeps the peer.
      retry_.expires_after(kAcceptRetry);
      retry_.async_wait([this](const error_code& stopped) {
        if (!stopped) accept();
      });
    });
  }
  void admit(tcp::socket socket);

  HttpServerParams params_;
  HttpHandler* handler_ = nullptr;
  std::uint16_t port_ = 0;
  std::set<Connection*> connections_;  // Outlives io_, which owns them.
  asio::thread_pool* answering_ = nullptr;
  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  asio::signal_set signals_;
  asio::steady_timer retry_;
};

/// Reads a request, has it answered, writes the reply, and begins again. Owned by its pending
/// operation. On the io thread.
class HttpServer::Impl::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Impl& server, tcp::socket socket)
      : server_(server), stream_(std::move(socket)), again_(server.io_) {
    server_.connections_.insert(this);
  }
  ~Connection() { server_.connections_.erase(this); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void read() {
    is_idle_ = true;
    since_ = steady_clock::now();
    reply_.reset();
    parser_.emplace();
    limit(*parser_);
    stream_.expires_after(server_.params_.request_time);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](const error_code& error, std::size_t) {
                       self->on_read(error);
                     });
  }

  bool is_idle() const { return is_idle_; }
  steady_clock::time_point since() const { return since_; }
  /// Ends its pending operation, and so itself.
  void close() { stream_.close(); }

 private:
  void on_read(const error_code& error) {
    is_idle_ = false;
    if (error) {
      keep_alive_ = false;
      if (is_malformed(error)) write(text_reply(status_of(error), error.message()));
      return;
    }
    keep_alive_ = parser_->get().keep_alive();
    request_ = to_request(parser_->get());
    parser_.reset();
    since_ = steady_clock::now();
    stream_.expires_never();
    ask();
  }

  void ask() {
    asio::post(*server_.answering_, [self = this->shared_from_this()]() mutable {
      std::optional<HttpReply> reply = self->answer();
      asio::io_context& io = self->server_.io_;
      // Moved, so that this thread never holds the last reference.
      asio::post(io,
                 [self = std::move(self), reply = std::move(reply)] { self->on_answer(reply); });
    });
  }

  /// On a thread of the pool.
  std::optional<HttpReply> answer() {
    try {
      return server_.handler_->answer(
          request_, std::chrono::duration_cast<milliseconds>(steady_clock::now() - since_));
    } catch (const std::exception& error) {
      return text_reply(500, error.what());
    }
  }

  void on_answer(const std::optional<HttpReply>& reply) {
    if (reply) {
      write(*reply);
      return;
    }
    if (peer_is_gone()) return;
    again_.expires_after(kAskAgain);
    again_.async_wait([self = this->shared_from_this()](const error_code& error) {
      if (!error) self->ask();
    });
  }

  /// A browser gives up a request whose picture it does not want any more.
  bool peer_is_gone() {
    char byte = 0;
    const ssize_t size =
        ::recv(stream_.socket().native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return size == 0 || (size < 0 && errno != EAGAIN && errno != EWOULDBLOCK);
  }

  void write(const HttpReply& reply) {
    body_ = reply.body ? reply.body : std::make_shared<const std::string>();
    reply_.emplace();
    reply_->result(static_cast<unsigned>(reply.status));
    reply_->set(http::field::content_type, reply.content_type);
    for (const auto& [name, value] : reply.headers) reply_->set(name, value);
    reply_->keep_alive(keep_alive_);
    reply_->body() = {body_->data(), body_->size()};
    reply_->prepare_payload();
    stream_.expires_after(server_.params_.reply_time);
    http::async_write(stream_, *reply_,
                      [self = this->shared_from_this()](const error_code& error, std::size_t) {
                        self->on_written(error);
                      });
  }

  void on_written(const error_code& error) {
    if (error) return;
    if (keep_alive_) {
      read();
      return;
    }
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  Impl& server_;
  beast::tcp_stream stream_;
  asio::steady_timer again_;
  beast::flat_buffer buffer_{kMostHeaderBytes + kMostBodyBytes};
  std::optional<RequestParser> parser_;
  HttpRequest request_;
  std::shared_ptr<const std::string> body_;
  std::optional<http::response<http::span_body<const char>>> reply_;
  bool keep_alive_ = false;
  bool is_idle_ = true;
  steady_clock::time_point since_;
};

void HttpServer::Impl::admit(tcp::socket socket) {
  if (connections_.size() >= params_.most_connections) {
    Connection* idle = nullptr;
    for (Connection* one : connections_) {
      if (one->is_idle() && (idle == nullptr || one->since() < idle->since())) idle = one;
    }
    if (idle == nullptr) return;
    idle->close();
  }
  std::make_shared<Connection>(*this, std::move(socket))->read();
}

HttpServer::HttpServer(const HttpServerParams& params) : impl_(std::make_unique<Impl>(params)) {}

HttpServer::~HttpServer() = default;

std::uint16_t HttpServer::port() const { return impl_->port(); }
void HttpServer::run(HttpHandler& handler) { impl_->run(handler); }
void HttpServer::stop() { impl_->stop(); }

}  // namespace puck
