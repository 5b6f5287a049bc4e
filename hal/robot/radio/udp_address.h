#pragma once

#include <netinet/in.h>

#include <stdexcept>
#include <string>

namespace hal::robot::radio {

/// Where a node sends from, and where it reaches all its neighbours.
struct UdpAddresses {
  in_addr own{};
  in_addr broadcast{};     ///< Of the same network.
  unsigned interface = 0;  ///< Its number: another one when it was away meanwhile.
};
bool operator==(const UdpAddresses& a, const UdpAddresses& b);

/// The addresses of a network interface.
/// @param interface  e.g. "eth0".
/// @param address    one of the interface's IPv4 addresses in dotted form, for a loopback interface
///                   any of its network (all of 127.0.0.0/8 answer); empty: the first one.
/// @throws NoAddressYet
/// @throws std::runtime_error  naming the interfaces there are, or the interface's addresses.
UdpAddresses find_addresses(const std::string& interface, const std::string& address);

/// The interface is there and waits for an address: it is not up yet, DHCP has not answered, …
struct NoAddressYet : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @param address  in dotted form.
/// @throws std::runtime_error  if no interface has it, naming those there are.
void require_address(const std::string& address);

/// In dotted form.
std::string to_string(in_addr address);

}  // namespace hal::robot::radio
