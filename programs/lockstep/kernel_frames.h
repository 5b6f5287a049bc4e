#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

namespace programs::lockstep {

/// What an agent's kernel puts on the air by its own timers, or with numbers that it draws at
/// random, made the run's own, so that equal runs have equal frames:
///
/// - Group membership (IGMP, RFC 3376; MLD, RFC 3810) and router solicitations (RFC 4861) are
///   dropped: no router is there to hear them, and their times are the kernel's.
/// - Redirects (RFC 792; RFC 4861, 8), which save a hop at best, are dropped: how many a station
///   sends is limited by the kernel's time.
/// - Address resolution (ARP, RFC 826; neighbour solicitations, RFC 4861) is repeated by virtual
///   time: every second (RETRANS_TIMER of RFC 4861, 10, which Linux uses for ARP, too) until it is
///   answered. Linux gives up after three requests and begins anew with the next packet; its timers
///   stand here, so it does neither. To a program that goes on sending this is the same.
/// - The identification of IPv4 packets is counted per agent (RFC 6864), that of the fragments of
///   one packet alike.
class KernelFrames {
 public:
  using Frame = std::span<const std::uint8_t>;

  /// A frame that the kernel wants to send at `now` [ns].
  /// @return the frame to be sent; empty: none. Valid until the next call.
  Frame on_sent(Frame ethernet, std::int64_t now);

  /// A frame that was delivered to the kernel: it may answer a request.
  void on_received(Frame ethernet);

  /// Sends requests again whose time has come.
  void repeat(std::int64_t now, const std::function<void(Frame)>& send);

  /// When the next request is to be repeated; none: none is open.
  std::optional<std::int64_t> next() const;

 private:
  struct Request {
    std::vector<std::uint8_t> frame;
    std::int64_t next = 0;
  };

  void number(std::span<std::uint8_t> packet);

  std::vector<std::uint8_t> frame_;
  std::map<std::vector<std::uint8_t>, Request> requests_;  ///< By the address that they ask for.
  /// Of packets whose last fragment has not come: by source, destination, protocol and the kernel's
  /// identification.
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint8_t, std::uint16_t>, std::uint16_t>
      fragmented_;
  std::uint16_t numbered_ = 0;
};

/// Whether an Ethernet frame holds a segment of TCP, at least the first fragment of one. Behind
/// IPv6 extension headers, which are rare, it is not found.
bool is_tcp(KernelFrames::Frame ethernet);

}  // namespace programs::lockstep
