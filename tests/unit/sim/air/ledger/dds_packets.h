#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/unit/sim/air/ledger/replay.h"

namespace sim::air::test {

using Bytes = hal::Bytes;

/// Messages of RTPS as participants at agents 1, 2, … send them, little-endian.
class Rtps {
 public:
  /// @param from  whose participant it is: its GUID prefix is twelve times this octet.
  explicit Rtps(std::uint8_t from) {
    put({'R', 'T', 'P', 'S', 2, 3, 1, 15});
    put(prefix(from));
  }

  static Bytes prefix(std::uint8_t of) { return Bytes(12, of); }

  Rtps& data(std::uint32_t writer, std::uint32_t number, const Bytes& payload) {
    Bytes body = {0, 0, 16, 0, 0, 0, 0, 0};
    big(body, writer);
    little(body, 0);
    little(body, number);
    body.insert(body.end(), payload.begin(), payload.end());
    return submessage(0x15, 5, body);
  }
  /// A part of a sample of `all` fragments of 100 octets.
  Rtps& data_frag(std::uint32_t writer, std::uint32_t number, std::uint32_t fragment,
                  std::uint32_t all) {
    Bytes body = {0, 0, 28, 0, 0, 0, 0, 0};
    big(body, writer);
    little(body, 0);
    little(body, number);
    little(body, fragment);
    little(body, 1U | 100U << 16U);
    little(body, 100 * all);
    body.resize(body.size() + 100, 7);
    return submessage(0x16, 1, body);
  }
  Rtps& heartbeat(std::uint32_t writer, std::uint32_t last) {
    Bytes body = {0, 0, 0, 0};
    big(body, writer);
    for (const std::uint32_t word : {0U, 1U, 0U, last, 1U}) little(body, word);
    return submessage(0x07, 1, body);
  }
  Rtps& info_destination(std::uint8_t to) { return submessage(0x0e, 1, prefix(to)); }
  /// What SEDP says of a writer or reader of the sender's.
  Rtps& sedp(std::uint8_t from, std::uint32_t entity, const std::string& topic,
             bool reliable = true) {
    Bytes list = {0, 3, 0, 0};
    parameter(list, 0x0005, text(topic));
    parameter(list, 0x0007, text("type"));
    Bytes guid = prefix(from);
    big(guid, entity);
    parameter(list, 0x005a, guid);
    Bytes reliability;
    little(reliability, reliable ? 2 : 1);
    little(reliability, 0);
    little(reliability, 0);
    parameter(list, 0x001a, reliability);
    little(list, 1);
    const bool is_writer = (entity & 0x3fU) == 2 || (entity & 0x3fU) == 3;
    return data(is_writer ? 0x000003c2 : 0x000004c2, ++told_, list);
  }

  const Bytes& bytes() const { return bytes_; }

 private:
  static void little(Bytes& to, std::uint32_t word) {
    for (int i = 0; i < 4; ++i) to.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
  }
  static void big(Bytes& to, std::uint32_t word) {
    for (int i = 4; i-- > 0;) to.push_back(static_cast<std::uint8_t>(word >> (8 * i)));
  }
  static Bytes text(const std::string& value) {
    Bytes bytes;
    little(bytes, static_cast<std::uint32_t>(value.size() + 1));
    bytes.insert(bytes.end(), value.begin(), value.end());
    bytes.resize((bytes.size() + 4) / 4 * 4, 0);
    return bytes;
  }
  static void parameter(Bytes& to, std::uint16_t id, const Bytes& value) {
    little(to, id | static_cast<std::uint32_t>(value.size()) << 16U);
    to.insert(to.end(), value.begin(), value.end());
  }
  Rtps& submessage(std::uint8_t kind, std::uint8_t flags, const Bytes& body) {
    put({kind, flags, static_cast<std::uint8_t>(body.size()),
         static_cast<std::uint8_t>(body.size() >> 8U)});
    return put(body);
  }
  Rtps& put(const Bytes& bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }

  Bytes bytes_;
  std::uint32_t told_ = 0;
};

/// Packets of IPv4 with a datagram of UDP. @param mtu  of what they are cut to.
inline std::vector<Packet> udp(hal::Duration at, std::uint16_t from, hal::AgentId to,
                               const Bytes& payload, std::uint16_t id, std::size_t mtu = 1500) {
  const auto put = [](Bytes& bytes, std::size_t word) {
    bytes.push_back(static_cast<std::uint8_t>(word >> 8U));
    bytes.push_back(static_cast<std::uint8_t>(word));
  };
  Bytes datagram;
  for (const std::size_t word :
       {std::size_t{7411}, std::size_t{7411}, payload.size() + 8, std::size_t{0}})
    put(datagram, word);
  datagram.insert(datagram.end(), payload.begin(), payload.end());
  const std::size_t piece = (mtu - 20) / 8 * 8;
  std::vector<Packet> packets;
  for (std::size_t offset = 0; offset < datagram.size(); offset += piece) {
    const std::size_t size = std::min(piece, datagram.size() - offset);
    Bytes packet = {0x45, 0};
    put(packet, size + 20);
    put(packet, id);
    put(packet, offset / 8 | (offset + size < datagram.size() ? 0x2000U : 0U));
    for (const std::uint8_t octet : std::initializer_list<std::uint8_t>{64, 17, 0, 0, 10, 77, 0})
      packet.push_back(octet);
    packet.push_back(static_cast<std::uint8_t>(from));
    for (const std::uint8_t octet : std::initializer_list<std::uint8_t>{10, 77, 0})
      packet.push_back(octet);
    packet.push_back(static_cast<std::uint8_t>(to.value));
    packet.insert(packet.end(), datagram.begin() + static_cast<std::ptrdiff_t>(offset),
                  datagram.begin() + static_cast<std::ptrdiff_t>(offset + size));
    packets.push_back({.at = at,
                       .source = hal::AgentId{from},
                       .destination = to,
                       .type = kEthertypeIpv4,
                       .payload = std::make_shared<const Bytes>(packet)});
  }
  return packets;
}

}  // namespace sim::air::test
