// What programs send and write: POSIX.1-2017, <sys/socket.h>, <sys/uio.h>, <unistd.h>; sendmmsg(2).
// Datagrams are held back until there is room for them on the air, as programs/preload does.
#include <limits.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "programs/preload/datagram.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/preload/room.h"
#include "programs/waits/descriptors.h"
#include "programs/waits/non_blocking.h"
#include "programs/waits/parts.h"
#include "programs/waits/ports.h"

namespace {

using programs::preload::Datagram;
using programs::preload::return_places;
using programs::preload::room;
using programs::waits::is_blocking;
using programs::waits::length_of;
using programs::waits::own_slot;
using programs::waits::parts_from;
using programs::waits::send_deadline;
using programs::waits::until_done;

/// Sends all of it, as a call does that may wait: a stream takes a part at a time.
/// @param send_it  from a byte on, with flags.
template <class Call>
ssize_t send_whole(const Datagram& datagram, int flags, const Call& send_it) {
  const int socket = datagram.socket;
  const bool waits = is_blocking(socket, flags);
  const auto deadline = waits ? send_deadline(socket) : 0;
  std::size_t sent = 0;
  for (;;) {
    const ssize_t some = until_done(socket, POLLOUT, waits, deadline, [&](bool no_wait) {
      return send_it(sent, no_wait ? flags | MSG_DONTWAIT : flags);
    });
    if (some < 0) return sent > 0 ? static_cast<ssize_t>(sent) : -1;
    sent += static_cast<std::size_t>(some);
    if (!waits || some == 0 || sent >= datagram.length) return static_cast<ssize_t>(sent);
  }
}

/// What `send_it` sends once there is room for it on the air, and in the socket.
template <class Call>
ssize_t send_when_possible(const Datagram& datagram, int flags, const Call& send_it) {
  if (own_slot() == nullptr) return send_it(0, flags);
  programs::waits::give_port(datagram.socket);
  const std::uint32_t frames = room() == nullptr ? 0 : programs::preload::frames_of(datagram);
  std::uint32_t places = 0;
  if (frames != 0) {
    const int error = programs::preload::take_places(datagram.socket, frames, flags, places);
    if (error != 0) {
      errno = error;
      return -1;
    }
  }
  const ssize_t sent = send_whole(datagram, flags, send_it);
  const int kept = errno;
  if (frames != 0) return_places(places, sent >= 0);
  errno = kept;
  return sent;
}

/// Writes all of it, in as many steps as it takes.
ssize_t write_in_steps(int descriptor, const iovec* parts, int count) {
  std::array<iovec, IOV_MAX> rest;
  std::size_t written = 0;
  for (;;) {
    const auto left =
        static_cast<int>(parts_from(parts, static_cast<std::size_t>(count), written, rest.data()));
    if (left == 0 && written > 0) return static_cast<ssize_t>(written);
    ssize_t some = 0;
    {
      const programs::waits::NonBlocking target(descriptor);
      some = BARAKA_NEXT(writev)(descriptor, rest.data(), left);
    }
    if (some == 0) return static_cast<ssize_t>(written);
    written += some > 0 ? static_cast<std::size_t>(some) : 0;
    if (some > 0) continue;
    const bool goes_on = errno == EAGAIN && programs::waits::wait_to_transfer(
                                                descriptor, POLLOUT, programs::waits::kNever) > 0;
    if (!goes_on) return written > 0 ? static_cast<ssize_t>(written) : -1;
  }
}

/// What has no flags. A socket is sent to; anything else is written when it can take something: a
/// little is then taken as a whole.
template <class Call, class Send>
ssize_t write_when_possible(const Datagram& datagram, const iovec* parts, int count,
                            const Call& write_it, const Send& send_it) {
  if (own_slot() == nullptr) return write_it();
  const int descriptor = datagram.socket;
  int type = 0;
  socklen_t size = sizeof type;
  if (BARAKA_NEXT_QUIET(getsockopt)(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0) {
    return send_when_possible(datagram, 0, send_it);
  }
  if (!is_blocking(descriptor, 0) || programs::waits::is_over()) return write_it();
  if (datagram.length > PIPE_BUF && count <= IOV_MAX) {
    return write_in_steps(descriptor, parts, count);
  }
  if (programs::waits::wait_to_transfer(descriptor, POLLOUT, programs::waits::kNever) < 0) {
    return -1;
  }
  return write_it();
}

Datagram datagram_of(int socket, const msghdr& message) {
  return {socket, static_cast<const sockaddr*>(message.msg_name), message.msg_namelen, &message,
          length_of(message.msg_iov, message.msg_iovlen)};
}

/// From a byte on; what goes beside the bytes goes with the first.
ssize_t send_rest(int socket, const msghdr& message, std::size_t begin, int flags) {
  if (begin == 0 || message.msg_iovlen > IOV_MAX)
    return BARAKA_NEXT(sendmsg)(socket, &message, flags);
  std::array<iovec, IOV_MAX> parts;
  msghdr rest{};
  rest.msg_name = message.msg_name;
  rest.msg_namelen = message.msg_namelen;
  rest.msg_iov = parts.data();
  rest.msg_iovlen = parts_from(message.msg_iov, message.msg_iovlen, begin, parts.data());
  return BARAKA_NEXT(sendmsg)(socket, &rest, flags);
}

}  // namespace

BARAKA_EXPORTED ssize_t send(int socket, const void* bytes, size_t length, int flags) {
  return send_when_possible(
      {socket, nullptr, 0, nullptr, length}, flags, [=](std::size_t begin, int with) {
        return BARAKA_NEXT(send)(socket, static_cast<const char*>(bytes) + begin, length - begin,
                                 with);
      });
}

// POSIX gives it six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED ssize_t sendto(int socket, const void* bytes, size_t length, int flags,
                               const sockaddr* to, socklen_t to_length) {
  return send_when_possible(
      {socket, to, to_length, nullptr, length}, flags, [=](std::size_t begin, int with) {
        return BARAKA_NEXT(sendto)(socket, static_cast<const char*>(bytes) + begin, length - begin,
                                   with, to, to_length);
      });
}

BARAKA_EXPORTED ssize_t sendmsg(int socket, const msghdr* message, int flags) {
  if (message == nullptr) return BARAKA_NEXT(sendmsg)(socket, message, flags);
  return send_when_possible(datagram_of(socket, *message), flags, [=](std::size_t begin, int with) {
    return send_rest(socket, *message, begin, with);
  });
}

/// One after the other: only the first may find that there is no room.
BARAKA_EXPORTED int sendmmsg(int socket, mmsghdr* messages, unsigned count, int flags) {
  if (own_slot() == nullptr) return BARAKA_NEXT(sendmmsg)(socket, messages, count, flags);
  unsigned sent = 0;
  for (; sent < count; ++sent) {
    const int of_this = sent == 0 ? flags : flags | MSG_DONTWAIT;
    const ssize_t length = sendmsg(socket, &messages[sent].msg_hdr, of_this);
    if (length < 0) break;
    messages[sent].msg_len = static_cast<unsigned>(length);
  }
  return sent == 0 && count > 0 ? -1 : static_cast<int>(sent);
}

BARAKA_EXPORTED ssize_t write(int descriptor, const void* bytes, size_t length) {
  const iovec whole{const_cast<void*>(bytes), length};
  return write_when_possible(
      {descriptor, nullptr, 0, nullptr, length}, &whole, 1,
      [=] { return BARAKA_NEXT(write)(descriptor, bytes, length); },
      [=](std::size_t begin, int flags) {
        return BARAKA_NEXT(send)(descriptor, static_cast<const char*>(bytes) + begin,
                                 length - begin, flags);
      });
}

BARAKA_EXPORTED ssize_t writev(int descriptor, const iovec* parts, int count) {
  if (count <= 0) return BARAKA_NEXT(writev)(descriptor, parts, count);
  const std::size_t length = length_of(parts, static_cast<std::size_t>(count));
  return write_when_possible(
      {descriptor, nullptr, 0, nullptr, length}, parts, count,
      [=] { return BARAKA_NEXT(writev)(descriptor, parts, count); },
      [=](std::size_t begin, int flags) {
        msghdr message{};
        message.msg_iov = const_cast<iovec*>(parts);
        message.msg_iovlen = static_cast<std::size_t>(count);
        return send_rest(descriptor, message, begin, flags);
      });
}
