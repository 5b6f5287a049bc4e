#include "view/server/view_server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <pthread.h>
#include <sys/socket.h>

#include <csignal>
#include <exception>
#include <semaphore>
#include <thread>
#include <utility>

#include "hal/types/printable.h"
#include "view/server/bounded_server.h"
#include "view/server/control_request.h"
#include "view/server/json_text.h"
#include "view/server/request_check.h"

namespace view::server {
namespace {

constexpr const char* kHost = "127.0.0.1";
constexpr std::ptrdiff_t kMostAnswers = 16;    ///< Queries at a time.
constexpr int kMostWaiting = 1024;             ///< Connections in the kernel's backlog.
constexpr std::size_t kLongestCommand = 4096;  ///< Bytes

/// The page is one file: its scripts and styles are inline, its workers are made from it.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'unsafe-inline' blob:; worker-src blob:; style-src "
    "'unsafe-inline'; img-src 'self' data: blob:; font-src data:; connect-src 'self' blob: data:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Blocks all signals while threads are started: signals belong to whoever started the server.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsBlocked() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t before_{};
};

using Permits = std::counting_semaphore<kMostAnswers>;

/// A permit to answer, of which there is a limited number.
class Permit {
 public:
  explicit Permit(Permits& permits) : permits_(permits) { permits_.acquire(); }
  ~Permit() { permits_.release(); }
  Permit(const Permit&) = delete;
  Permit& operator=(const Permit&) = delete;

 private:
  Permits& permits_;
};

/// The library makes the whole process ignore SIGPIPE, which child processes would inherit:
/// restores the handler.
std::unique_ptr<BoundedServer> new_server() {
  struct sigaction before {};
  ::sigaction(SIGPIPE, nullptr, &before);
  auto server = std::make_unique<BoundedServer>(BoundedServer::Limits{});
  ::sigaction(SIGPIPE, &before, nullptr);
  return server;
}

RequestHead head_of(const httplib::Request& request) {
  return {.method = request.method,
          .path = request.path,
          .hosts = request.get_header_value_count("Host"),
          .origins = request.get_header_value_count("Origin"),
          .host = request.get_header_value("Host"),
          .origin = request.get_header_value("Origin"),
          .fetch_site = request.get_header_value("Sec-Fetch-Site"),
          .token = request.get_header_value("X-Baraka-Token")};
}

/// Sends by a content provider: the library would compress a complete text, which takes longer than
/// to send it within one host.
void send(httplib::Response& response, std::string text, const char* type) {
  const auto content = std::make_shared<const std::string>(std::move(text));
  response.set_content_provider(content->size(), type,
                                [content](std::size_t at, std::size_t most, httplib::DataSink& to) {
                                  const std::size_t size = std::min(most, content->size() - at);
                                  return to.write(content->data() + at, size);
                                });
}

void send_error(httplib::Response& response, int status, std::string_view why) {
  response.status = status;
  send(response, JsonObject().add("error", hal::printable(why)).json().text, "application/json");
}

std::string text_of(const Clock::Now& clock) {
  return JsonObject()
      .add("now", clock.now)
      .add("until", clock.until)
      .add("can_hold", clock.can_hold)
      .add("paused", clock.paused)
      .add("speed", clock.speed)
      .add("stopped_by", clock.stopped_by)
      .add("ended", clock.ended)
      .add("result", clock.result)
      .json()
      .text;
}

}  // namespace

class ViewServer::Http {
 public:
  explicit Http(Settings settings)
      : page_(std::move(settings.page)),
        api_(std::move(settings.runs), settings.mode, settings.control != nullptr),
        wanted_port_(settings.port),
        control_(settings.control),
        clock_(settings.clock),
        server_(new_server()) {
    if (control_ != nullptr) token_ = new_token();
    set_up();
  }
  ~Http() { stop(); }
  Http(const Http&) = delete;
  Http& operator=(const Http&) = delete;

  hal::Result<void> start();
  void stop();
  int port() const { return port_; }
  const std::optional<std::string>& token() const { return token_; }

 private:
  void set_up();
  bool answer(const httplib::Request& request, httplib::Response& response) const;
  void get(const std::string& path, httplib::Response& response) const;
  void command(const std::string& body, httplib::Response& response) const;

  std::optional<std::string> page_;
  ViewApi api_;
  int wanted_port_, port_ = 0;
  RunControl* control_;
  const Clock* clock_;
  std::optional<std::string> token_;
  int socket_ = -1;  ///< The listening socket, owned by the server.
  mutable Permits answers_{kMostAnswers};
  std::unique_ptr<BoundedServer> server_;
  std::thread listener_;
};

void ViewServer::Http::set_up() {
  using Handled = httplib::Server::HandlerResponse;
  // Replaces the library's options, with which several servers could share a port.
  server_->set_socket_options([this](int socket) {
    socket_ = socket;
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server_->set_payload_max_length(kLongestCommand);
  server_->set_tcp_nodelay(true);
  server_->set_default_headers({{"X-Content-Type-Options", "nosniff"},
                                {"Content-Security-Policy", kPolicy},
                                {"Cross-Origin-Resource-Policy", "same-origin"},
                                {"Referrer-Policy", "no-referrer"},
                                {"Cache-Control", "no-store"}});
  server_->set_pre_routing_handler([this](const auto& request, auto& response) {
    return answer(request, response) ? Handled::Handled : Handled::Unhandled;
  });
  server_->Post("/api/control", [this](const httplib::Request& request, auto& response) {
    command(request.body, response);
  });
  server_->set_exception_handler([](const auto&, auto& response, std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const std::exception& e) {
      send_error(response, 500, e.what());
    }
  });
}

/// Refuses a body of unknown length: the library would read all of it before it checks its size.
bool refuse_body(const httplib::Request& request, httplib::Response& response) {
  if (!request.has_header("Transfer-Encoding") && !request.has_header("Content-Encoding"))
    return false;
  send_error(response, 411, "a command has a Content-Length and no encoding");
  return true;
}

/// @return false if it is a command whose body may be read.
bool ViewServer::Http::answer(const httplib::Request& request, httplib::Response& response) const {
  if (const auto refusal = refusal_of(head_of(request), port_, token_)) {
    send_error(response, refusal->status, refusal->why);
    return true;
  }
  if (request.method != "GET") return refuse_body(request, response);
  const Permit permit(answers_);
  // The library's exception handler does not cover handlers that run before routing.
  try {
    get(request.path, response);
  } catch (const std::exception& e) {
    send_error(response, 500, e.what());
  }
  return true;
}

void ViewServer::Http::get(const std::string& path, httplib::Response& response) const {
  response.status = 200;
  if (path == "/" && page_) return send(response, *page_, "text/html; charset=utf-8");
  if (path == "/") return send_error(response, 503, "the page was not built: ./setup pages");
  if (path == "/api/clock" && clock_ != nullptr) {
    return send(response, text_of(clock_->now()), "application/json");
  }
  if (path == "/api/open") {
    if (clock_ != nullptr) clock_->keep();
    return send(response, "{}", "application/json");
  }
  if (auto text = api_.get(path)) return send(response, std::move(*text), "application/json");
  send_error(response, 404, "there is nothing of that address");
}

void ViewServer::Http::command(const std::string& body, httplib::Response& response) const {
  const hal::Result<Command> asked = command_in(body);
  if (!asked) return send_error(response, 400, asked.error().message);
  const hal::Result<std::int64_t> done = control_->act(*asked);
  if (!done) return send_error(response, 409, done.error().message);
  response.status = 200;
  send(response, JsonObject().add("id", *done).json().text, "application/json");
}

hal::Result<void> ViewServer::Http::start() {
  const bool is_bound = wanted_port_ == 0 ? (port_ = server_->bind_to_any_port(kHost)) > 0
                                          : server_->bind_to_port(kHost, wanted_port_);
  if (!is_bound) {
    return hal::fail(hal::Errc::kInvalidArgument,
                     wanted_port_ == 0
                         ? fmt::format("view: {} has no free port", kHost)
                         : fmt::format("view: port {} of {} is taken, or not for you: choose "
                                       "another one, or no --port for a free one",
                                       wanted_port_, kHost));
  }
  if (wanted_port_ != 0) port_ = wanted_port_;
  // The library's backlog is five; a browser with some tabs opens more connections at once, and
  // retries one that was refused only after a second.
  ::listen(socket_, kMostWaiting);
  const SignalsBlocked blocked;  // inherited by the new thread and those that it starts
  listener_ = std::thread([this] { server_->listen_after_bind(); });
  return {};
}

void ViewServer::Http::stop() {
  if (!listener_.joinable()) return;
  // The library ignores stop() before it listens.
  while (!server_->is_running()) std::this_thread::yield();
  server_->end();
  listener_.join();
}

ViewServer::ViewServer(Settings settings) : http_(std::make_unique<Http>(std::move(settings))) {}
ViewServer::~ViewServer() = default;
hal::Result<void> ViewServer::start() { return http_->start(); }
void ViewServer::stop() { http_->stop(); }
int ViewServer::port() const { return http_->port(); }

std::string ViewServer::address() const {
  // After '#': browsers do not send this part of an address.
  const std::string token = http_->token() ? "#token=" + *http_->token() : "";
  return fmt::format("http://{}:{}/{}", kHost, port(), token);
}

}  // namespace view::server
