#pragma once

#include <netinet/in.h>

#include <stdexcept>
#include <string>

namespace hal::robot::radio {

/// The address from which a node sends, and that with which it reaches all its neighbours.
struct UdpAddresses {
  in_addr own{};
  in_addr broadcast{};  ///< Broadcast address of the same network.
  /// Index of the interface; it changes when the interface is removed and added again.
  unsigned interface = 0;
};
bool operator==(const UdpAddresses& a, const UdpAddresses& b);

/// The addresses of a network interface.
/// @param interface  e.g. "eth0".
/// @param address    one of the interface's IPv4 addresses in dotted form; for a loopback interface
///   any address of its network (all of 127.0.0.0/8 answer); empty: the first one.
/// @throws NoAddressYet
/// @throws std::runtime_error  naming the existing interfaces, or the interface's addresses.
UdpAddresses find_addresses(const std::string& interface, const std::string& address);

/// The interface exists but has no address yet: it is not up, DHCP has not answered, …
struct NoAddressYet : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @param address  in dotted form.
/// @throws std::runtime_error  if no interface has it, naming the existing addresses.
void require_address(const std::string& address);

/// In dotted form.
std::string to_string(in_addr address);

}  // namespace hal::robot::radio
