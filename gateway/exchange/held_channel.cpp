#include "gateway/exchange/held_channel.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace gateway::exchange {
namespace {

struct HeldHead {
  std::uint32_t kind = 0, length = 0;
};

constexpr std::size_t kReadAtOnce = 65'536;

/// One recvmsg(), with the number of the process that sent. @return as recvmsg().
ssize_t receive_some(int socket, std::array<std::uint8_t, kReadAtOnce>& bytes, pid_t& sender) {
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(ucred))> control{};
  iovec part{bytes.data(), bytes.size()};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t size = recvmsg(socket, &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
  if (size <= 0) return size;
  for (const cmsghdr* one = CMSG_FIRSTHDR(&message); one != nullptr;
       one = CMSG_NXTHDR(&message, const_cast<cmsghdr*>(one))) {
    if (one->cmsg_level != SOL_SOCKET || one->cmsg_type != SCM_CREDENTIALS) continue;
    ucred credentials{};
    std::memcpy(&credentials, CMSG_DATA(one), sizeof credentials);
    sender = credentials.pid;
  }
  return size;
}

}  // namespace

void HeldChannel::put(const HeldMessage& message) {
  const HeldHead head{static_cast<std::uint32_t>(message.kind),
                      static_cast<std::uint32_t>(message.bytes.size())};
  std::array<std::uint8_t, sizeof head> bytes{};
  std::memcpy(bytes.data(), &head, sizeof head);
  out_.insert(out_.end(), bytes.begin(), bytes.end());
  out_.insert(out_.end(), message.bytes.begin(), message.bytes.end());
}

bool HeldChannel::flush() {
  std::size_t sent = 0;
  const int flags = MSG_NOSIGNAL | (sends_ == Sends::kAtOnce ? MSG_DONTWAIT : 0);
  while (sent < out_.size()) {
    const ssize_t some = send(socket_.number(), out_.data() + sent, out_.size() - sent, flags);
    if (some < 0 && errno == EINTR) continue;
    if (some < 0 && errno != EAGAIN) is_closed_ = true;
    if (some <= 0) break;
    sent += static_cast<std::size_t>(some);
  }
  out_.erase(out_.begin(), out_.begin() + static_cast<std::ptrdiff_t>(sent));
  return sent > 0;
}

bool HeldChannel::receive() {
  std::array<std::uint8_t, kReadAtOnce> bytes;
  bool is_any = false;
  while (!is_closed_) {
    const ssize_t some = receive_some(socket_.number(), bytes, peer_);
    if (some < 0 && errno == EINTR) continue;
    if (some < 0 && errno == EAGAIN) break;
    if (some <= 0) {
      is_closed_ = true;
      break;
    }
    in_.insert(in_.end(), bytes.begin(), bytes.begin() + some);
    is_any = true;
  }
  return is_any;
}

std::optional<HeldMessage> HeldChannel::take() {
  HeldHead head;
  if (in_.size() < sizeof head) return std::nullopt;
  std::memcpy(&head, in_.data(), sizeof head);
  if (head.length > kMost) {
    is_closed_ = true;
    return std::nullopt;
  }
  const auto begin = in_.begin() + sizeof head;
  if (in_.end() - begin < static_cast<std::ptrdiff_t>(head.length)) return std::nullopt;
  HeldMessage message{static_cast<HeldKind>(head.kind), {begin, begin + head.length}};
  in_.erase(in_.begin(), begin + head.length);
  return message;
}

HeldEnds make_held_ends() {
  std::array<int, 2> ends{-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::runtime_error(
        fmt::format("the exchange with a held controller: {}", std::strerror(errno)));
  }
  const int on = 1;
  setsockopt(ends[0], SOL_SOCKET, SO_PASSCRED, &on, sizeof on);
  return {process::OwnedDescriptor(ends[0]), process::OwnedDescriptor(ends[1])};
}

std::optional<process::OwnedDescriptor> take_held_end() {
  const char* const variable = std::getenv(kHeldVariable);
  if (variable == nullptr) return std::nullopt;
  const std::string text = variable;
  unsetenv(kHeldVariable);
  struct stat status {};
  int number = -1;
  std::from_chars(text.data(), text.data() + text.size(), number);
  if (number <= 2 || fstat(number, &status) != 0 || !S_ISSOCK(status.st_mode)) {
    throw std::runtime_error(fmt::format("{}: '{}' is no inherited socket", kHeldVariable, text));
  }
  fcntl(number, F_SETFD, FD_CLOEXEC);
  return process::OwnedDescriptor(number);
}

}  // namespace gateway::exchange
