// What programs read and receive: POSIX.1-2017, <unistd.h>, <sys/uio.h>, <sys/socket.h>;
// recvmmsg(2), and the times at which the kernel says that something came in: socket(7),
// Documentation/networking/timestamping.rst of Linux.
#include <limits.h>
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstring>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/descriptors.h"
#include "programs/waits/entropy.h"
#include "programs/waits/parts.h"
#include "programs/waits/ports.h"
#include "programs/waits/virtual_clock.h"

extern "C" {
/// As __poll_chk(): see descriptors.cpp.
ssize_t checked_read(int descriptor, void* bytes, size_t length, size_t size) __asm__("__read_chk");
ssize_t checked_recv(int socket, void* bytes, size_t length, size_t size,
                     int flags) __asm__("__recv_chk");
ssize_t checked_recvfrom(int socket, void* bytes, size_t length, size_t size, int flags,
                         sockaddr* from, socklen_t* from_length) __asm__("__recvfrom_chk");
[[noreturn]] void fail_check() __asm__("__chk_fail");
}

namespace {

using programs::waits::is_blocking;
using programs::waits::own_slot;
using programs::waits::receive_deadline;
using programs::waits::stir_by_reading;
using programs::waits::until_done;

/// Those that have no flag by which they do not wait: after a wait for something to be there.
/// @return false: with errno, what the call ends with.
bool wait_until_readable(int descriptor) {
  if (own_slot() == nullptr || !is_blocking(descriptor, 0)) return true;
  const int ready =
      programs::waits::wait_to_transfer(descriptor, POLLIN, receive_deadline(descriptor));
  if (ready == 0) errno = EAGAIN;
  return ready > 0;
}

bool is_stream(int socket) {
  int type = 0;
  socklen_t size = sizeof type;
  return BARAKA_NEXT_QUIET(getsockopt)(socket, SOL_SOCKET, SO_TYPE, &type, &size) == 0 &&
         type == SOCK_STREAM;
}

/// @param length  bytes that are asked for; with MSG_WAITALL a stream is to give as many.
/// @param call  from a byte on, with flags.
template <class Call>
ssize_t receive(int socket, int flags, std::size_t length, const Call& call) {
  if (own_slot() == nullptr) return call(0, flags);
  const bool waits = is_blocking(socket, flags);
  const bool waits_for_all =
      waits && (flags & (MSG_WAITALL | MSG_PEEK)) == MSG_WAITALL && is_stream(socket);
  const auto deadline = waits ? receive_deadline(socket) : 0;
  std::size_t received = 0;
  for (;;) {
    const ssize_t some = until_done(socket, POLLIN, waits, deadline, [&](bool no_wait) {
      stir_by_reading();
      return call(received, no_wait ? flags | MSG_DONTWAIT : flags);
    });
    if (some <= 0) return received > 0 ? static_cast<ssize_t>(received) : some;
    received += static_cast<std::size_t>(some);
    if (!waits_for_all || received >= length) return static_cast<ssize_t>(received);
  }
}

/// From a byte on; what comes beside the bytes comes with the first.
ssize_t receive_rest(int socket, msghdr& message, std::size_t begin, int flags) {
  if (begin == 0 || message.msg_iovlen > IOV_MAX)
    return BARAKA_NEXT_QUIET(recvmsg)(socket, &message, flags);
  std::array<iovec, IOV_MAX> parts;
  msghdr rest{};
  rest.msg_iov = parts.data();
  rest.msg_iovlen =
      programs::waits::parts_from(message.msg_iov, message.msg_iovlen, begin, parts.data());
  return BARAKA_NEXT_QUIET(recvmsg)(socket, &rest, flags);
}

/// Everything comes in at the virtual time at which it is asked for: none passes in between.
void put_now(cmsghdr& control, bool in_microseconds) {
  if (control.cmsg_len < CMSG_LEN(sizeof(timespec))) return;
  timespec now = programs::waits::to_timespec(programs::waits::reading(CLOCK_REALTIME));
  if (in_microseconds) now.tv_nsec /= 1000;  // a timeval
  std::memcpy(CMSG_DATA(&control), &now, sizeof now);
}

void put_times(msghdr& message) {
  for (cmsghdr* control = CMSG_FIRSTHDR(&message); control != nullptr;
       control = CMSG_NXTHDR(&message, control)) {
    if (control->cmsg_level != SOL_SOCKET) continue;
    switch (control->cmsg_type) {
      case SO_TIMESTAMP_OLD:
      case SO_TIMESTAMP_NEW:
        put_now(*control, true);
        break;
      case SO_TIMESTAMPNS_OLD:
      case SO_TIMESTAMPNS_NEW:
      case SO_TIMESTAMPING_OLD:
      case SO_TIMESTAMPING_NEW:
        put_now(*control, false);
        break;
      default:
        break;
    }
  }
}

}  // namespace

// POSIX gives it six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED ssize_t recvfrom(int socket, void* bytes, size_t length, int flags, sockaddr* from,
                                 socklen_t* from_length) {
  return receive(socket, flags, length, [=](std::size_t begin, int with) {
    return BARAKA_NEXT_QUIET(recvfrom)(socket, static_cast<char*>(bytes) + begin, length - begin,
                                       with, from, from_length);
  });
}

BARAKA_EXPORTED ssize_t recv(int socket, void* bytes, size_t length, int flags) {
  return receive(socket, flags, length, [=](std::size_t begin, int with) {
    return BARAKA_NEXT_QUIET(recv)(socket, static_cast<char*>(bytes) + begin, length - begin, with);
  });
}

BARAKA_EXPORTED ssize_t checked_recv(int socket, void* bytes, size_t length, size_t size,
                                     int flags) {
  if (length > size) fail_check();
  return recv(socket, bytes, length, flags);
}

// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED ssize_t checked_recvfrom(int socket, void* bytes, size_t length, size_t size,
                                         int flags, sockaddr* from, socklen_t* from_length) {
  if (length > size) fail_check();
  return recvfrom(socket, bytes, length, flags, from, from_length);
}

BARAKA_EXPORTED ssize_t recvmsg(int socket, msghdr* message, int flags) {
  if (message == nullptr) return BARAKA_NEXT_QUIET(recvmsg)(socket, message, flags);
  const ssize_t length = receive(
      socket, flags, programs::waits::length_of(message->msg_iov, message->msg_iovlen),
      [=](std::size_t begin, int with) { return receive_rest(socket, *message, begin, with); });
  if (length >= 0 && own_slot() != nullptr) put_times(*message);
  return length;
}

/// Linux looks at the time-out after each message only; MSG_WAITFORONE, or a time-out, ends the
/// wait for more than one.
BARAKA_EXPORTED int recvmmsg(int socket, mmsghdr* messages, unsigned count, int flags,
                             timespec* timeout) {
  if (own_slot() == nullptr)
    return BARAKA_NEXT_QUIET(recvmmsg)(socket, messages, count, flags, timeout);
  const bool waits = is_blocking(socket, flags);
  const auto deadline =
      timeout != nullptr ? programs::waits::deadline_in(timeout) : receive_deadline(socket);
  unsigned received = 0;
  while (received < count) {
    const bool waits_for_this = waits && (received == 0 || (flags & MSG_WAITFORONE) == 0);
    const int some = until_done(socket, POLLIN, waits_for_this, deadline, [&](bool no_wait) {
      stir_by_reading();
      return BARAKA_NEXT_QUIET(recvmmsg)(socket, messages + received, count - received,
                                         no_wait ? flags | MSG_DONTWAIT : flags, nullptr);
    });
    if (some < 0 && received == 0) return -1;
    if (some <= 0) break;
    received += static_cast<unsigned>(some);
    if (!waits || (flags & MSG_WAITFORONE) != 0) break;
  }
  for (unsigned i = 0; i < received; ++i) put_times(messages[i].msg_hdr);
  return static_cast<int>(received);
}

BARAKA_EXPORTED ssize_t read(int descriptor, void* bytes, size_t length) {
  if (!wait_until_readable(descriptor)) return -1;
  stir_by_reading();
  const ssize_t got = BARAKA_NEXT_QUIET(read)(descriptor, bytes, length);
  const bool is_at_end = got == 0 && length > 0 && own_slot() != nullptr;
  if (!is_at_end || !programs::waits::is_refilled(descriptor)) return got;
  return BARAKA_NEXT_QUIET(read)(descriptor, bytes, length);
}

BARAKA_EXPORTED ssize_t checked_read(int descriptor, void* bytes, size_t length, size_t size) {
  if (length > size) fail_check();
  return read(descriptor, bytes, length);
}

BARAKA_EXPORTED ssize_t readv(int descriptor, const iovec* parts, int count) {
  if (!wait_until_readable(descriptor)) return -1;
  stir_by_reading();
  return BARAKA_NEXT_QUIET(readv)(descriptor, parts, count);
}

BARAKA_EXPORTED int accept4(int socket, sockaddr* from, socklen_t* length, int flags) {
  if (!wait_until_readable(socket)) return -1;
  const int made = BARAKA_NEXT(accept4)(socket, from, length, flags);
  programs::waits::forget(made);
  return made;
}

BARAKA_EXPORTED int accept(int socket, sockaddr* from, socklen_t* length) {
  return accept4(socket, from, length, 0);
}

BARAKA_EXPORTED int ioctl(int descriptor, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  const int status = BARAKA_NEXT(ioctl)(descriptor, request, argument);
  if (status != 0 || own_slot() == nullptr) return status;
  const timespec now = programs::waits::to_timespec(programs::waits::reading(CLOCK_REALTIME));
  if (request == SIOCGSTAMP_OLD || request == SIOCGSTAMP_NEW) {
    *static_cast<timeval*>(argument) = {now.tv_sec, now.tv_nsec / 1000};
  } else if (request == SIOCGSTAMPNS_OLD || request == SIOCGSTAMPNS_NEW) {
    *static_cast<timespec*>(argument) = now;
  }
  return status;
}
