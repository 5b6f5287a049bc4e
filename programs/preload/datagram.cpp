#include "programs/preload/datagram.h"

#include <netinet/in.h>
#include <netinet/udp.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "programs/preload/intercepted.h"
#include "programs/preload/room.h"

namespace programs::preload {
namespace {

constexpr unsigned kLoopback = 1;  // index of the interface `lo` in every network namespace
constexpr std::size_t kUdpHeader = 8, kIpv4Header = 20, kIpv6Header = 40, kFragmentHeader = 8;

union Address {
  sockaddr any;
  sockaddr_in v4;
  sockaddr_in6 v6;
  sockaddr_storage storage;
};

class KeptErrno {
 public:
  ~KeptErrno() { errno = kept_; }
  KeptErrno() = default;
  KeptErrno(const KeptErrno&) = delete;
  KeptErrno& operator=(const KeptErrno&) = delete;

 private:
  int kept_ = errno;
};

/// Value of an option; -1: the socket does not have it.
int option_of(int socket, int level, int option) {
  int value = -1;
  socklen_t length = sizeof value;
  if (BARAKA_NEXT_QUIET(getsockopt)(socket, level, option, &value, &length) != 0) return -1;
  return value;
}

bool is_datagram_socket(int socket, int& family) {
  family = option_of(socket, SOL_SOCKET, SO_DOMAIN);
  if (family != AF_INET && family != AF_INET6 && family != AF_PACKET) return false;
  const int type = option_of(socket, SOL_SOCKET, SO_TYPE);
  return type == SOCK_DGRAM || type == SOCK_RAW;
}

bool is_ipv4_loopback(std::uint32_t network_order) {
  return ntohl(network_order) >> 24 == IN_LOOPBACKNET;
}

/// Multicast and broadcast go by the interface that the socket names, else by the route.
bool is_group_on_loopback(int socket) {
  in_addr interface {};
  socklen_t length = sizeof interface;
  if (BARAKA_NEXT_QUIET(getsockopt)(socket, IPPROTO_IP, IP_MULTICAST_IF, &interface, &length) ==
          0 &&
      is_ipv4_loopback(interface.s_addr)) {
    return true;
  }
  Address own{};
  length = sizeof own;
  return getsockname(socket, &own.any, &length) == 0 && own.any.sa_family == AF_INET &&
         is_ipv4_loopback(own.v4.sin_addr.s_addr);
}

bool stays_here_v4(int socket, std::uint32_t network_order) {
  const std::uint32_t address = ntohl(network_order);
  if (address == INADDR_ANY || is_ipv4_loopback(network_order)) return true;
  if (address == room()->interface().address) return true;
  return IN_MULTICAST(address) && is_group_on_loopback(socket);
}

bool stays_here_v6(int socket, const sockaddr_in6& to) {
  const in6_addr& address = to.sin6_addr;
  if (IN6_IS_ADDR_LOOPBACK(&address) || IN6_IS_ADDR_UNSPECIFIED(&address)) return true;
  const auto& own = room()->interface();
  const auto is_same = [&address](const auto& bytes) {
    return std::memcmp(&address, bytes.data(), bytes.size()) == 0;
  };
  if (is_same(own.link_local) || is_same(own.unique_local)) return true;
  if (!IN6_IS_ADDR_MULTICAST(&address)) return false;
  const unsigned scope = to.sin6_scope_id;
  return scope == kLoopback || (scope == 0 && option_of(socket, IPPROTO_IPV6, IPV6_MULTICAST_IF) ==
                                                  static_cast<int>(kLoopback));
}

/// The destination; false: it is not known.
bool destination_of(const Datagram& datagram, Address& to) {
  if (datagram.to != nullptr) {
    const auto length = std::min<std::size_t>(datagram.to_length, sizeof to);
    std::memcpy(&to, datagram.to, length);
    return length >= sizeof(sockaddr_in);
  }
  socklen_t length = sizeof to;
  return getpeername(datagram.socket, &to.any, &length) == 0;
}

/// UDP_SEGMENT of this message or of its socket [byte]; 0: none.
std::size_t segment_of(const Datagram& datagram) {
  if (datagram.message != nullptr) {
    // CMSG_NXTHDR() requires a non-const message
    auto& message = const_cast<msghdr&>(*datagram.message);
    for (cmsghdr* one = CMSG_FIRSTHDR(&message); one != nullptr; one = CMSG_NXTHDR(&message, one)) {
      if (one->cmsg_level != IPPROTO_UDP || one->cmsg_type != UDP_SEGMENT) continue;
      std::uint16_t segment = 0;
      std::memcpy(&segment, CMSG_DATA(one), sizeof segment);
      return segment;
    }
  }
  return static_cast<std::size_t>(
      std::max(0, option_of(datagram.socket, IPPROTO_UDP, UDP_SEGMENT)));
}

std::uint32_t frames_of_ip(const Datagram& datagram, bool is_ipv6) {
  const std::size_t mtu = room()->interface().mtu;
  const std::size_t header = is_ipv6 ? kIpv6Header : kIpv4Header;
  // The usual case; a header supplied by the program makes no further frame.
  if (header + kUdpHeader + datagram.length <= mtu) return 1;
  const bool is_raw = option_of(datagram.socket, SOL_SOCKET, SO_TYPE) == SOCK_RAW;
  const int protocol = option_of(datagram.socket, SOL_SOCKET, SO_PROTOCOL);
  if (is_raw || (protocol != IPPROTO_UDP && protocol != IPPROTO_UDPLITE)) {
    const bool has_header =
        is_raw && !is_ipv6 && option_of(datagram.socket, IPPROTO_IP, IP_HDRINCL) > 0;
    const std::size_t length =
        datagram.length - (has_header ? std::min(datagram.length, kIpv4Header) : 0);
    return fragments(length, mtu, is_ipv6);
  }
  const std::size_t segment = segment_of(datagram);
  if (segment != 0) return static_cast<std::uint32_t>((datagram.length + segment - 1) / segment);
  return fragments(datagram.length + kUdpHeader, mtu, is_ipv6);
}

}  // namespace

std::uint32_t fragments(std::size_t length, std::size_t mtu, bool is_ipv6) {
  const std::size_t whole = mtu - (is_ipv6 ? kIpv6Header : kIpv4Header);
  if (length <= whole) return 1;
  // All fragments but the last have a length that is a multiple of eight.
  const std::size_t last = is_ipv6 ? whole - kFragmentHeader : whole;
  const std::size_t each = last / 8 * 8;
  return static_cast<std::uint32_t>(1 + (length - last + each - 1) / each);
}

std::uint32_t frames_of(const Datagram& datagram) {
  const KeptErrno kept;
  int family = 0;
  if (!is_datagram_socket(datagram.socket, family)) return 0;
  if (family == AF_PACKET) return 1;
  Address to{};
  if (!destination_of(datagram, to)) return 0;
  if (to.any.sa_family == AF_INET) {
    return stays_here_v4(datagram.socket, to.v4.sin_addr.s_addr) ? 0
                                                                 : frames_of_ip(datagram, false);
  }
  if (to.any.sa_family != AF_INET6) return 0;
  if (IN6_IS_ADDR_V4MAPPED(&to.v6.sin6_addr)) {
    std::uint32_t inner = 0;
    std::memcpy(&inner, to.v6.sin6_addr.s6_addr + 12, sizeof inner);
    return stays_here_v4(datagram.socket, inner) ? 0 : frames_of_ip(datagram, false);
  }
  return stays_here_v6(datagram.socket, to.v6) ? 0 : frames_of_ip(datagram, true);
}

bool is_held_back(int descriptor) {
  const KeptErrno kept;
  int family = 0;
  if (!is_datagram_socket(descriptor, family)) return false;
  Address peer{};
  socklen_t length = sizeof peer;
  // the destination is given later
  if (getpeername(descriptor, &peer.any, &length) != 0) return true;
  return frames_of({descriptor, &peer.any, length, nullptr, 0}) != 0;
}

}  // namespace programs::preload
