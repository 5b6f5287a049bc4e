#include "programs/lockstep/kernel_frames.h"

#include <algorithm>

namespace programs::lockstep {
namespace {

using Frame = KernelFrames::Frame;

constexpr std::size_t kEthernet = 14, kIpv4 = 20, kIpv6 = 40;
constexpr std::uint16_t kTypeIpv4 = 0x0800, kTypeArp = 0x0806, kTypeIpv6 = 0x86dd;
constexpr std::int64_t kRepeatAfter = 1'000'000'000;

std::uint16_t word(Frame bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

std::uint32_t long_word(Frame bytes, std::size_t at) {
  return static_cast<std::uint32_t>(word(bytes, at)) << 16 | word(bytes, at + 2);
}

std::vector<std::uint8_t> part(Frame bytes, std::size_t at, std::size_t count) {
  const Frame some = bytes.subspan(at, count);
  return {some.begin(), some.end()};
}

std::uint16_t type_of(Frame ethernet) {
  return ethernet.size() < kEthernet ? std::uint16_t{0} : word(ethernet, kEthernet - 2);
}

/// Of an IPv6 packet that is one of ICMPv6, also behind hop-by-hop options; 0: it is another.
struct Icmpv6 {
  std::uint8_t type = 0;
  std::size_t at = 0;  ///< Of the type, in the frame.
};
Icmpv6 icmpv6_of(Frame ethernet) {
  constexpr std::uint8_t kHopByHop = 0, kIcmp = 58;
  if (type_of(ethernet) != kTypeIpv6 || ethernet.size() < kEthernet + kIpv6 + 8) return {};
  std::uint8_t next = ethernet[kEthernet + 6];
  std::size_t at = kEthernet + kIpv6;
  if (next == kHopByHop) {
    next = ethernet[at];
    at += 8 * (std::size_t{1} + ethernet[at + 1]);
  }
  if (next != kIcmp || at >= ethernet.size()) return {};
  return {ethernet[at], at};
}

bool is_dropped_ipv4(Frame ethernet) {
  constexpr std::uint8_t kIcmp = 1, kIgmp = 2, kRedirect = 5;
  if (ethernet.size() < kEthernet + kIpv4) return false;
  const std::uint8_t protocol = ethernet[kEthernet + 9];
  const std::size_t type_at = kEthernet + std::size_t{4} * (ethernet[kEthernet] & 0xf);
  const bool is_redirect =
      protocol == kIcmp && type_at < ethernet.size() && ethernet[type_at] == kRedirect;
  return protocol == kIgmp || is_redirect;
}

bool is_dropped(Frame ethernet) {
  if (type_of(ethernet) == kTypeIpv4) return is_dropped_ipv4(ethernet);
  const std::uint8_t type = icmpv6_of(ethernet).type;
  constexpr std::uint8_t kFirstOfMld = 130, kRouterSolicitation = 133, kRedirect = 137,
                         kReportOfMld2 = 143;
  return (type >= kFirstOfMld && type <= kRouterSolicitation) || type == kRedirect ||
         type == kReportOfMld2;
}

constexpr std::size_t kArpLength = kEthernet + 28;
constexpr std::uint8_t kNeighbourSolicitation = 135, kNeighbourAdvertisement = 136;
constexpr std::size_t kTargetAt = 8;  // behind the type of ICMPv6

/// The address that a frame asks for; empty: it is no request.
std::vector<std::uint8_t> asked_for(Frame ethernet) {
  constexpr std::uint16_t kRequest = 1;
  if (type_of(ethernet) == kTypeArp && ethernet.size() >= kArpLength) {
    if (word(ethernet, kEthernet + 6) != kRequest) return {};
    return part(ethernet, kEthernet + 24, 4);
  }
  const Icmpv6 icmp = icmpv6_of(ethernet);
  if (icmp.type != kNeighbourSolicitation || ethernet.size() < icmp.at + kTargetAt + 16) return {};
  return part(ethernet, icmp.at + kTargetAt, 16);
}

/// The address of whose place a frame tells; empty: none.
std::vector<std::uint8_t> told(Frame ethernet) {
  if (type_of(ethernet) == kTypeArp && ethernet.size() >= kArpLength)
    return part(ethernet, kEthernet + 14, 4);
  const Icmpv6 icmp = icmpv6_of(ethernet);
  if (icmp.type != kNeighbourAdvertisement || ethernet.size() < icmp.at + kTargetAt + 16) return {};
  return part(ethernet, icmp.at + kTargetAt, 16);
}

/// RFC 1071, over the header of an IPv4 packet.
void put_checksum(std::span<std::uint8_t> packet) {
  const std::size_t length = std::size_t{4} * (packet[0] & 0xf);
  packet[10] = packet[11] = 0;
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i + 1 < length; i += 2) sum += word(packet, i);
  while (sum >> 16 != 0) sum = (sum & 0xffff) + (sum >> 16);
  packet[10] = static_cast<std::uint8_t>(~sum >> 8);
  packet[11] = static_cast<std::uint8_t>(~sum);
}

}  // namespace

void KernelFrames::number(std::span<std::uint8_t> packet) {
  constexpr std::uint16_t kMoreFragments = 0x2000, kOffset = 0x1fff;
  const std::uint16_t fragment = word(packet, 6);
  const bool is_part = (fragment & (kMoreFragments | kOffset)) != 0;
  const std::tuple key{long_word(packet, 12), long_word(packet, 16), packet[9], word(packet, 4)};
  const auto known = is_part ? fragmented_.find(key) : fragmented_.end();
  const std::uint16_t number = known != fragmented_.end() ? known->second : ++numbered_;
  if (is_part && (fragment & kMoreFragments) != 0) fragmented_[key] = number;
  if (is_part && (fragment & kMoreFragments) == 0) fragmented_.erase(key);
  packet[4] = static_cast<std::uint8_t>(number >> 8);
  packet[5] = static_cast<std::uint8_t>(number);
  put_checksum(packet);
}

Frame KernelFrames::on_sent(Frame ethernet, std::int64_t now) {
  if (is_dropped(ethernet)) return {};
  frame_.assign(ethernet.begin(), ethernet.end());
  if (type_of(ethernet) == kTypeIpv4 && ethernet.size() >= kEthernet + kIpv4)
    number(std::span(frame_).subspan(kEthernet));
  if (auto address = asked_for(ethernet); !address.empty())
    requests_[std::move(address)] = {.frame = frame_, .next = now + kRepeatAfter};
  return frame_;
}

void KernelFrames::on_received(Frame ethernet) {
  if (requests_.empty()) return;
  requests_.erase(told(ethernet));
}

void KernelFrames::repeat(std::int64_t now, const std::function<void(Frame)>& send) {
  for (auto& [address, request] : requests_) {
    if (request.next > now) continue;
    send(request.frame);
    request.next += kRepeatAfter;
  }
}

std::optional<std::int64_t> KernelFrames::next() const {
  const auto first =
      std::ranges::min_element(requests_, {}, [](const auto& one) { return one.second.next; });
  if (first == requests_.end()) return std::nullopt;
  return first->second.next;
}

bool is_tcp(Frame ethernet) {
  constexpr std::uint8_t kTcp = 6;
  constexpr std::size_t kProtocolOfIpv4 = 9, kNextHeaderOfIpv6 = 6;  // RFC 791, RFC 8200
  const std::uint16_t type = type_of(ethernet);
  if (type != kTypeIpv4 && type != kTypeIpv6) return false;
  const std::size_t at = kEthernet + (type == kTypeIpv4 ? kProtocolOfIpv4 : kNextHeaderOfIpv6);
  return ethernet.size() > at && ethernet[at] == kTcp;
}

}  // namespace programs::lockstep
