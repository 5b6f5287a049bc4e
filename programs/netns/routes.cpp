#include "programs/netns/routes.h"

#include <arpa/inet.h>
#include <linux/rtnetlink.h>
#include <net/if.h>

#include <array>
#include <cstring>
#include <span>
#include <string>

#include "programs/netns/addresses.h"
#include "programs/netns/interface.h"
#include "programs/netns/netlink.h"

namespace programs::netns {
namespace {

/// A request of rtnetlink(7) with room for its attributes.
class RouteRequest {
 public:
  explicit RouteRequest(const KernelRoute& route) {
    request_.header.nlmsg_len = NLMSG_LENGTH(sizeof request_.route);
    request_.header.nlmsg_type = RTM_NEWROUTE;
    request_.header.nlmsg_flags = NLM_F_CREATE | NLM_F_EXCL;
    request_.route.rtm_family = route.is_ipv6 ? AF_INET6 : AF_INET;
    request_.route.rtm_dst_len = static_cast<std::uint8_t>(route.prefix);
    request_.route.rtm_table = RT_TABLE_MAIN;
    request_.route.rtm_protocol = RTPROT_STATIC;
    request_.route.rtm_scope = RT_SCOPE_UNIVERSE;
    request_.route.rtm_type = RTN_UNICAST;
    if (route.prefix > 0) add(RTA_DST, std::span(route.destination).first(route.is_ipv6 ? 16 : 4));
    const auto interface = static_cast<std::uint32_t>(if_nametoindex(kInterface));
    add(RTA_OIF, bytes_of(interface));
  }

  /// IPv4: the gateway is on the link even if its address is on no network of the link.
  void set_gateway(std::uint32_t address) {
    request_.route.rtm_flags = RTNH_F_ONLINK;
    const std::uint32_t octets = htonl(address);
    add(RTA_GATEWAY, bytes_of(octets));
  }
  void set_gateway(const Ipv6& address) { add(RTA_GATEWAY, address); }
  void set_link_scope() { request_.route.rtm_scope = RT_SCOPE_LINK; }

  nlmsghdr& header() { return request_.header; }

 private:
  static std::array<std::uint8_t, 4> bytes_of(std::uint32_t value) {
    std::array<std::uint8_t, 4> bytes{};
    std::memcpy(bytes.data(), &value, bytes.size());
    return bytes;
  }

  void add(std::uint16_t type, std::span<const std::uint8_t> value) {
    const rtattr attribute{static_cast<std::uint16_t>(RTA_LENGTH(value.size())), type};
    char* const at = reinterpret_cast<char*>(&request_) + NLMSG_ALIGN(request_.header.nlmsg_len);
    std::memcpy(at, &attribute, sizeof attribute);
    std::memcpy(at + RTA_LENGTH(0), value.data(), value.size());
    request_.header.nlmsg_len = NLMSG_ALIGN(request_.header.nlmsg_len) + attribute.rta_len;
  }

  struct {
    nlmsghdr header;
    rtmsg route;
    std::array<char, 64> attributes;  // destination and gateway of 20 bytes each, interface of 8
  } request_{};
};

void add(const Netlink& netlink, const KernelRoute& route) {
  RouteRequest request(route);
  if (route.is_ipv6 && route.via != 0) {
    request.set_gateway(link_local_address(route.via));
  } else if (!route.is_ipv6 && route.gateway != 0) {
    request.set_gateway(route.gateway);
  } else if (!route.is_ipv6) {
    request.set_link_scope();
  }
  netlink.ask(request.header(), "a route of wlan0");
}

void write_setting(const std::string& key, const char* value) {
  const std::string path = "/proc/sys/net/" + key;
  const FileDescriptor file = open_file(path, O_WRONLY);
  if (write(file.get(), value, 1) != 1) fail(path);
}

void be_router(bool with_ipv6) {
  write_setting("ipv4/ip_forward", "1");  // first: it resets what follows
  if (with_ipv6) write_setting("ipv6/conf/all/forwarding", "1");
}

void refuse_redirects(bool with_ipv6) {
  for (const char* conf : {"all", kInterface}) {
    const std::string folder = std::string("conf/") + conf;
    write_setting("ipv4/" + folder + "/send_redirects", "0");
    write_setting("ipv4/" + folder + "/accept_redirects", "0");
    if (with_ipv6) write_setting("ipv6/" + folder + "/accept_redirects", "0");
  }
}

}  // namespace

void set_routes(const AgentNetwork& own) {
  if (own.routes.empty() && !own.forwards) return;
  const bool with_ipv6 = has_ipv6(own);
  if (own.forwards) be_router(with_ipv6);
  refuse_redirects(with_ipv6);
  const Netlink netlink;
  for (const KernelRoute& route : own.routes) {
    if (with_ipv6 || !route.is_ipv6) add(netlink, route);
  }
}

}  // namespace programs::netns
