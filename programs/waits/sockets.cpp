// Sockets as they are made, bound and connected: POSIX.1-2017, <sys/socket.h>; socket(7).
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/descriptors.h"
#include "programs/waits/ports.h"
#include "programs/waits/virtual_clock.h"

namespace programs::waits {
namespace {

/// What is known of a socket of this process and not by the kernel.
struct Known {
  std::atomic<Nanoseconds> receive_timeout = 0, send_timeout = 0;  ///< 0: none.
  std::atomic<bool> has_port = false;
};

constexpr std::size_t kMostSockets = 16'384;
std::array<Known, kMostSockets> all;

/// Null: one of a number so high that nothing is kept of it.
Known* known(int socket) {
  const auto index = static_cast<std::size_t>(socket);
  return socket >= 0 && index < all.size() ? &all[index] : nullptr;
}

bool is_socket(int descriptor) {
  int type = 0;
  socklen_t length = sizeof type;
  return BARAKA_NEXT_QUIET(getsockopt)(descriptor, SOL_SOCKET, SO_TYPE, &type, &length) == 0;
}

/// A pipe, or any other file, may have the number of a socket that was closed.
Nanoseconds deadline(int descriptor, Nanoseconds timeout) {
  return timeout == 0 || !is_socket(descriptor) ? kNever : deadline_in(timeout);
}

bool is_timeout_option(int option, bool& of_receiving) {
  of_receiving = option == SO_RCVTIMEO_OLD || option == SO_RCVTIMEO_NEW;
  return of_receiving || option == SO_SNDTIMEO_OLD || option == SO_SNDTIMEO_NEW;
}

/// Null: not one that we keep.
std::atomic<Nanoseconds>* kept_timeout(int socket, int level, int option) {
  bool of_receiving = false;
  Known* const one = known(socket);
  if (own_slot() == nullptr || one == nullptr || level != SOL_SOCKET) return nullptr;
  if (!is_timeout_option(option, of_receiving)) return nullptr;
  return of_receiving ? &one->receive_timeout : &one->send_timeout;
}

union Address {
  sockaddr any;
  sockaddr_in v4;
  sockaddr_in6 v6;
};

/// Null: an address without ports, or one that has its port.
in_port_t* free_port(Address& address, socklen_t length) {
  if (address.any.sa_family == AF_INET && length >= sizeof address.v4) {
    return address.v4.sin_port == 0 ? &address.v4.sin_port : nullptr;
  }
  if (address.any.sa_family == AF_INET6 && length >= sizeof address.v6) {
    return address.v6.sin6_port == 0 ? &address.v6.sin6_port : nullptr;
  }
  return nullptr;
}

bool has_ports(int socket) {
  int type = 0;
  socklen_t length = sizeof type;
  if (BARAKA_NEXT_QUIET(getsockopt)(socket, SOL_SOCKET, SO_TYPE, &type, &length) != 0) return false;
  return type == SOCK_DGRAM || type == SOCK_STREAM;
}

/// To the next free one. @return as bind().
int bind_to_next(int socket, Address& address, in_port_t& port, socklen_t length) {
  constexpr std::uint32_t kFirst = 40'000, kCount = 20'000;
  for (std::uint32_t tries = 0; tries < kCount; ++tries) {
    port = htons(static_cast<std::uint16_t>(kFirst + page()->ports.fetch_add(1) % kCount));
    if (BARAKA_NEXT(bind)(socket, &address.any, length) == 0) return 0;
    if (errno != EADDRINUSE) return -1;
  }
  return -1;
}

}  // namespace

Nanoseconds receive_deadline(int socket) {
  const Known* const one = known(socket);
  return one == nullptr ? kNever : deadline(socket, one->receive_timeout);
}

Nanoseconds send_deadline(int socket) {
  const Known* const one = known(socket);
  return one == nullptr ? kNever : deadline(socket, one->send_timeout);
}

void give_port(int socket) {
  Known* const one = known(socket);
  if (one == nullptr || one->has_port) return;
  const int kept = errno;
  one->has_port = true;
  Address address{};
  socklen_t length = sizeof address;
  if (has_ports(socket) && getsockname(socket, &address.any, &length) == 0) {
    in_port_t* const port = free_port(address, length);
    if (port != nullptr) bind_to_next(socket, address, *port, length);
  }
  errno = kept;
}

void forget(int socket) {
  Known* const one = known(socket);
  if (one == nullptr) return;
  one->receive_timeout = one->send_timeout = 0;
  one->has_port = false;
}

}  // namespace programs::waits

using programs::waits::own_slot;

BARAKA_EXPORTED int socket(int domain, int type, int protocol) noexcept {
  const int made = BARAKA_NEXT(socket)(domain, type, protocol);
  programs::waits::forget(made);
  return made;
}

BARAKA_EXPORTED int socketpair(int domain, int type, int protocol, int made[2]) noexcept {
  const int status = BARAKA_NEXT(socketpair)(domain, type, protocol, made);
  if (status != 0) return status;
  programs::waits::forget(made[0]);
  programs::waits::forget(made[1]);
  return status;
}

BARAKA_EXPORTED int bind(int socket, const sockaddr* address, socklen_t length) noexcept {
  using programs::waits::Address;
  if (own_slot() == nullptr || address == nullptr || length > sizeof(Address)) {
    return BARAKA_NEXT(bind)(socket, address, length);
  }
  Address copy{};
  std::memcpy(&copy, address, length);
  in_port_t* const port = programs::waits::free_port(copy, length);
  if (port == nullptr || !programs::waits::has_ports(socket)) {
    return BARAKA_NEXT(bind)(socket, address, length);
  }
  return programs::waits::bind_to_next(socket, copy, *port, length);
}

/// A connection is made without waiting, and waited for.
BARAKA_EXPORTED int connect(int socket, const sockaddr* address, socklen_t length) {
  if (own_slot() == nullptr) return BARAKA_NEXT(connect)(socket, address, length);
  if (address != nullptr && address->sa_family != AF_UNSPEC) programs::waits::give_port(socket);
  if (!programs::waits::is_blocking(socket, 0))
    return BARAKA_NEXT(connect)(socket, address, length);
  const int flags = fcntl(socket, F_GETFL);
  fcntl(socket, F_SETFL, flags | O_NONBLOCK);
  int status = BARAKA_NEXT(connect)(socket, address, length);
  int error = errno;
  if (status != 0 && error == EINPROGRESS) {
    status =
        programs::waits::wait_to_transfer(socket, POLLOUT, programs::waits::send_deadline(socket));
    socklen_t size = sizeof error;
    if (status < 0) error = errno;
    if (status > 0) BARAKA_NEXT_QUIET(getsockopt)(socket, SOL_SOCKET, SO_ERROR, &error, &size);
    status = status > 0 && error == 0 ? 0 : -1;
  }
  fcntl(socket, F_SETFL, flags);
  errno = error;
  return status;
}

BARAKA_EXPORTED int setsockopt(int socket, int level, int option, const void* value,
                               socklen_t length) noexcept {
  auto* const kept = programs::waits::kept_timeout(socket, level, option);
  timeval timeout{};
  if (kept == nullptr || value == nullptr || length < sizeof timeout) {
    return BARAKA_NEXT(setsockopt)(socket, level, option, value, length);
  }
  std::memcpy(&timeout, value, sizeof timeout);
  if (timeout.tv_usec < 0 || timeout.tv_usec >= 1'000'000) {
    errno = EDOM;
    return -1;
  }
  const auto time = timeout.tv_sec * programs::waits::kSecond + timeout.tv_usec * 1000;
  *kept = time < 0 ? 1 : time;  // as Linux: it does not wait
  return 0;
}

BARAKA_EXPORTED int getsockopt(int socket, int level, int option, void* __restrict value,
                               socklen_t* __restrict length) noexcept {
  const auto* const kept = programs::waits::kept_timeout(socket, level, option);
  timeval timeout{};
  if (kept == nullptr || value == nullptr || length == nullptr || *length < sizeof timeout) {
    return BARAKA_NEXT(getsockopt)(socket, level, option, value, length);
  }
  const timespec time = programs::waits::to_timespec(*kept);
  timeout = {time.tv_sec, time.tv_nsec / 1000};
  std::memcpy(value, &timeout, sizeof timeout);
  *length = sizeof timeout;
  return 0;
}
