#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

namespace hal::robot::drivers {

/// HTTP client whose exchanges end in time and within a number of bytes, whatever the device sends:
/// heads, lines, chunks or interim responses (100 Continue) without end, or a byte now and then.
/// The library's own limits are of each read, of each line and of bodies whose length was told.
///
///   BoundedClient client("172.26.1.1", 80, {.time = 150ms, .bytes = 16384});
///   client.set_keep_alive(true);
///
/// Not for TLS. One exchange at a time.
class BoundedClient final : public httplib::ClientImpl {
 public:
  struct Limits {
    std::chrono::nanoseconds time;  ///< Of an exchange once it is connected, > 0.
    std::size_t bytes = 0;          ///< Of its answer: status line, head and body as they come.
  };

  BoundedClient(const std::string& host, int port, Limits limits);

 private:
  bool process_socket(const Socket& socket,
                      std::function<bool(httplib::Stream&)> exchange) override;

  Limits limits_;
};

}  // namespace hal::robot::drivers
