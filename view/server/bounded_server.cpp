#include "view/server/bounded_server.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <functional>
#include <system_error>
#include <thread>
#include <utility>

namespace view::server {
namespace {

using Clock = std::chrono::steady_clock;

/// Waits until a socket is ready. @return false at the deadline; true also if the connection was
/// cut.
bool waits_for(int socket, short events, Clock::time_point deadline) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd one{.fd = socket, .events = events, .revents = 0};
    const int ready = ::poll(&one, 1, static_cast<int>(left));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
}

}  // namespace

/// An entry in connections_ that lasts until its socket is closed.
class BoundedServer::Place {
 public:
  Place(BoundedServer& server, socket_t socket) : server_(server), socket_(socket) {
    const std::lock_guard lock(server_.mutex_);
    server_.connections_[socket_] = {.since = Clock::now()};
    server_.changed_.notify_all();
    if (server_.has_ended_) ::shutdown(socket_, SHUT_RDWR);
  }
  ~Place() {
    const std::lock_guard lock(server_.mutex_);
    server_.connections_.erase(socket_);  // before the number is used again
    ::shutdown(socket_, SHUT_RDWR);
    ::close(socket_);
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  void begin_answer() {
    const std::lock_guard lock(server_.mutex_);
    server_.connections_[socket_].is_asking = false;
  }

 private:
  BoundedServer& server_;
  socket_t socket_;
};

/// The socket as the library reads and writes it, with the limits of the server.
class BoundedServer::Stream final : public httplib::Stream {
 public:
  Stream(socket_t socket, const Limits& limits, Place& place)
      : socket_(socket),
        limits_(limits),
        place_(place),
        asked_until_(Clock::now() + limits.request) {}

  bool is_readable() const override {
    return at_ < end_ || waits_for(socket_, POLLIN, asked_until_);
  }
  bool is_writable() const override { return waits_for(socket_, POLLOUT, answered_until_); }

  ssize_t read(char* to, std::size_t size) override {
    if (at_ == end_ && !fill()) return -1;
    const std::size_t count = std::min(size, end_ - at_);
    std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(at_), count, to);
    at_ += count;
    return static_cast<ssize_t>(count);
  }

  ssize_t write(const char* from, std::size_t size) override {
    if (!has_begun_to_answer_) begin_answer();
    if (!is_writable()) return -1;
    return ::send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  }

  // The server does not use them: all clients are on this host.
  void get_remote_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
  void get_local_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
  socket_t socket() const override { return socket_; }

 private:
  bool fill() {
    if (read_ >= limits_.request_bytes || !waits_for(socket_, POLLIN, asked_until_)) return false;
    const ssize_t size = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (size <= 0) return false;
    at_ = 0;
    end_ = static_cast<std::size_t>(size);
    read_ += end_;
    return true;
  }

  void begin_answer() {
    has_begun_to_answer_ = true;
    answered_until_ = Clock::now() + limits_.answer;
    place_.begin_answer();
  }

  socket_t socket_;
  const Limits& limits_;
  Place& place_;
  Instant asked_until_, answered_until_;
  bool has_begun_to_answer_ = false;
  std::array<char, 4096> buffer_{};
  std::size_t at_ = 0, end_ = 0, read_ = 0;
};

/// Runs a thread for each connection, up to the number of places.
class BoundedServer::Threads final : public httplib::TaskQueue {
 public:
  explicit Threads(BoundedServer& server) : server_(server) {}

  void enqueue(std::function<void()> serve) override {
    server_.wait_for_place();
    const auto serve_and_leave = [this, serve = std::move(serve)] {
      serve();
      server_.leave();
    };
    try {
      std::thread(serve_and_leave).detach();
    } catch (const std::system_error&) {
      serve_and_leave();  // the system cannot create a thread
    }
  }

  void shutdown() override {
    std::unique_lock lock(server_.mutex_);
    server_.changed_.wait(lock, [this] { return server_.taken_ == 0; });
  }

 private:
  BoundedServer& server_;
};

BoundedServer::BoundedServer(Limits limits) : limits_(limits) {
  new_task_queue = [this] { return new Threads(*this); };
  set_keep_alive_max_count(1);
}

void BoundedServer::end() {
  stop();
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  for (const auto& [socket, connection] : connections_) ::shutdown(socket, SHUT_RDWR);
}

bool BoundedServer::process_and_close_socket(socket_t socket) {
  Place place(*this, socket);
  Stream stream(socket, limits_, place);
  bool is_closed = false;
  return process_request(stream, true, is_closed, nullptr);
}

void BoundedServer::wait_for_place() {
  std::unique_lock lock(mutex_);
  while (taken_ >= limits_.places) {
    const auto longest = longest_asking();
    if (longest == connections_.end()) {
      changed_.wait(lock);
    } else if (const auto until = longest->second.since + limits_.undisturbed;
               Clock::now() < until) {
      changed_.wait_until(lock, until);
    } else {
      longest->second.is_asking = false;
      ::shutdown(longest->first, SHUT_RDWR);
    }
  }
  ++taken_;
}

void BoundedServer::leave() {
  // Notified under the lock: the thread that waits for the last one destroys this object.
  const std::lock_guard lock(mutex_);
  --taken_;
  changed_.notify_all();
}

std::map<socket_t, BoundedServer::Connection>::iterator BoundedServer::longest_asking() {
  auto longest = connections_.end();
  for (auto one = connections_.begin(); one != connections_.end(); ++one) {
    const bool is_longer =
        longest == connections_.end() || one->second.since < longest->second.since;
    if (one->second.is_asking && is_longer) longest = one;
  }
  return longest;
}

}  // namespace view::server
