#include "hal/files/recording/link_layer.h"

#include <fmt/format.h>

#include "hal/files/recording/file_fault.h"
#include "hal/rtps/ip_packet.h"

namespace hal::files::recording {
namespace {

using rtps::Cursor;
using rtps::Endianness;

/// tcpdump.org/linktypes.html
enum LinkType : std::uint16_t {
  kNull = 0,
  kEthernet = 1,
  kRaw = 101,
  kIeee80211 = 105,
  kLoop = 108,
  kLinuxSll = 113,
  kRadiotap = 127,
  kIpv4 = 228,
  kIpv6 = 229,
  kLinuxSll2 = 276,
};

constexpr std::uint16_t kVlan = 0x8100, kServiceVlan = 0x88a8;

void read_ethernet(Octets octets, const OnNetworkPacket& on_packet) {
  Cursor cursor(octets, Endianness::kBig);
  cursor.take(12);  // addresses
  std::uint16_t type = cursor.u16();
  while (type == kVlan || type == kServiceVlan) {
    cursor.take(2);
    type = cursor.u16();
  }
  if (!cursor.is_short()) on_packet({type, cursor.take(cursor.left())});
}

/// @param protocol  offset of the Ethertype, octets.  @param size  of the header.
void read_cooked(Octets octets, std::size_t protocol, std::size_t size,
                 const OnNetworkPacket& on_packet) {
  if (octets.size() < size) return;
  on_packet({Cursor(octets.subspan(protocol), Endianness::kBig).u16(), octets.subspan(size)});
}

void read_raw(Octets octets, const OnNetworkPacket& on_packet) {
  const unsigned version = Cursor(octets, Endianness::kBig).u8() >> 4U;
  if (version == 4) on_packet({rtps::kEthertypeIpv4, octets});
  if (version == 6) on_packet({rtps::kEthertypeIpv6, octets});
}

}  // namespace

void LinkLayer::read(const CapturedPacket& packet, const OnNetworkPacket& on_packet) {
  const Octets octets = packet.octets;
  switch (packet.link_type) {
    case kEthernet:
      return read_ethernet(octets, on_packet);
    case kLinuxSll:
      return read_cooked(octets, 14, 16, on_packet);
    case kLinuxSll2:
      return read_cooked(octets, 0, 20, on_packet);
    case kNull:
    case kLoop:
      return read_raw(octets.subspan(std::min<std::size_t>(4, octets.size())), on_packet);
    case kRaw:
    case kIpv4:
    case kIpv6:
      return read_raw(octets, on_packet);
    case kIeee80211:
      return wireless_.read(packet.at, octets, on_packet);
    case kRadiotap:
      return wireless_.read_radiotap(packet.at, octets, on_packet);
    default:
      throw FileFault{0, fmt::format("packets of link type {} are not read: Ethernet (1), raw IP "
                                     "(101), IEEE 802.11 (105, 127) and Linux cooked captures "
                                     "(113, 276) are",
                                     packet.link_type)};
  }
}

}  // namespace hal::files::recording
