#pragma once

#include <httplib.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>

namespace view::server {

/// HTTP server of one exchange per connection in which no client can hold a thread, memory or the
/// end of the server: an exchange has a deadline and a number of bytes, and where all places are
/// taken the connection that has been sending its request for longest gives its place to the next.
///
///   BoundedServer server({.places = 64});
///   server.bind_to_port("127.0.0.1", 8080);
///   std::thread listener([&] { server.listen_after_bind(); });
///   server.end();  // from another thread; does not wait for clients
///
/// A place is a thread and a descriptor. Further connections wait in the kernel's backlog.
class BoundedServer final : public httplib::Server {
 public:
  struct Limits {
    std::size_t places = 64;                             ///< Connections at a time.
    std::size_t request_bytes = std::size_t{64} * 1024;  ///< Of head and body.
    std::chrono::milliseconds request{2000};     ///< From the connection to the last byte asked.
    std::chrono::milliseconds answer{20000};     ///< From the first byte answered to the last.
    std::chrono::milliseconds undisturbed{100};  ///< Before a place may be taken away.
  };

  explicit BoundedServer(Limits limits);

  /// Stops listening and cuts all connections. Handlers that run go on to their ends, which
  /// listen_after_bind() waits for. From any thread.
  void end();

 private:
  using Instant = std::chrono::steady_clock::time_point;
  struct Connection {
    Instant since;
    bool is_asking = true;  ///< Nothing has been answered: it may have to give its place away.
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
  std::size_t taken_ = 0;  ///< Threads that run.
  bool has_ended_ = false;
};

}  // namespace view::server
