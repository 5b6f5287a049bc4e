// What programs send and write: POSIX.1-2017, <sys/socket.h>, <sys/uio.h>, <unistd.h>; sendmmsg(2).
// Datagrams are held back until there is room for them on the air, as programs/preload does.
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>

#include "programs/preload/datagram.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/preload/room.h"
#include "programs/waits/descriptors.h"
#include "programs/waits/ports.h"

namespace {

using programs::preload::Datagram;
using programs::preload::return_places;
using programs::preload::room;
using programs::waits::is_blocking;
using programs::waits::own_slot;
using programs::waits::send_deadline;
using programs::waits::until_done;

/// What `call` sends once there is room for it on the air, and in the socket.
template <class Call>
ssize_t send_when_possible(const Datagram& datagram, int flags, const Call& send_it) {
  if (own_slot() == nullptr) return send_it(flags);
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
  const bool waits = is_blocking(datagram.socket, flags);
  const ssize_t sent =
      until_done(datagram.socket, POLLOUT, waits, waits ? send_deadline(datagram.socket) : 0,
                 [&](bool no_wait) { return send_it(no_wait ? flags | MSG_DONTWAIT : flags); });
  const int kept = errno;
  if (frames != 0) return_places(places, sent >= 0);
  errno = kept;
  return sent;
}

/// What has no flags. A socket is sent to; anything else is written when it can take something.
template <class Call, class Send>
ssize_t write_when_possible(const Datagram& datagram, const Call& write_it, const Send& send_it) {
  if (own_slot() == nullptr) return write_it();
  int type = 0;
  socklen_t size = sizeof type;
  if (BARAKA_NEXT(getsockopt)(datagram.socket, SOL_SOCKET, SO_TYPE, &type, &size) == 0) {
    return send_when_possible(datagram, 0, send_it);
  }
  if (is_blocking(datagram.socket, 0)) {
    pollfd one{datagram.socket, POLLOUT, 0};
    if (programs::waits::wait_for_descriptors(&one, 1, programs::waits::kNever, nullptr) < 0) {
      return -1;
    }
  }
  return write_it();
}

std::size_t length_of(const iovec* parts, std::size_t count) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < count; ++i) length += parts[i].iov_len;
  return length;
}

Datagram datagram_of(int socket, const msghdr& message) {
  return {socket, static_cast<const sockaddr*>(message.msg_name), message.msg_namelen, &message,
          length_of(message.msg_iov, message.msg_iovlen)};
}

}  // namespace

BARAKA_EXPORTED ssize_t send(int socket, const void* bytes, size_t length, int flags) {
  return send_when_possible({socket, nullptr, 0, nullptr, length}, flags, [=](int with) {
    return BARAKA_NEXT(send)(socket, bytes, length, with);
  });
}

// POSIX gives it six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED ssize_t sendto(int socket, const void* bytes, size_t length, int flags,
                               const sockaddr* to, socklen_t to_length) {
  return send_when_possible({socket, to, to_length, nullptr, length}, flags, [=](int with) {
    return BARAKA_NEXT(sendto)(socket, bytes, length, with, to, to_length);
  });
}

BARAKA_EXPORTED ssize_t sendmsg(int socket, const msghdr* message, int flags) {
  if (message == nullptr) return BARAKA_NEXT(sendmsg)(socket, message, flags);
  return send_when_possible(datagram_of(socket, *message), flags,
                            [=](int with) { return BARAKA_NEXT(sendmsg)(socket, message, with); });
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
  return write_when_possible(
      {descriptor, nullptr, 0, nullptr, length},
      [=] { return BARAKA_NEXT(write)(descriptor, bytes, length); },
      [=](int flags) { return BARAKA_NEXT(send)(descriptor, bytes, length, flags); });
}

BARAKA_EXPORTED ssize_t writev(int descriptor, const iovec* parts, int count) {
  if (count <= 0) return BARAKA_NEXT(writev)(descriptor, parts, count);
  const std::size_t length = length_of(parts, static_cast<std::size_t>(count));
  return write_when_possible(
      {descriptor, nullptr, 0, nullptr, length},
      [=] { return BARAKA_NEXT(writev)(descriptor, parts, count); },
      [=](int flags) {
        msghdr message{};
        message.msg_iov = const_cast<iovec*>(parts);
        message.msg_iovlen = static_cast<std::size_t>(count);
        return BARAKA_NEXT(sendmsg)(descriptor, &message, flags);
      });
}
