#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/radio/mac_header.h"
#include "sim/radio/radio_use.h"

namespace sim::radio {

/// Type of the payload, as in Ethernet II. Several clients share one radio, one per type.
using Ethertype = std::uint16_t;
inline constexpr Ethertype kEthertypeRouting = 0x88b5;  ///< IEEE Std 802-2014: local experimental.

/// Largest payload of a frame, bytes (IEEE Std 802.11-2016, 9.2.4.7).
inline constexpr std::size_t kMaxMsdu = 2304;

/// 48 bits of a multicast address, the first octet highest: 0x01005e000001. 0: none, which with
/// kEveryone is the broadcast address.
using GroupAddress = std::uint64_t;

using Payload = std::shared_ptr<const hal::Bytes>;

struct MacRequest {
  hal::AgentId destination;  ///< kEveryone: broadcast.
  Ethertype ethertype = kEthertypeRouting;
  std::uint8_t priority = 0;  ///< 0..7, IEEE Std 802.1D; kept, DCF does not use it.
  Payload payload;
  std::uint64_t tag = 0;   ///< Given back in on_transmitted.
  MacHeader header{};      ///< Of the layers below the MacSap; clients leave it alone.
  GroupAddress group = 0;  ///< Of a frame to kEveryone: for whom of them.
};

struct MacIndication {
  hal::AgentId source;  ///< Who sent it first; RSSI and SNR are those of the last transmitter.
  hal::AgentId destination;
  Payload payload;
  double rssi_dbm = 0;
  double snr_db = 0;  ///< Lowest SINR over the frame.
  Ethertype ethertype = kEthertypeRouting;
  GroupAddress group = 0;  ///< As in MacRequest.
};

/// User of a radio: routing, or the interface of programs.
class MacClient {
 public:
  virtual ~MacClient() = default;
  virtual void on_receive(const MacIndication& indication) = 0;
  /// Exactly once per request: kDelivered (acknowledged; broadcast: sent), kRetryLimit, kQueueFull,
  /// kRadioOff, kExpired; of an access point also kNoRoute (the destination is nowhere associated).
  /// Never from within transmit().
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
  /// @pre no client of this type yet. The client outlives the station.
  virtual void add_client(Ethertype ethertype, MacClient& client) = 0;
  /// @pre payload <= kMaxMsdu and there is a client for the type.
  virtual void transmit(const MacRequest& request) = 0;
  /// Off: the frame on the air is cut, the queue is dropped with kRadioOff, NAV and backoff reset.
  virtual void set_radio(bool on) = 0;
  virtual bool radio_on() const = 0;
  virtual RadioUse use() const = 0;
  /// Tells a listener what the radio does now, and every change of it: what use() is the sum of.
  /// @param listener  the only one; null: nobody. Outlives the station, or is taken back.
  virtual void set_use_listener(RadioUseListener* listener) = 0;
  /// Expected time from request to the end of the exchange for a frame queued now.
  virtual hal::Duration expected_delay() const = 0;
  /// How many requests more would be taken now.
  virtual std::size_t room() const = 0;
  /// How many requests have been taken and have not ended.
  virtual std::size_t waiting() const = 0;
  /// Energy to transmit `bytes` of payload once [J].
  virtual double transmit_energy(std::size_t bytes) const = 0;
};

}  // namespace sim::radio
