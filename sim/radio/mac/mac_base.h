#pragma once

#include <utility>
#include <vector>

#include "sim/core/event_queue.h"
#include "sim/radio/cell.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/mac/mac_sap.h"
#include "sim/radio/mac/observer.h"
#include "sim/radio/phy/mode_set.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Receives the frames and reports of a MAC in place of its clients: the BSS layer.
class FrameListener {
 public:
  virtual ~FrameListener() = default;
  /// A frame to this station or to everyone; duplicates are removed.
  virtual void on_frame(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) = 0;
  /// As in MacClient::on_transmitted().
  virtual void on_sent(const MacRequest& request, hal::Verdict verdict) = 0;
};

/// The common part of all MACs: passes frames to clients, reports the results of requests,
/// estimates delay and energy.
class MacBase : public MacSap {
 public:
  struct Context {
    EventQueue& events;
    RadioObserver& observer;
    const ModeSet& modes;
    const LengthsConfig& lengths;
    hal::Milliwatts tx_power;
    hal::AgentId agent;
    const Cell& cell;
  };

  explicit MacBase(const Context& context);

  /// Replaces the clients. @pre called before the first frame; the listener outlives the MAC.
  void set_listener(FrameListener& listener) { listener_ = &listener; }

  void add_client(Ethertype ethertype, MacClient& client) final;
  hal::Duration expected_delay() const final;
  double transmit_energy(std::size_t bytes) const final;
  /// Sets the power into the antenna from which transmit_energy() computes.
  void set_tx_power(hal::Milliwatts power) { tx_power_ = power; }

 protected:
  /// Checks the preconditions of transmit().
  void check(const MacRequest& request) const;

  /// Passes the frame to the listener or its payload to the client of its type, if there is one.
  void hand_up(const Frame& frame, hal::Dbm rssi, hal::Decibels snr);

  /// Passes the payload to the client of its type, if there is one.
  void deliver(const Frame& frame, hal::Dbm rssi, hal::Decibels snr);
  void deliver(Ethertype ethertype, const MacIndication& indication);

  /// Reports the end of a request to its client: the caller's state must be up to date. Do not call
  /// from within a client's call; use report_later() there.
  void report(const MacRequest& request, hal::Verdict verdict);

  /// The same in a separate event at the current time.
  void report_later(MacRequest request, hal::Verdict verdict);

  /// Learns how long a unicast exchange took from the head of the queue to its end: running mean
  /// with weight 0.7 on the past (G. Di Caro, F. Ducatelle, L. M. Gambardella, "AntHocNet", PPSN
  /// VIII, 2004).
  void learn_service_time(hal::Duration took);

  /// Number of requests waiting or in service.
  virtual std::size_t queued() const = 0;

  EventQueue& events() const { return events_; }
  const ModeSet& modes() const { return modes_; }
  const LengthsConfig& lengths() const { return lengths_; }
  RadioObserver& observer() const { return observer_; }
  hal::AgentId agent() const { return agent_; }
  const Cell& cell() const { return cell_; }
  hal::Time now() const { return events_.now(); }

 private:
  MacClient* client_of(Ethertype ethertype) const;

  EventQueue& events_;
  RadioObserver& observer_;
  const ModeSet& modes_;
  const LengthsConfig& lengths_;
  hal::Milliwatts tx_power_;
  hal::AgentId agent_;
  const Cell& cell_;
  /// Copy of the first of clients_: most stations have no other, and it is looked up for every
  /// frame.
  std::pair<Ethertype, MacClient*> first_client_{0, nullptr};
  hal::Duration service_time_;
  std::vector<std::pair<Ethertype, MacClient*>> clients_;
  FrameListener* listener_ = nullptr;
};

}  // namespace sim::radio
