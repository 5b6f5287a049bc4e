#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace hal::robot::drivers {

/// HTTP client whose exchanges are limited in time and bytes, whatever the device sends: endless
/// heads, lines, chunks or interim responses (100 Continue), or single bytes at intervals. The
/// library itself limits only each read, each line and bodies with a stated length.
///
///   BoundedClient client("172.26.1.1", 80, {.time = 150ms, .bytes = 16384});
///   client.set_keep_alive(true);
///
/// Not for TLS. One exchange at a time.
class BoundedClient final : public httplib::ClientImpl {
 public:
  struct Limits {
    std::chrono::nanoseconds time;  ///< For one exchange after the connection is established, > 0.
    std::size_t bytes = 0;          ///< For one answer: status line, head and body as transmitted.
  };

  BoundedClient(const std::string& host, int port, Limits limits);

 private:
  bool process_socket(const Socket& socket,
                      std::function<bool(httplib::Stream&)> exchange) override;

  Limits limits_;
};

}  // namespace hal::robot::drivers
