#include "hal/robot/radio/udp_address.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace hal::robot::radio {
namespace {

/// One IPv4 address of an interface.
struct Assigned {
  std::string interface;
  in_addr own{}, mask{};
  bool loopback = false;
};

in_addr ipv4(const sockaddr* address) {
  sockaddr_in in{};
  std::memcpy(&in, address, sizeof in);
  return in.sin_addr;
}

std::vector<Assigned> assigned_addresses() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) {
    throw std::system_error(errno, std::generic_category(), "cannot list network interfaces");
  }
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, freeifaddrs);
  std::vector<Assigned> all;
  for (const ifaddrs* one = list; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    if (one->ifa_netmask == nullptr) continue;
    all.push_back({one->ifa_name, ipv4(one->ifa_addr), ipv4(one->ifa_netmask),
                   (one->ifa_flags & IFF_LOOPBACK) != 0});
  }
  return all;
}

bool answers_to(const Assigned& assigned, in_addr address) {
  if (assigned.own.s_addr == address.s_addr) return true;
  const in_addr_t differs = assigned.own.s_addr ^ address.s_addr;
  return assigned.loopback && (differs & assigned.mask.s_addr) == 0;
}

in_addr dotted(const std::string& address) {
  in_addr parsed{};
  if (inet_pton(AF_INET, address.c_str(), &parsed) == 1) return parsed;
  throw std::runtime_error(fmt::format("'{}' is not an IPv4 address", address));
}

std::string names_of(const std::vector<Assigned>& all) {
  std::string names;
  for (const Assigned& one : all) {
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", one.interface, to_string(one.own));
  }
  return names.empty() ? "none" : names;
}

}  // namespace

std::string to_string(in_addr address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &address, text.data(), text.size());
  return text.data();
}

bool operator==(const UdpAddresses& a, const UdpAddresses& b) {
  return a.own.s_addr == b.own.s_addr && a.broadcast.s_addr == b.broadcast.s_addr &&
         a.interface == b.interface;
}

void require_address(const std::string& address) {
  const in_addr wanted = dotted(address);
  const std::vector<Assigned> all = assigned_addresses();
  for (const Assigned& one : all) {
    if (answers_to(one, wanted)) return;
  }
  throw std::runtime_error(fmt::format("no network interface has the address {}; there are: {}",
                                       address, names_of(all)));
}

UdpAddresses find_addresses(const std::string& interface, const std::string& address) {
  const in_addr wanted = address.empty() ? in_addr{} : dotted(address);
  const std::vector<Assigned> all = assigned_addresses();
  bool has_address = false;
  for (const Assigned& one : all) {
    if (one.interface != interface) continue;
    has_address = true;
    const in_addr own = address.empty() ? one.own : wanted;
    if (!answers_to(one, own)) continue;
    return {own, in_addr{own.s_addr | ~one.mask.s_addr}, if_nametoindex(interface.c_str())};
  }
  if (!has_address && if_nametoindex(interface.c_str()) != 0) {
    throw NoAddressYet(fmt::format("network interface '{}' has no IPv4 address yet", interface));
  }
  throw std::runtime_error(
      fmt::format("no network interface '{}' with {}; there are: {}", interface,
                  address.empty() ? "an IPv4 address" : "the address " + address, names_of(all)));
}

}  // namespace hal::robot::radio
