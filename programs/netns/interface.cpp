#include "programs/netns/interface.h"

#include <arpa/inet.h>
#include <linux/if_tun.h>
#include <linux/ipv6.h>
#include <linux/rtnetlink.h>
#include <linux/sockios.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <net/route.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstring>

#include "programs/netns/addresses.h"
#include "programs/netns/netlink.h"

namespace programs::netns {
namespace {

constexpr int kQueueLength = 10'000;   // frames: the ring of the TAP
constexpr int kLeastMtuOfIpv6 = 1280;  // RFC 8200, 5

ifreq request_for(const char* name) {
  ifreq request{};
  std::strncpy(request.ifr_name, name, IFNAMSIZ - 1);
  return request;
}

void ask(const FileDescriptor& socket, unsigned long what, void* request, const char* name) {
  if (ioctl(socket.get(), what, request) != 0) fail(std::string("interface ") + name);
}

FileDescriptor socket_of(int family) {
  FileDescriptor socket(::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket.is_open()) fail("a socket to set up interfaces");
  return socket;
}

void bring_up(const FileDescriptor& socket, const char* name) {
  ifreq request = request_for(name);
  ask(socket, SIOCGIFFLAGS, &request, name);
  request.ifr_flags = static_cast<short>(request.ifr_flags | IFF_UP);
  ask(socket, SIOCSIFFLAGS, &request, name);
}

sockaddr ipv4(std::uint32_t address) {
  sockaddr_in in{};
  in.sin_family = AF_INET;
  in.sin_addr.s_addr = htonl(address);
  sockaddr generic{};
  std::memcpy(&generic, &in, sizeof generic);
  return generic;
}

FileDescriptor make_tap() {
  constexpr const char* kDevice = "/dev/net/tun";
  FileDescriptor tap(open(kDevice, O_RDWR | O_CLOEXEC | O_NONBLOCK));
  if (!tap.is_open()) {
    const int error = errno;
    const bool is_refused = error == EACCES || error == EPERM;
    fail(is_refused ? "no access to /dev/net/tun, which interfaces of agents need; allow it with "
                      "'chmod 0666 /dev/net/tun'"
                    : "no /dev/net/tun, which interfaces of agents need; load it with 'modprobe "
                      "tun', or give it to the container with '--device /dev/net/tun'",
         error);
  }
  ifreq request = request_for(kInterface);
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  if (ioctl(tap.get(), TUNSETIFF, &request) != 0) fail("a TAP of /dev/net/tun");
  return tap;
}

void set_link(const FileDescriptor& socket, const AgentNetwork& network) {
  ifreq request = request_for(kInterface);
  request.ifr_hwaddr.sa_family = ARPHRD_ETHER;
  std::ranges::copy(mac_address(network.id), request.ifr_hwaddr.sa_data);
  ask(socket, SIOCSIFHWADDR, &request, kInterface);
  request = request_for(kInterface);
  request.ifr_mtu = network.mtu;
  ask(socket, SIOCSIFMTU, &request, kInterface);
}

/// By rtnetlink(7): SIOCSIFTXQLEN requires a privilege outside of the user namespace.
void set_queue_length() {
  struct {
    nlmsghdr header;
    ifinfomsg link;
    rtattr attribute;
    std::uint32_t length;
  } request{};
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = RTM_NEWLINK;
  request.link.ifi_index = static_cast<int>(if_nametoindex(kInterface));
  request.attribute = {sizeof request.attribute + sizeof request.length, IFLA_TXQLEN};
  request.length = kQueueLength;
  Netlink().ask(request.header, "the length of wlan0's queue");
}

void set_ipv4(const FileDescriptor& socket, const AgentNetwork& network) {
  const std::uint32_t mask = ~std::uint32_t{0} << (32 - network.prefix);
  const std::pair<unsigned long, std::uint32_t> values[] = {
      {SIOCSIFADDR, network.address},
      {SIOCSIFNETMASK, mask},
      {SIOCSIFBRDADDR, network.address | ~mask}};
  for (const auto& [what, value] : values) {
    ifreq request = request_for(kInterface);
    request.ifr_addr = ipv4(value);
    ask(socket, what, &request, kInterface);
  }
}

/// For all groups: without a default route they would have none.
void set_multicast_route(const FileDescriptor& socket) {
  constexpr std::uint32_t kGroups = 0xe0000000, kMask = 0xf0000000;  // 224.0.0.0/4
  std::string device = kInterface;
  rtentry route{};
  route.rt_dst = ipv4(kGroups);
  route.rt_genmask = ipv4(kMask);
  route.rt_flags = RTF_UP;
  route.rt_dev = device.data();
  ask(socket, SIOCADDRT, &route, "wlan0: the route of 224.0.0.0/4");
}

void add_unique_local(const AgentNetwork& network) {
  const FileDescriptor socket = socket_of(AF_INET6);
  in6_ifreq request{};
  const Ipv6 address = unique_local_address(network.id);
  std::memcpy(&request.ifr6_addr, address.data(), address.size());
  request.ifr6_prefixlen = kUniqueLocalPrefix;
  request.ifr6_ifindex = static_cast<int>(if_nametoindex(kInterface));
  ask(socket, SIOCSIFADDR, &request, "wlan0: its IPv6 address");
}

/// Turns off duplicate address detection, because addresses are unique, and router discovery,
/// because there is no router.
void quieten_ipv6() {
  for (const char* key : {"accept_dad", "dad_transmits", "accept_ra", "router_solicitations"}) {
    const std::string path = std::string("/proc/sys/net/ipv6/conf/") + kInterface + "/" + key;
    const FileDescriptor file = open_file(path, O_WRONLY);
    if (write(file.get(), "0", 1) != 1) fail(path);
  }
}

}  // namespace

bool has_ipv6(const AgentNetwork& network) {
  return network.mtu >= kLeastMtuOfIpv6 && access("/proc/sys/net/ipv6", F_OK) == 0;
}

FileDescriptor make_interfaces(const AgentNetwork& network) {
  const FileDescriptor socket = socket_of(AF_INET);
  FileDescriptor tap = make_tap();
  set_link(socket, network);
  set_queue_length();
  if (has_ipv6(network)) quieten_ipv6();
  bring_up(socket, "lo");
  set_ipv4(socket, network);
  bring_up(socket, kInterface);
  set_multicast_route(socket);
  if (has_ipv6(network)) add_unique_local(network);
  return tap;
}

}  // namespace programs::netns
