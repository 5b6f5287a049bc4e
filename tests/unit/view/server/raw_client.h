#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <string>
#include <string_view>

namespace view::server::test {

/// How long one waits for the next bytes.
inline void set_patience(int socket, int milliseconds) {
  const timeval patience{.tv_sec = milliseconds / 1000, .tv_usec = milliseconds % 1000 * 1000};
  ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
}

/// A connection to a port of this computer.
inline int connected(int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
    return socket;
  }
  ::close(socket);
  return -1;
}

/// Sends bytes to a port of this computer and reads until the other side closes.
/// @param patience  ms: if nothing comes for so long, the other side is told that no more will be
///   sent, and has 5 s to close.
/// @return what came.
inline std::string answer_to(int port, std::string_view bytes, int patience = 5000) {
  const int socket = connected(port);
  if (socket < 0) return "";
  set_patience(socket, patience);
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) break;  // it need not listen to the end
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  std::string answer;
  char part[4096];
  bool is_told = false;
  while (true) {
    const ssize_t size = ::recv(socket, part, sizeof part, 0);
    if (size > 0) {
      answer.append(part, static_cast<std::size_t>(size));
    } else if (size == 0 || is_told || ::shutdown(socket, SHUT_WR) != 0) {
      break;
    } else {
      is_told = true;
      set_patience(socket, 5000);
    }
  }
  ::close(socket);
  return answer;
}

}  // namespace view::server::test
