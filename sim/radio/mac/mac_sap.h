#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/radio/mac/mac_header.h"
#include "sim/radio/phy/radio_use.h"

namespace sim::radio {

/// Type of the payload, as in Ethernet II. Several clients share one radio, one per type.
using Ethertype = std::uint16_t;
inline constexpr Ethertype kEthertypeRouting = 0x88b5;  ///< IEEE Std 802-2014: local experimental.

/// Largest payload of a frame, bytes (IEEE Std 802.11-2016, 9.2.4.7).
inline constexpr std::size_t kMaxMsdu = 2304;

/// 48 bits of a multicast address, first octet most significant: 0x01005e000001. 0: no group; with
/// kEveryone this is the broadcast address.
using GroupAddress = std::uint64_t;

using Payload = std::shared_ptr<const hal::Bytes>;

struct MacRequest {
  hal::AgentId destination;  ///< kEveryone: broadcast.
  Ethertype ethertype = kEthertypeRouting;
  std::uint8_t priority = 0;  ///< 0 .. 7, IEEE Std 802.1D; carried along, not used by the DCF.
  Payload payload;
  std::uint64_t tag = 0;   ///< Returned in on_transmitted().
  MacHeader header{};      ///< For layers below the MacSap; clients leave it unset.
  GroupAddress group = 0;  ///< Group addressed by a frame to kEveryone.
};

struct MacIndication {
  hal::AgentId source;  ///< Original source; RSSI and SNR are those of the last transmitter.
  hal::AgentId destination;
  Payload payload;
  double rssi_dbm = 0;
  double snr_db = 0;  ///< Lowest SINR over the frame.
  Ethertype ethertype = kEthertypeRouting;
  GroupAddress group = 0;  ///< As in MacRequest.
};

/// User of a radio: routing, or the network interface of programs.
class MacClient {
 public:
  virtual ~MacClient() = default;
  virtual void on_receive(const MacIndication& indication) = 0;
  /// Called exactly once per request, never from within transmit(), with kDelivered (acknowledged;
  /// broadcast: sent), kRetryLimit, kQueueFull, kRadioOff, kExpired or kQueueDelay; from an access
  /// point also
  /// with kNoRoute (the destination is not associated with any access point).
  virtual void on_transmitted(std::uint64_t tag, hal::Verdict verdict) = 0;
};

struct MacCapabilities {
  bool tx_status = false;
  bool rssi = false;
};

/// Service access point of one station's MAC, for any MAC.
class MacSap {
 public:
  virtual ~MacSap() = default;
  virtual MacCapabilities capabilities() const = 0;
  /// Adds the client of a type, which outlives the station. @pre the type has no client yet.
  virtual void add_client(Ethertype ethertype, MacClient& client) = 0;
  /// @pre payload <= kMaxMsdu, and the type has a client.
  virtual void transmit(const MacRequest& request) = 0;
  /// Off: the frame on the air is cut off, queued requests end with kRadioOff, NAV and backoff are
  /// reset.
  virtual void set_radio(bool on) = 0;
  virtual bool radio_on() const = 0;
  virtual RadioUse use() const = 0;
  /// Reports the current activity of the radio, and each change of it, to a listener; use() is
  /// their sum.
  /// @param listener  replaces the previous one; null: none. Outlives the station, or is reset
  /// before its end.
  virtual void set_use_listener(RadioUseListener* listener) = 0;
  /// Expected time from the request to the end of the exchange for a frame queued now.
  virtual hal::Duration expected_delay() const = 0;
  /// Number of further requests that would be accepted now.
  virtual std::size_t room() const = 0;
  /// Number of requests that were accepted and have not ended.
  virtual std::size_t waiting() const = 0;
  /// Energy to transmit `bytes` of payload once [J].
  virtual double transmit_energy(std::size_t bytes) const = 0;
};

}  // namespace sim::radio
