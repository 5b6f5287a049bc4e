#include "programs/netns/neighbours.h"

#include <arpa/inet.h>
#include <linux/neighbour.h>
#include <linux/rtnetlink.h>
#include <net/if.h>

#include <array>
#include <cstring>
#include <span>

#include "programs/netns/addresses.h"
#include "programs/netns/interface.h"
#include "programs/netns/netlink.h"

namespace programs::netns {
namespace {

constexpr std::size_t kMostAgents = 128;

struct Place {
  nlmsghdr header;
  ndmsg neighbour;
  rtattr attribute;
  std::array<std::uint8_t, 16> address;
};

void keep(const Netlink& netlink, std::uint8_t family, std::span<const std::uint8_t> address) {
  Place place{};
  const auto length = static_cast<std::uint16_t>(sizeof place.attribute + address.size());
  place.header.nlmsg_len = offsetof(Place, attribute) + length;
  place.header.nlmsg_type = RTM_NEWNEIGH;
  place.header.nlmsg_flags = NLM_F_CREATE;
  place.neighbour.ndm_family = family;
  place.neighbour.ndm_ifindex = static_cast<int>(if_nametoindex(kInterface));
  place.neighbour.ndm_state = NUD_NONE;
  place.neighbour.ndm_flags = NTF_EXT_LEARNED;
  place.attribute = {length, NDA_DST};
  std::memcpy(place.address.data(), address.data(), address.size());
  netlink.ask(place.header, "a place for a neighbour");
}

}  // namespace

void keep_places(const AgentNetwork& own, const std::vector<AgentNetwork>& all) {
  if (all.size() > kMostAgents) return;
  const Netlink netlink;
  const bool with_ipv6 = has_ipv6(own);
  for (const AgentNetwork& other : all) {
    if (other.id == own.id) continue;
    std::array<std::uint8_t, 4> ipv4{};
    const std::uint32_t address = htonl(other.address);
    std::memcpy(ipv4.data(), &address, ipv4.size());
    keep(netlink, AF_INET, ipv4);
    if (!with_ipv6) continue;
    keep(netlink, AF_INET6, link_local_address(other.id));
    keep(netlink, AF_INET6, unique_local_address(other.id));
  }
}

}  // namespace programs::netns
