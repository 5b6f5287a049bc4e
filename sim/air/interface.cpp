#include "sim/air/interface.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "sim/air/user_priority.h"
#include "sim/radio/mac/mac_address.h"

namespace sim::air {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array kEthertypes{kEthertypeIpv4, kEthertypeArp, kEthertypeIpv6};
constexpr std::size_t kSourceAt = radio::kAddressSize, kTypeAt = 2 * radio::kAddressSize,
                      kHeader = kTypeAt + 2;
constexpr radio::GroupAddress kBroadcast = 0xffffffffffff;
constexpr std::uint8_t kTcp = 6;  // protocol number, IANA

radio::Ethertype ethertype_of(Bytes ethernet) {
  return static_cast<radio::Ethertype>(ethernet[kTypeAt] << 8 | ethernet[kTypeAt + 1]);
}

bool is_station(hal::AgentId agent) { return agent.value >= 1 && agent.value <= hal::kLastAddress; }

/// Why `self` cannot send this frame; nullopt if it can.
std::optional<Refusal> refusal_of(Bytes ethernet, hal::AgentId self) {
  if (ethernet.size() < kHeader) return Refusal::kTooShort;
  if (std::ranges::find(kEthertypes, ethertype_of(ethernet)) == kEthertypes.end())
    return Refusal::kEthertype;
  if (ethernet.size() - kHeader > radio::kMaxMsdu) return Refusal::kTooLong;
  if (radio::get_address(ethernet.subspan(kSourceAt)) != self) return Refusal::kSource;
  if (radio::is_group(ethernet)) return std::nullopt;
  const auto destination = radio::get_address(ethernet);
  if (!destination || !is_station(*destination) || *destination == self)
    return Refusal::kDestination;
  return std::nullopt;
}

void put_ethertype(std::vector<std::uint8_t>& out, radio::Ethertype ethertype) {
  out.push_back(static_cast<std::uint8_t>(ethertype >> 8));
  out.push_back(static_cast<std::uint8_t>(ethertype & 0xff));
}

}  // namespace

Interface::Interface(hal::AgentId agent, radio::MacSap& mac, InterfaceListener& listener)
    : agent_(agent), mac_(mac), listener_(listener) {
  for (const radio::Ethertype ethertype : kEthertypes) mac_.add_client(ethertype, *this);
}

void Interface::send(Bytes ethernet) {
  if (const auto refusal = refusal_of(ethernet, agent_)) {
    return listener_.on_refused(agent_, *refusal, ethernet.size());
  }
  const Bytes packet = ethernet.subspan(kHeader);
  radio::MacRequest request{
      .destination = hal::kEveryone,
      .ethertype = ethertype_of(ethernet),
      .priority = user_priority(ethertype_of(ethernet), packet),
      .payload = std::make_shared<const hal::Bytes>(packet.begin(), packet.end()),
      .tag = ++last_tag_};
  if (!radio::is_group(ethernet)) {
    request.destination = *radio::get_address(ethernet);
  } else if (const auto group = radio::get_group(ethernet); group != kBroadcast) {
    request.group = group;
  }
  look_for_tcp(request.ethertype, packet);
  listener_.on_entered(agent_, request);
  mac_.transmit(request);
}

/// Looks only at the first header: TCP after IPv6 extension headers, which is rare, is not
/// detected.
void Interface::look_for_tcp(radio::Ethertype ethertype, Bytes packet) {
  constexpr std::size_t kProtocolOfIpv4 = 9, kNextHeaderOfIpv6 = 6;  // RFC 791, RFC 8200
  if (ethertype == kEthertypeArp) return;
  const std::size_t at = ethertype == kEthertypeIpv4 ? kProtocolOfIpv4 : kNextHeaderOfIpv6;
  has_seen_tcp_ = has_seen_tcp_ || (packet.size() > at && packet[at] == kTcp);
}

void Interface::on_receive(const radio::MacIndication& indication) {
  ethernet_.clear();
  const bool is_multicast = indication.destination == hal::kEveryone && indication.group != 0;
  if (is_multicast) {
    radio::put_group(ethernet_, indication.group);
  } else {
    radio::put_address(ethernet_, indication.destination);
  }
  radio::put_address(ethernet_, indication.source);
  put_ethertype(ethernet_, indication.ethertype);
  ethernet_.insert(ethernet_.end(), indication.payload->begin(), indication.payload->end());
  listener_.on_left(agent_, indication, ethernet_);
}

void Interface::on_transmitted(std::uint64_t, hal::Verdict) { listener_.on_ended(agent_); }

}  // namespace sim::air
