#include "gateway/guard/send_from.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>

namespace gateway::guard {
namespace {

sockaddr_in address_of(const rtps::Locator_t& locator) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(locator.port));
  std::copy_n(rtps::IPLocator::getIPv4(locator), sizeof(address.sin_addr),
              reinterpret_cast<rtps::octet*>(&address.sin_addr));
  return address;
}

}  // namespace

bool send_from(int socket, const rtps::octet* data, std::uint32_t size,
               rtps::LocatorsIterator& begin, const rtps::LocatorsIterator& end) {
  bool all = true;
  for (; begin != end; ++begin) {
    const rtps::Locator_t& to = *begin;
    if (to.kind != LOCATOR_KIND_UDPv4 || !rtps::IPLocator::isLocal(to)) continue;
    const sockaddr_in address = address_of(to);
    all &= sendto(socket, data, size, MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address),
                  sizeof(address)) >= 0;
  }
  return all;
}

}  // namespace gateway::guard
