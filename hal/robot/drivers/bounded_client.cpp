#include "hal/robot/drivers/bounded_client.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace hal::robot::drivers {
namespace {

using Clock = std::chrono::steady_clock;

/// A socket for the library, with the limits of one exchange.
class BoundedStream final : public httplib::Stream {
 public:
  BoundedStream(socket_t socket, const BoundedClient::Limits& limits)
      : socket_(socket), until_(Clock::now() + limits.time), bytes_left_(limits.bytes) {}

  bool is_readable() const override { return at_ < end_ || is_ready(POLLIN); }
  bool is_writable() const override { return is_ready(POLLOUT); }

  ssize_t read(char* to, std::size_t size) override {
    if (at_ == end_) {
      const ssize_t more = fill();
      if (more <= 0) return more;
    }
    const std::size_t count = std::min(size, end_ - at_);
    std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(at_), count, to);
    at_ += count;
    return static_cast<ssize_t>(count);
  }

  ssize_t write(const char* from, std::size_t size) override {
    if (!is_ready(POLLOUT)) return -1;
    return ::send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
  }

  // Not used here.
  void get_remote_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
  void get_local_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
  socket_t socket() const override { return socket_; }

 private:
  bool is_ready(short event) const {
    while (true) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(until_ - Clock::now()).count();
      if (left <= 0) return false;
      pollfd one{.fd = socket_, .events = event, .revents = 0};
      const int ready = ::poll(&one, 1, static_cast<int>(left));
      if (ready > 0) return true;
      if (ready < 0 && errno != EINTR) return false;
    }
  }

  /// As recv(2): 0 after the last byte from the device.
  ssize_t fill() {
    if (bytes_left_ == 0 || !is_ready(POLLIN)) return -1;
    const std::size_t most = std::min(buffer_.size(), bytes_left_);
    const ssize_t size = ::recv(socket_, buffer_.data(), most, MSG_DONTWAIT);
    at_ = 0;
    end_ = size > 0 ? static_cast<std::size_t>(size) : 0;
    bytes_left_ -= end_;
    return size;
  }

  socket_t socket_;
  Clock::time_point until_;
  std::size_t bytes_left_;
  std::array<char, 4096> buffer_{};
  std::size_t at_ = 0, end_ = 0;
};

}  // namespace

BoundedClient::BoundedClient(const std::string& host, int port, Limits limits)
    : ClientImpl(host, port), limits_(limits) {}

bool BoundedClient::process_socket(const Socket& socket,
                                   std::function<bool(httplib::Stream&)> exchange) {
  BoundedStream stream(socket.sock, limits_);
  return exchange(stream);
}

}  // namespace hal::robot::drivers
