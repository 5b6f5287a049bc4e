#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/core/event_queue.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/radio_network.h"

namespace sim::radio::test {

/// Antennas at places that tests set; each moves in a straight line if it is given a velocity.
class PlacedAntennas final : public Positions {
 public:
  struct Antenna {
    hal::Vec3 start;
    hal::Vec3 velocity{};
    std::array<double, 4> attitude{1, 0, 0, 0};
    double fastest = 0;  ///< m/s, max_speed() is at least this.
  };
  bool is_remembering = false;  ///< Whether positions may be asked for later.

  void place(hal::AgentId agent, const Antenna& antenna) { antennas_[agent] = antenna; }

  hal::Vec3 position(hal::AgentId agent, hal::Time at) const override {
    const Antenna& antenna = antennas_.at(agent);
    return antenna.start + hal::to_seconds(at) * antenna.velocity;
  }
  hal::Vec3 velocity(hal::AgentId agent, hal::Time) const override {
    return antennas_.at(agent).velocity;
  }
  std::array<double, 4> attitude(hal::AgentId agent, hal::Time) const override {
    return antennas_.at(agent).attitude;
  }
  hal::Time valid_until(hal::AgentId agent, hal::Time at) const override {
    return max_speed(agent) > 0 ? at : hal::Time::max();
  }
  bool remembers(hal::AgentId) const override { return is_remembering; }
  double max_speed(hal::AgentId agent) const override {
    const hal::Vec3 v = antennas_.at(agent).velocity;
    return std::max(std::abs(v.x) + std::abs(v.y) + std::abs(v.z), antennas_.at(agent).fastest);
  }

 private:
  std::map<hal::AgentId, Antenna> antennas_;
};

/// One wall: the plane x = at, with a loss for everything that crosses it.
class Wall final : public Obstacles {
 public:
  double at = 1e9;  ///< m
  hal::Decibels crossing{};
  hal::Decibels loss(const hal::Vec3& from, const hal::Vec3& to) const override {
    return (from.x < at) == (to.x < at) ? hal::Decibels{} : crossing;
  }
};

/// Keeps everything there was to see.
class Log final : public RadioObserver {
 public:
  struct Start {
    hal::Time at;
    Frame frame;
  };
  struct Reception {
    hal::Time at;
    std::uint64_t frame;
    hal::AgentId receiver;
    hal::Verdict verdict;
    double rssi_dbm;
  };
  struct Association {
    hal::Time at;
    hal::AgentId station;
    std::optional<hal::AgentId> access_point;
  };
  void on_frame_start(hal::Time at, const Frame& frame) override { starts.push_back({at, frame}); }
  void on_faint(const Frame&, std::uint32_t radios) override { faint += radios; }
  void on_reception(hal::Time at, const Frame& frame, hal::AgentId receiver, hal::Verdict verdict,
                    double rssi_dbm) override {
    receptions.push_back({at, frame.id, receiver, verdict, rssi_dbm});
  }
  void on_delivered(hal::Time, const Frame&, hal::AgentId) override { ++delivered; }
  void on_request_end(hal::Time, hal::AgentId, hal::AgentId, hal::Verdict) override {
    ++request_ends;
  }
  void on_relay_lost(hal::Time, hal::AgentId, const MacRequest&, hal::Verdict verdict) override {
    relays_lost.push_back(verdict);
  }
  void on_association(hal::Time at, hal::AgentId station,
                      std::optional<hal::AgentId> access_point) override {
    associations.push_back({at, station, access_point});
  }

  /// Frame types and transmitters in order, e.g. "RTS1 CTS2 DATA1 ACK2".
  std::string story() const {
    static const char* const kNames[] = {"DATA",    "RTS",      "CTS",    "ACK",   "BEACON",
                                         "AUTH",    "DEAUTH",   "ASSOC?", "ASSOC", "REASSOC?",
                                         "REASSOC", "DISASSOC", "BAR",    "BA",    "ACTION"};
    std::string text;
    for (const Start& start : starts) {
      if (!text.empty()) text += ' ';
      text += kNames[static_cast<int>(start.frame.type)];
      text += std::to_string(start.frame.transmitter.value);
    }
    return text;
  }
  /// Verdict of the n-th frame (from 0) at a receiver; nothing if it did not notice the frame.
  std::vector<hal::Verdict> verdicts(std::size_t n, std::uint16_t receiver) const {
    std::vector<hal::Verdict> found;
    for (const Reception& reception : receptions) {
      if (reception.frame == starts.at(n).frame.id && reception.receiver.value == receiver) {
        found.push_back(reception.verdict);
      }
    }
    return found;
  }

  std::vector<Start> starts;
  std::vector<Reception> receptions;
  std::uint64_t faint = 0;  ///< Of all frames, the radios at which they were.
  int delivered = 0;
  int request_ends = 0;
  std::vector<hal::Verdict> relays_lost;
  std::vector<Association> associations;
};

/// A client that keeps what it is told.
class Inbox final : public MacClient {
 public:
  struct Received {
    hal::Time at;
    MacIndication indication;
  };
  struct Ended {
    hal::Time at;
    std::uint64_t tag;
    hal::Verdict verdict;
  };
  explicit Inbox(EventQueue& events) : events_(events) {}
  void on_receive(const MacIndication& indication) override {
    received.push_back({events_.now(), indication});
    if (forward) forward(indication);
  }
  void on_transmitted(std::uint64_t tag, hal::Verdict verdict) override {
    ended.push_back({events_.now(), tag, verdict});
    if (refill) refill();
  }

  std::vector<Received> received;
  std::vector<Ended> ended;
  std::function<void(const MacIndication&)> forward;
  std::function<void()> refill;

 private:
  EventQueue& events_;
};

/// A small radio world: stations 1, 2, 3, … with an inbox each. Set it up, then call build().
class Air {
 public:
  explicit Air(const RadioConfig& radio) : config(radio) {}
  explicit Air(Profile profile) : config(profile_defaults(profile)) {}

  /// @param name  names the random streams; empty: by address.
  void add(const hal::Vec3& at, const hal::Vec3& velocity = {}, std::string name = {}) {
    const hal::AgentId address{static_cast<std::uint16_t>(stations_.size() + 1)};
    if (name.empty()) name = "s" + std::to_string(address.value);
    antennas.place(address, {at, velocity});
    stations_.push_back({address, name});
  }
  void set_tx_power(std::uint16_t station, hal::Milliwatts power) {
    station_config(station).tx_power = power;
  }
  /// As StationConfig::access_points.
  void set_access_points(std::uint16_t station, const std::vector<std::string>& names) {
    stations_.at(station - 1u).radio.access_points = names;
  }
  RadioNetwork::Station& station(std::uint16_t address) { return stations_.at(address - 1u); }
  StationConfig& station_config(std::uint16_t address) { return station(address).radio; }
  /// On the x axis, the first at the origin.
  void add_line(int stations, double spacing) {
    for (int i = 0; i < stations; ++i) add({spacing * i, 0, 0});
  }
  void build() {
    network = std::make_unique<RadioNetwork>(
        config, stations_, RadioNetwork::Surroundings{events, antennas, wall, log, seed, *ground});
    for (const auto& station : stations_) {
      inboxes_.push_back(std::make_unique<Inbox>(events));
      network->sap(station.agent).add_client(kEthertypeRouting, *inboxes_.back());
    }
  }
  std::size_t size() const { return stations_.size(); }
  MacSap& sap(std::uint16_t station) { return network->sap(hal::AgentId{station}); }
  Inbox& inbox(std::uint16_t station) { return *inboxes_.at(station - 1u); }

  void send(std::uint16_t from, std::uint16_t to, std::size_t bytes = 0, std::uint64_t tag = 0) {
    sap(from).transmit({.destination = hal::AgentId{to},
                        .payload = std::make_shared<const hal::Bytes>(bytes),
                        .tag = tag});
  }
  void broadcast(std::uint16_t from, std::size_t bytes = 0) {
    send(from, hal::kEveryone.value, bytes);
  }
  /// Calls `action` at this time, before the radio's events of the time.
  template <class F>
  void at(hal::Duration time, F action) {
    actions_.push_back(std::make_unique<std::function<void()>>(std::move(action)));
    auto* const stored = actions_.back().get();
    events.schedule(hal::Time{} + time, Rank::kScenario, kWorld, [stored] { (*stored)(); });
  }
  void run(hal::Duration until = std::chrono::seconds{1}) {
    const hal::Time last = hal::Time{} + until;
    while (const auto next = events.next_time()) {
      if (*next > last) return;
      one_by_one ? events.run_next() : events.run_next(last);
    }
  }

  RadioConfig config;
  EventQueue events;
  PlacedAntennas antennas;
  Wall wall;
  Log log;
  std::uint64_t seed = 1;
  std::shared_ptr<const Ground> ground = kFlatGround;
  bool one_by_one = false;  ///< Every event waits in the queue for its turn.
  std::unique_ptr<RadioNetwork> network;

 private:
  std::vector<RadioNetwork::Station> stations_;
  std::vector<std::unique_ptr<Inbox>> inboxes_;
  std::vector<std::unique_ptr<std::function<void()>>> actions_;
};

}  // namespace sim::radio::test
