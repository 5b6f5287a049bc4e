#pragma once

#include <httplib.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>

namespace view::server {

/// HTTP server with one exchange per connection, in which no client can occupy a thread or memory
/// for long, or delay the end of the server. An exchange has a deadline and a limit of bytes. If
/// all places are taken, the connection that has been sending its request for the longest time is
/// cut to make room for the next one.
///
///   BoundedServer server({.places = 64});
///   server.bind_to_port("127.0.0.1", 8080);
///   std::thread listener([&] { server.listen_after_bind(); });
///   server.end();  // from another thread; does not wait for clients
///
/// A place is a thread and a file descriptor. Further connections wait in the kernel's backlog.
class BoundedServer final : public httplib::Server {
 public:
  struct Limits {
    std::size_t places = 64;                             ///< Connections at a time.
    std::size_t request_bytes = std::size_t{64} * 1024;  ///< Maximum size of head and body.
    /// From the connection to the last byte of the request.
    std::chrono::milliseconds request{2000};
    std::chrono::milliseconds answer{20000};  ///< From the first byte of the answer to the last.
    /// Minimum time before a connection may be cut to make room.
    std::chrono::milliseconds undisturbed{100};
  };

  explicit BoundedServer(Limits limits);

  /// Stops listening and cuts all connections. Running handlers continue to their ends, for which
  /// listen_after_bind() waits. From any thread.
  void end();

 private:
  using Instant = std::chrono::steady_clock::time_point;
  struct Connection {
    Instant since;
    bool is_asking = true;  ///< No answer has begun, so it may be cut to make room.
  };
  class Place;
  class Stream;
  class Threads;

  bool process_and_close_socket(socket_t socket) override;
  void wait_for_place();
  void leave();
  std::map<socket_t, Connection>::iterator longest_asking();

  Limits limits_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<socket_t, Connection> connections_;
  std::size_t taken_ = 0;  ///< Threads in use.
  bool has_ended_ = false;
};

}  // namespace view::server
