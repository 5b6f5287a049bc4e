#include "programs/netns/netlink.h"

#include <sys/socket.h>

namespace programs::netns {

Netlink::Netlink() : socket_(socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE)) {
  if (!socket_.is_open()) fail("a socket to set up networks");
}

void Netlink::ask(nlmsghdr& request, const std::string& what) const {
  request.nlmsg_flags = static_cast<std::uint16_t>(request.nlmsg_flags | NLM_F_REQUEST | NLM_F_ACK);
  struct {
    nlmsghdr header;
    nlmsgerr error;
    nlmsghdr request;
  } answer{};
  if (::send(socket_.get(), &request, request.nlmsg_len, 0) < 0 ||
      recv(socket_.get(), &answer, sizeof answer, 0) < 0) {
    fail(what);
  }
  if (answer.error.error != 0) fail(what, -answer.error.error);
}

}  // namespace programs::netns
