// What programs send and write: POSIX.1-2017, <sys/socket.h>, <sys/uio.h>, <unistd.h>; sendmmsg(2).
// Datagrams are held back until there is room for them on the air, as programs/preload does.
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>

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

bool is_socket(int descriptor) {
  int type = 0;
  socklen_t size = sizeof type;
  return BARAKA_NEXT(getsockopt)(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0;
}

/// @return false: with errno, what the call ends with.
bool wait_until_writable(int descriptor) {
  return programs::waits::wait_to_transfer(descriptor, POLLOUT, programs::waits::kNever) >= 0;
}

/// What is no socket is written when it can take something. More than a pipe takes then at least,
/// PIPE_BUF, would wait inside the kernel.
template <class Call>
ssize_t write_when_possible(int descriptor, std::size_t length, const Call& write_it) {
  struct stat status {};
  const bool may_wait = length > PIPE_BUF && is_blocking(descriptor, 0) &&
                        fstat(descriptor, &status) == 0 && S_ISFIFO(status.st_mode);
  std::size_t written = 0;
  do {
    if (is_blocking(descriptor, 0) && !wait_until_writable(descriptor)) break;
    const std::size_t left = length - written;
    const ssize_t count =
        write_it(written, may_wait ? std::min<std::size_t>(left, PIPE_BUF) : left);
    if (count < 0) break;
    written += static_cast<std::size_t>(count);
    if (!may_wait) return count;
  } while (written < length);
  return written > 0 ? static_cast<ssize_t>(written) : -1;
}

std::size_t length_of(const iovec* parts, std::size_t count) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < count; ++i) length += parts[i].iov_len;
  return length;
}

/// Of a stream that has taken a part: all calls that wait, wait until it has taken everything.
ssize_t send_rest(int socket, const iovec* parts, std::size_t count, int flags, ssize_t sent) {
  if (sent < 0 || static_cast<std::size_t>(sent) >= length_of(parts, count)) return sent;
  if (own_slot() == nullptr || !is_blocking(socket, flags)) return sent;
  auto skipped = static_cast<std::size_t>(sent);
  for (std::size_t i = 0; i < count; ++i) {
    const auto* const begin = static_cast<const char*>(parts[i].iov_base);
    while (skipped < parts[i].iov_len) {
      const std::size_t left = parts[i].iov_len - skipped;
      const ssize_t some = send_when_possible(
          {socket, nullptr, 0, nullptr, left}, flags,
          [=](int with) { return BARAKA_NEXT(send)(socket, begin + skipped, left, with); });
      if (some < 0) return sent;
      sent += some;
      skipped += static_cast<std::size_t>(some);
    }
    skipped -= parts[i].iov_len;
  }
  return sent;
}

Datagram datagram_of(int socket, const msghdr& message) {
  return {socket, static_cast<const sockaddr*>(message.msg_name), message.msg_namelen, &message,
          length_of(message.msg_iov, message.msg_iovlen)};
}

}  // namespace

BARAKA_EXPORTED ssize_t send(int socket, const void* bytes, size_t length, int flags) {
  return sendto(socket, bytes, length, flags, nullptr, 0);
}

// POSIX gives it six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED ssize_t sendto(int socket, const void* bytes, size_t length, int flags,
                               const sockaddr* to, socklen_t to_length) {
  const ssize_t sent = send_when_possible(
      {socket, to, to_length, nullptr, length}, flags,
      [=](int with) { return BARAKA_NEXT(sendto)(socket, bytes, length, with, to, to_length); });
  const iovec part{const_cast<void*>(bytes), length};
  return send_rest(socket, &part, 1, flags, sent);
}

BARAKA_EXPORTED ssize_t sendmsg(int socket, const msghdr* message, int flags) {
  if (message == nullptr) return BARAKA_NEXT(sendmsg)(socket, message, flags);
  const ssize_t sent = send_when_possible(datagram_of(socket, *message), flags, [=](int with) {
    return BARAKA_NEXT(sendmsg)(socket, message, with);
  });
  return send_rest(socket, message->msg_iov, message->msg_iovlen, flags, sent);
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
  if (own_slot() == nullptr) return BARAKA_NEXT(write)(descriptor, bytes, length);
  if (is_socket(descriptor)) return send(descriptor, bytes, length, 0);
  return write_when_possible(descriptor, length, [=](std::size_t from, std::size_t count) {
    return BARAKA_NEXT(write)(descriptor, static_cast<const char*>(bytes) + from, count);
  });
}

BARAKA_EXPORTED ssize_t writev(int descriptor, const iovec* parts, int count) {
  if (count <= 0 || own_slot() == nullptr) return BARAKA_NEXT(writev)(descriptor, parts, count);
  const auto number = static_cast<std::size_t>(count);
  if (is_socket(descriptor)) {
    msghdr message{};
    message.msg_iov = const_cast<iovec*>(parts);
    message.msg_iovlen = number;
    return sendmsg(descriptor, &message, 0);
  }
  const std::size_t length = length_of(parts, number);
  return write_when_possible(descriptor, length, [=](std::size_t from, std::size_t most) {
    if (from == 0 && most == length) return BARAKA_NEXT(writev)(descriptor, parts, count);
    std::size_t i = 0;
    for (; from >= parts[i].iov_len; ++i) from -= parts[i].iov_len;
    const char* const begin = static_cast<const char*>(parts[i].iov_base) + from;
    return BARAKA_NEXT(write)(descriptor, begin, std::min(most, parts[i].iov_len - from));
  });
}
