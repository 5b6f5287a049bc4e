// Sending, which is held back until there is room on the air: POSIX.1-2017, <sys/socket.h>,
// <sys/uio.h>, <unistd.h>; sendmmsg(2).
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "programs/preload/datagram.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/preload/room.h"

namespace {

using programs::preload::Datagram;
using programs::preload::return_places;
using programs::preload::room;

/// Sends by `call` as soon as there is room for the datagram.
template <class Call>
ssize_t send_held_back(const Datagram& datagram, int flags, const Call& call) {
  if (room() == nullptr) return call();
  const std::uint32_t frames = programs::preload::frames_of(datagram);
  if (frames == 0) return call();
  std::uint32_t places = 0;
  const int error = programs::preload::take_places(datagram.socket, frames, flags, places);
  if (error != 0) {
    errno = error;
    return -1;
  }
  const ssize_t sent = call();
  const int kept = errno;
  return_places(places, sent >= 0);
  errno = kept;
  return sent;
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

/// As many messages as there is room for, but at least one, for which it waits.
class Batch {
 public:
  Batch(int socket, mmsghdr* messages, unsigned count) : socket_(socket), messages_(messages) {
    count_ = std::min<unsigned>(count, static_cast<unsigned>(places_.size()));
  }

  /// @return 0, or the error for the first message.
  int take(int flags) {
    for (; taken_ < count_; ++taken_) {
      const std::uint32_t frames =
          programs::preload::frames_of(datagram_of(socket_, messages_[taken_].msg_hdr));
      std::uint32_t& places = places_[taken_];
      places = room()->places_for(frames);
      if (places == 0 || room()->reserve(places)) continue;
      if (taken_ > 0) return 0;
      const int error = programs::preload::take_places(socket_, frames, flags, places);
      if (error != 0) return error;
    }
    return 0;
  }

  int send(int flags) {
    const int sent = BARAKA_NEXT(sendmmsg)(socket_, messages_, taken_, flags);
    const int kept = errno;
    for (unsigned i = 0; i < taken_; ++i) {
      if (places_[i] != 0) return_places(places_[i], static_cast<int>(i) < sent);
    }
    errno = kept;
    return sent;
  }

  bool is_all(int sent) const { return sent >= 0 && static_cast<unsigned>(sent) == taken_; }

 private:
  int socket_;
  mmsghdr* messages_;
  unsigned count_ = 0, taken_ = 0;
  std::array<std::uint32_t, 64> places_{};
};

}  // namespace

BARAKA_EXPORTED ssize_t send(int socket, const void* bytes, size_t length, int flags) {
  return send_held_back({socket, nullptr, 0, nullptr, length}, flags,
                        [=] { return BARAKA_NEXT(send)(socket, bytes, length, flags); });
}

// POSIX defines six parameters.
// NOLINTNEXTLINE(readability-function-size)
BARAKA_EXPORTED ssize_t sendto(int socket, const void* bytes, size_t length, int flags,
                               const sockaddr* to, socklen_t to_length) {
  return send_held_back({socket, to, to_length, nullptr, length}, flags, [=] {
    return BARAKA_NEXT(sendto)(socket, bytes, length, flags, to, to_length);
  });
}

BARAKA_EXPORTED ssize_t sendmsg(int socket, const msghdr* message, int flags) {
  if (room() == nullptr || message == nullptr) return BARAKA_NEXT(sendmsg)(socket, message, flags);
  return send_held_back(datagram_of(socket, *message), flags,
                        [=] { return BARAKA_NEXT(sendmsg)(socket, message, flags); });
}

/// May send fewer messages than asked for if there is no room for more.
BARAKA_EXPORTED int sendmmsg(int socket, mmsghdr* messages, unsigned count, int flags) {
  if (room() == nullptr) return BARAKA_NEXT(sendmmsg)(socket, messages, count, flags);
  unsigned sent = 0;
  while (sent < count) {
    Batch batch(socket, messages + sent, count - sent);
    const int error = batch.take(flags);
    const int status = error == 0 ? batch.send(flags) : -1;
    if (status < 0 && sent == 0) {
      if (error != 0) errno = error;
      return -1;
    }
    if (status > 0) sent += static_cast<unsigned>(status);
    if (!batch.is_all(status)) break;
  }
  return static_cast<int>(sent);
}

BARAKA_EXPORTED ssize_t write(int descriptor, const void* bytes, size_t length) {
  return send_held_back({descriptor, nullptr, 0, nullptr, length}, 0,
                        [=] { return BARAKA_NEXT(write)(descriptor, bytes, length); });
}

BARAKA_EXPORTED ssize_t writev(int descriptor, const iovec* parts, int count) {
  if (room() == nullptr || count <= 0) return BARAKA_NEXT(writev)(descriptor, parts, count);
  const std::size_t length = length_of(parts, static_cast<std::size_t>(count));
  return send_held_back({descriptor, nullptr, 0, nullptr, length}, 0,
                        [=] { return BARAKA_NEXT(writev)(descriptor, parts, count); });
}
