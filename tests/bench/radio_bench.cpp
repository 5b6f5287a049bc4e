// The radio by itself, without agents, controllers and records: what one simulated second costs.
//
//   radio_bench beacons|saturation [KEY=VALUE ...]
//
// beacons: `n` stations at random in a square, at constant density; each broadcasts 64 bytes at
// 1 Mb/s ten times a second, at a phase of its own. The places and phases of a seed are those of
// the peer's program (ns-3's `beacon`), so that receptions can be compared. saturation: `n` senders
// on a circle of 5 m round one receiver, 802.11b at 11 Mb/s, ACK at 1 Mb/s, 1500 bytes, queues
// never empty.
//
//   n=1000         stations, of saturation: senders
//   movers=0       so many of them move at 1 m/s, each in a direction of its own
//   senders=n      beacons: only the first so many send
//   neighbours=12  beacons: within decode range, in the mean
//   rate=1         beacons: of broadcasts, Mb/s; from 6 on 802.11g in place of 802.11b
//   mcs=-1         saturation, from 0 on: 802.11n with this MCS and A-MPDUs, in place of 802.11b
//   energy=-62     energy detection, dBm; stock ns-3 adds up against its -82
//   seed=1  time=1 warm=0.3    s; the costs of `time`, after `warm`
//
// Prints "key: value" lines. `hash` is one of all receptions: equal before and after a change that
// moves no result. `bytes_per_station` is what the heap has grown by, at the end, over n.

#include <fmt/core.h>
#include <malloc.h>
#include <sys/resource.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "hal/types/math.h"
#include "sim/core/event_queue.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/radio_network.h"

namespace {

namespace radio = sim::radio;
using hal::AgentId;

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

AgentId agent_of(std::size_t index) { return AgentId{static_cast<std::uint16_t>(index + 1)}; }

using Options = std::map<std::string, double>;

struct Antenna {
  hal::Vec3 start;
  hal::Vec3 velocity{};  ///< m/s
  hal::Duration phase{};
};

/// In straight lines, for ever.
class Antennas final : public radio::Positions {
 public:
  explicit Antennas(const std::vector<Antenna>& antennas) : antennas_(antennas) {}
  hal::Vec3 position(AgentId agent, hal::Time at) const override {
    const Antenna& antenna = antennas_[agent.value - 1u];
    return antenna.start + hal::to_seconds(at) * antenna.velocity;
  }
  hal::Vec3 velocity(AgentId agent, hal::Time) const override {
    return antennas_[agent.value - 1u].velocity;
  }
  hal::Time valid_until(AgentId agent, hal::Time at) const override {
    return max_speed(agent) > 0 ? at : hal::Time::max();
  }
  bool remembers(AgentId) const override { return true; }
  double max_speed(AgentId agent) const override {
    const hal::Vec3& velocity = antennas_[agent.value - 1u].velocity;
    return velocity.x != 0 || velocity.y != 0 ? 1.001 : 0;
  }

 private:
  const std::vector<Antenna>& antennas_;
};

class NoObstacles final : public radio::Obstacles {
 public:
  hal::Decibels loss(const hal::Vec3&, const hal::Vec3&) const override { return {}; }
};

class Counts final : public radio::RadioObserver {
 public:
  std::uint64_t frames = 0, faint = 0, audible = 0, delivered = 0, hash = 0;

  void on_frame_start(hal::Time, const radio::Frame&) override { ++frames; }
  void on_faint(const radio::Frame&, std::uint32_t radios) override { faint += radios; }
  void on_reception(hal::Time at, const radio::Frame& frame, AgentId receiver, hal::Verdict verdict,
                    double rssi_dbm) override {
    ++audible;
    mix(static_cast<std::uint64_t>(hal::to_ns(at)) ^ frame.id << 16);
    mix(receiver.value ^ static_cast<std::uint64_t>(verdict) << 32);
    mix(std::bit_cast<std::uint64_t>(rssi_dbm));
  }
  void on_delivered(hal::Time, const radio::Frame&, AgentId) override { ++delivered; }

 private:
  void mix(std::uint64_t word) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
  }
};

/// One station's source of traffic.
class Source final : public radio::MacClient {
 public:
  Source(sim::EventQueue& events, radio::MacSap& sap) : events_(events), sap_(sap) {
    sap.add_client(radio::kEthertypeRouting, *this);
  }

  void send_beacons(AgentId self, hal::Duration phase, const radio::Payload& payload) {
    request_ = {.destination = hal::kEveryone, .payload = payload};
    events_.schedule(events_.now() + phase, sim::Rank::kNodeTimer, self,
                     [this, self] { beacon(self); });
  }
  /// @param waiting  number of requests that are always there.
  void saturate(AgentId to, const radio::Payload& payload, int waiting) {
    request_ = {.destination = to, .payload = payload};
    for (int i = 0; i < waiting; ++i) sap_.transmit(request_);
    refill_ = true;
  }

  void on_receive(const radio::MacIndication&) override {}
  void on_transmitted(std::uint64_t, hal::Verdict) override {
    if (refill_) sap_.transmit(request_);
  }

 private:
  void beacon(AgentId self) {
    sap_.transmit(request_);
    events_.schedule(events_.now() + hal::Duration{100'000'000}, sim::Rank::kNodeTimer, self,
                     [this, self] { beacon(self); });
  }

  sim::EventQueue& events_;
  radio::MacSap& sap_;
  radio::MacRequest request_;
  bool refill_ = false;
};

/// Uniform over [0, 1), as libstdc++'s uniform_real_distribution draws it, which the peer uses.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : generator_(static_cast<std::uint32_t>(seed)) {}
  double operator()() {
    const double low = draw();
    return (low + 0x1p32 * draw()) * 0x1p-64;
  }

 private:
  double draw() { return static_cast<double>(generator_()); }

  std::mt19937 generator_;
};

void set(const Options& options, radio::DcfConfig& config) {
  config.phy.broadcast_rate = hal::BitsPerSecond{options.at("rate") * 1e6};
  config.contention.rts_threshold = 2347;
  config.receiver.energy_detection = hal::Dbm{options.at("energy")};
  config.propagation.chain = {radio::LogDistanceConfig{}};
  config.propagation.antenna_height = hal::Metres{1.5};
}

radio::RadioConfig config_of(const Options& options) {
  radio::Ieee80211bConfig dsss;
  radio::Ieee80211gConfig ofdm;
  set(options, dsss);
  set(options, ofdm);
  dsss.phy.data_rate = hal::BitsPerSecond{11e6};
  dsss.basic_rates = {hal::BitsPerSecond{1e6}};
  if (options.at("mcs") >= 0) {
    radio::Ieee80211nConfig ht;
    set(options, ht);
    ht.phy.broadcast_rate = hal::BitsPerSecond{6e6};
    ht.contention.rts_threshold = 65'535;
    ht.mcs.mcs = static_cast<std::uint8_t>(options.at("mcs"));
    return ht;
  }
  if (options.at("rate") < 6) return dsss;
  return ofdm;
}

std::vector<Antenna> field(const Options& options) {
  const auto n = static_cast<std::size_t>(options.at("n"));
  const double range = std::pow(10, (16.0206 - 46.6777 + 82) / 30);
  const double side =
      std::sqrt(options.at("n") * hal::math::kPi * range * range / options.at("neighbours"));
  Uniform uniform(static_cast<std::uint64_t>(options.at("seed")) * 7919 + n);
  std::vector<Antenna> antennas(n);
  for (Antenna& antenna : antennas) {
    antenna.start.x = uniform() * side;
    antenna.start.y = uniform() * side;
  }
  const auto movers = static_cast<std::size_t>(options.at("movers"));
  for (std::size_t i = 0; i < movers && i < n; ++i) {
    const double angle = 2 * hal::math::kPi * uniform();
    antennas[i].velocity = {std::cos(angle), std::sin(angle), 0};
  }
  for (Antenna& antenna : antennas) antenna.phase = hal::from_seconds(uniform() * 0.1);
  return antennas;
}

std::vector<Antenna> circle(const Options& options) {
  const auto n = static_cast<std::size_t>(options.at("n"));
  std::vector<Antenna> antennas(n + 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * hal::math::kPi * static_cast<double>(i) / options.at("n");
    antennas[i + 1].start = {5 * std::cos(angle), 5 * std::sin(angle), 0};
  }
  return antennas;
}

class Bench {
 public:
  Bench(const Options& options, std::vector<Antenna> antennas)
      : options_(options), antennas_(std::move(antennas)) {
    std::vector<radio::RadioNetwork::Station> stations;
    for (std::size_t i = 0; i < antennas_.size(); ++i) {
      stations.push_back({.agent = agent_of(i), .name = fmt::format("s{}", i)});
    }
    // The peer's first chip of heap is not counted, so neither are these.
    heap_before_ = mallinfo2();
    network_ = std::make_unique<radio::RadioNetwork>(
        config_of(options), stations,
        radio::RadioNetwork::Surroundings{events_, positions_, obstacles_, counts_,
                                          static_cast<std::uint64_t>(options.at("seed"))});
    for (std::size_t i = 0; i < antennas_.size(); ++i) {
      sources_.push_back(std::make_unique<Source>(events_, network_->sap(agent_of(i))));
    }
  }

  void send_beacons() {
    const auto payload = std::make_shared<hal::Bytes>(64);
    const auto senders = static_cast<std::size_t>(options_.at("senders"));
    for (std::size_t i = 0; i < sources_.size() && i < senders; ++i) {
      sources_[i]->send_beacons(agent_of(i), antennas_[i].phase, payload);
    }
  }
  void saturate() {
    const auto payload = std::make_shared<hal::Bytes>(1500);
    const int waiting = options_.at("mcs") >= 0 ? 150 : 2;
    for (std::size_t i = 1; i < sources_.size(); ++i) {
      sources_[i]->saturate(agent_of(0), payload, waiting);
    }
  }

  void run() {
    const double start = user_seconds();
    run_until(hal::time_from_ns(hal::from_seconds(options_.at("warm")).count()));
    const Counts before = counts_;
    const std::uint64_t events_before = events_.executed();
    const double warm = user_seconds();
    run_until(events_.now() + hal::from_seconds(options_.at("time")));
    const double used = user_seconds() - warm;
    const auto frames = static_cast<double>(counts_.frames - before.frames);
    const auto audible = static_cast<double>(counts_.audible - before.audible);
    const double arrivals = audible + static_cast<double>(counts_.faint - before.faint);
    const auto delivered = static_cast<double>(counts_.delivered - before.delivered);
    const auto events = static_cast<double>(events_.executed() - events_before);
    const double time = options_.at("time");
    fmt::print("user_s: {:.4f}\nwarm_s: {:.4f}\nframes: {:.0f}\n", used / time, warm - start,
               frames / time);
    fmt::print(
        "arrivals_per_frame: {:.2f}\naudible_per_frame: {:.2f}\nreceived_per_frame: {:.4f}\n",
        arrivals / frames, audible / frames, delivered / frames);
    fmt::print("events: {:.0f}\nns_per_arrival: {:.2f}\nns_per_frame: {:.0f}\n", events / time,
               1e9 * used / arrivals, 1e9 * used / frames);
    fmt::print("bytes_per_station: {:.0f}\nhash: {:016x}\n", grown() / options_.at("n"),
               counts_.hash);
  }

 private:
  void run_until(hal::Time end) {
    const hal::Time last = end - hal::Duration{1};
    while (events_.next_time().value_or(end) < end) events_.run_next(last);
    events_.advance_to(end);
  }
  double grown() const {
    const auto now = mallinfo2();
    return static_cast<double>(now.uordblks + now.hblkhd) -
           static_cast<double>(heap_before_.uordblks + heap_before_.hblkhd);
  }

  Options options_;
  std::vector<Antenna> antennas_;
  sim::EventQueue events_;
  Antennas positions_{antennas_};
  NoObstacles obstacles_;
  Counts counts_;
  struct mallinfo2 heap_before_ {};
  std::unique_ptr<radio::RadioNetwork> network_;
  std::vector<std::unique_ptr<Source>> sources_;
};

}  // namespace

int main(int argc, char** argv) {
  Options options{{"n", 1000}, {"movers", 0}, {"senders", 1e9}, {"neighbours", 12}, {"energy", -62},
                  {"rate", 1}, {"mcs", -1},   {"seed", 1},      {"time", 1},        {"warm", 0.3}};
  const std::string kind = argc > 1 ? argv[1] : "";
  bool is_good = kind == "beacons" || kind == "saturation";
  for (int i = 2; i < argc; ++i) {
    const std::string one = argv[i];
    const auto sign = one.find('=');
    const auto option = options.find(one.substr(0, sign));
    is_good = is_good && sign != std::string::npos && option != options.end();
    if (is_good) option->second = std::stod(one.substr(sign + 1));
  }
  if (!is_good) {
    fmt::print(stderr, "usage: radio_bench beacons|saturation [KEY=VALUE ...], keys:");
    for (const auto& [key, value] : options) fmt::print(stderr, " {}={}", key, value);
    fmt::print(stderr, "\n");
    return 2;
  }
  Bench bench(options, kind == "beacons" ? field(options) : circle(options));
  kind == "beacons" ? bench.send_beacons() : bench.saturate();
  bench.run();
}
