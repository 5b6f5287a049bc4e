#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/radio/channel/channel.h"
#include "sim/radio/channel/neighbourhood.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/mac/frame_factory.h"
#include "sim/radio/phy/radio.h"
#include "sim/radio/phy/reception.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {

/// Keeps what a radio tells its MAC, as text: "busy", "idle", "start", "frame", "error", "sent".
class Listener final : public RadioListener {
 public:
  void on_medium_busy() override { said.emplace_back("busy"); }
  void on_medium_idle() override { said.emplace_back("idle"); }
  void on_receive_start() override { said.emplace_back("start"); }
  void on_receive(const ReceivedPpdu& received) override {
    said.emplace_back("frame");
    last_rssi = received.rssi;
    last_snr = received.snr;
  }
  void on_receive_error(ReceiveError error) override {
    said.emplace_back(error == ReceiveError::kCollision ? "collision" : "error");
  }
  void on_transmit_end(const Ppdu&) override { said.emplace_back("sent"); }

  std::vector<std::string> said;
  hal::Dbm last_rssi;
  hal::Decibels last_snr;
};

/// Radios without MACs: frames go out when the test says so.
class Bench {
 public:
  explicit Bench(Profile profile) : config(profile_defaults(profile)) {}

  void add(const hal::Vec3& at) {
    const auto address = static_cast<std::uint16_t>(agents_.size() + 1);
    agents_.push_back(hal::AgentId{address});
    antennas.place(agents_.back(), {at});
  }
  void build() {
    modes.emplace(config);
    propagation.emplace(config, wall);
    const WavesConfig& waves = *waves_of(config);
    std::vector<Neighbourhood::Antenna> stations;
    for (const hal::AgentId agent : agents_) stations.push_back({agent, waves.tx_power});
    neighbourhood.emplace(events, antennas, *propagation, stations);
    rules.emplace(waves.receiver);
    channel.emplace(events, *neighbourhood, log, waves);
    for (StationIndex i = 0; i < agents_.size(); ++i) {
      radios.push_back(
          std::make_unique<Radio>(Radio::Air{events, *channel, log, waves.receiver, *rules}, i,
                                  agents_[i], hal::RandomStream(1, std::to_string(i))));
      listeners.push_back(std::make_unique<Listener>());
      radios.back()->attach(*listeners.back());
      channel->add(*radios.back());
      factories.push_back(std::make_unique<FrameFactory>(waves.lengths, *modes, agents_[i]));
    }
  }
  Radio& radio(std::uint16_t station) { return *radios.at(station - 1u); }
  const std::vector<std::string>& said(std::uint16_t station) {
    return listeners.at(station - 1u)->said;
  }

  /// A broadcast of so many bytes leaves this station at this time.
  void send_at(hal::Duration time, std::uint16_t station, std::size_t bytes = 0) {
    const FramePtr frame = factories.at(station - 1u)
                               ->data({.destination = hal::kEveryone,
                                       .payload = std::make_shared<const hal::Bytes>(bytes)},
                                      {});
    events.schedule(hal::Time{} + time, Rank::kRadio, hal::AgentId{station},
                    [this, station, frame] { radio(station).transmit(ppdu_of(frame)); });
  }
  void run() {
    while (events.next_time()) events.run_next();
  }

  RadioConfig config;
  EventQueue events;
  PlacedAntennas antennas;
  Wall wall;
  Log log;
  std::optional<ModeSet> modes;
  std::optional<Propagation> propagation;
  std::optional<Neighbourhood> neighbourhood;
  std::optional<ReceptionRules> rules;
  std::optional<Channel> channel;
  std::vector<std::unique_ptr<Radio>> radios;
  std::vector<std::unique_ptr<Listener>> listeners;
  std::vector<std::unique_ptr<FrameFactory>> factories;

 private:
  std::vector<hal::AgentId> agents_;
};

}  // namespace sim::radio::test
