#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "results/record/air_capture.h"
#include "results/record/air_log.h"
#include "results/record/recorder.h"
#include "sim/agents/observer_list.h"
#include "sim/air/ip_packet.h"
#include "tests/unit/results/record/test_run.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::air::test {

/// A frame of Ethernet that a program sent.
struct Packet {
  hal::Duration at{};  ///< Since the first one.
  hal::AgentId source, destination;
  radio::Ethertype type = 0;
  radio::GroupAddress group = 0;
  radio::Payload payload{};
  std::uint8_t priority = 0;
};

/// The last two octets of a MAC address are the agent's, see captures/README.md.
inline Packet to_packet(hal::Duration at, const std::vector<std::uint8_t>& frame) {
  const auto word = [&frame](std::size_t i) {
    return static_cast<std::uint16_t>(frame.at(i) << 8U | frame.at(i + 1));
  };
  Packet packet{.at = at, .source = {word(10)}, .destination = {word(4)}, .type = word(12)};
  if ((frame[0] & 1U) != 0) {
    packet.destination = hal::kEveryone;
    for (std::size_t i = 0; i < 6; ++i) packet.group = packet.group << 8U | frame[i];
    if (packet.group == 0xffffffffffff) packet.group = 0;
  }
  packet.payload = std::make_shared<const hal::Bytes>(frame.begin() + 14, frame.end());
  return packet;
}

/// A pcap file of link type Ethernet and times in us or ns (draft-ietf-opsawg-pcap).
inline std::vector<Packet> read_capture(const std::string& name) {
  std::ifstream in(TESTS_DIR "/unit/sim/air/ledger/captures/" + name + ".pcap", std::ios::binary);
  const std::vector<std::uint8_t> file{std::istreambuf_iterator<char>(in), {}};
  const auto word = [&file](std::size_t i) {
    std::uint32_t value = 0;
    for (std::size_t k = 4; k-- > 0;) value = value << 8U | file.at(i + k);
    return value;
  };
  const bool in_ns = word(0) == 0xa1b23c4d;
  if (!in_ns && word(0) != 0xa1b2c3d4) throw std::runtime_error(name + " is no capture");
  std::vector<Packet> packets;
  hal::Duration first{};
  for (std::size_t at = 24; at < file.size();) {
    const hal::Duration time = std::chrono::seconds{word(at)} +
                               hal::Duration{std::int64_t{word(at + 4)} * (in_ns ? 1 : 1000)};
    if (packets.empty()) first = time;
    const auto begin = file.begin() + static_cast<std::ptrdiff_t>(at) + 16;
    packets.push_back(to_packet(time - first, {begin, begin + word(at + 8)}));
    at += 16 + word(at + 8);
  }
  return packets;
}

/// Stations with interfaces on the air: what programs sent goes through a simulated radio, with a
/// record and a capture as a run has them. The programs are not there, so nobody answers to what is
/// lost now.
class Replay {
 public:
  explicit Replay(radio::RadioConfig radio, std::uint16_t stations = 3)
      : folder(testing::UnitTest::GetInstance()->current_test_info()->name()), stations_(stations) {
    config.radio = std::move(radio);
    options.frames = scenario::Detail::kAll;
    options.samples = scenario::Detail::kAll;
    for (std::uint16_t i = 1; i <= stations; ++i) {
      agents::AgentConfig agent;
      agent.id = hal::AgentId{i};
      agent.name = "s" + std::to_string(i);
      agent.body = agents::Station{};
      agent.network.emplace();
      config.agents.push_back(agent);
      antennas.place(agent.id, {{5.0 * i, 0, 0}});
    }
  }

  /// Before the first packet.
  void build() {
    recorder = std::make_unique<results::record::Recorder>(folder.file(), config, options);
    capture = std::make_unique<results::record::AirCapture>(
        folder.path() / "air.pcapng", results::record::AirCapture::Air{config.radio, {}},
        std::nullopt, "air");
    observers = std::make_unique<agents::ObserverList>(
        std::vector<agents::Observer*>{recorder.get(), capture.get()});
    std::vector<radio::RadioNetwork::Station> all;
    for (const auto& agent : config.agents) all.push_back({agent.id, agent.name, agent.radio});
    network = std::make_unique<radio::RadioNetwork>(
        config.radio, all,
        radio::RadioNetwork::Surroundings{events, antennas, wall, *observers, config.seed});
    for (const auto& agent : config.agents) {
      clients_.push_back(std::make_unique<Client>(*this, agent.id));
      for (const radio::Ethertype type : {kEthertypeIpv4, kEthertypeIpv6, kEthertypeArp})
        network->sap(agent.id).add_client(type, *clients_.back());
    }
  }

  void send(const std::vector<Packet>& packets) {
    for (const Packet& packet : packets) {
      auto* const kept = kept_.emplace_back(std::make_unique<Packet>(packet)).get();
      events.schedule(hal::Time{} + packet.at, Rank::kScenario, kWorld, [this, kept] {
        const radio::MacRequest request{.destination = kept->destination,
                                        .ethertype = kept->type,
                                        .priority = kept->priority,
                                        .payload = kept->payload,
                                        .tag = ++tag_,
                                        .group = kept->group};
        observers->on_air_entered(events.now(), kept->source, request);
        network->sap(kept->source).transmit(request);
      });
    }
  }

  void run(hal::Duration until) {
    const hal::Time last = hal::Time{} + until;
    while (const auto next = events.next_time()) {
      if (*next > last) break;
      events.run_next();
    }
    // The clock stands at the last event; what radios did since then is not theirs to know.
    ended = events.now();
    for (const auto& agent : config.agents) use.push_back(network->sap(agent.id).use());
    capture->finish(ended);
    agents::Outcome outcome;
    outcome.ended_at = ended;
    recorder->finish(outcome, Fingerprint{});
  }

  Ledger& ledger() { return recorder->find<results::record::AirLog>()->ledger(); }
  std::string ask(const std::string& sql) const {
    return results::record::test::ask(folder.file(), sql);
  }
  std::uint16_t stations() const { return stations_; }

  results::record::test::Folder folder;
  agents::SimulationConfig config;
  results::record::RecorderOptions options;
  EventQueue events;
  radio::test::PlacedAntennas antennas;
  radio::test::Wall wall;
  std::unique_ptr<results::record::Recorder> recorder;
  std::unique_ptr<results::record::AirCapture> capture;
  std::unique_ptr<agents::ObserverList> observers;
  std::unique_ptr<radio::RadioNetwork> network;
  std::vector<radio::RadioUse> use;  ///< By station, from 1 on.
  hal::Time ended{};

 private:
  class Client final : public radio::MacClient {
   public:
    Client(Replay& replay, hal::AgentId agent) : replay_(replay), agent_(agent) {}
    void on_receive(const radio::MacIndication& indication) override {
      replay_.observers->on_air_left(replay_.events.now(), agent_, indication);
    }
    void on_transmitted(std::uint64_t, hal::Verdict) override {}

   private:
    Replay& replay_;
    hal::AgentId agent_;
  };

  std::uint16_t stations_;
  std::vector<std::unique_ptr<Client>> clients_;
  std::vector<std::unique_ptr<Packet>> kept_;
  std::uint64_t tag_ = 0;
};

/// The sums of the ledger are what the radio and its record say, to the frame, the bit and the
/// nanosecond.
inline void expect_sums_of_the_radio(const Replay& replay) {
  for (std::uint16_t i = 1; i <= replay.stations(); ++i) {
    const std::string of = " WHERE agent = " + std::to_string(i);
    EXPECT_EQ(replay.ask("SELECT IFNULL(SUM(airtime_ns), 0) FROM air_accounts" + of),
              std::to_string(replay.use[i - 1u].transmitting.count()))
        << "station " << i;
    EXPECT_EQ(replay.ask("SELECT IFNULL(SUM(frames), 0) FROM air_accounts" + of),
              replay.ask("SELECT IFNULL(SUM(count), 0) FROM frames_sent" + of));
    EXPECT_EQ(replay.ask("SELECT IFNULL(SUM(e.frames), 0) FROM air_ends e" + of),
              replay.ask("SELECT IFNULL(SUM(count), 0) FROM receptions" + of));
    const std::string sent = " FROM frames WHERE transmitter = " + std::to_string(i);
    EXPECT_EQ(replay.ask("SELECT IFNULL(SUM(bits), 0) FROM air_accounts" + of),
              replay.ask("SELECT IFNULL(SUM(bits), 0)" + sent));
    EXPECT_EQ(replay.ask("SELECT IFNULL(SUM(retries), 0) FROM air_accounts" + of),
              replay.ask("SELECT IFNULL(SUM(retry), 0)" + sent));
  }
  EXPECT_EQ(replay.ask("SELECT COUNT(*) FROM (SELECT agent, peer, addressed, verdict, SUM(frames)"
                       " FROM air_link_verdicts GROUP BY 1, 2, 3, 4 EXCEPT SELECT agent, peer,"
                       " addressed, verdict, SUM(count) FROM receptions GROUP BY 1, 2, 3, 4)"),
            "0");
  EXPECT_EQ(replay.ask("SELECT SUM(airtime_ns) FROM air_seconds"),
            replay.ask("SELECT SUM(airtime_ns) FROM air_accounts"));
}

}  // namespace sim::air::test
