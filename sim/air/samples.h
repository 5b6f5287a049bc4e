#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/air/datagram.h"
#include "sim/air/endpoints.h"
#include "sim/air/latency_histogram.h"
#include "sim/air/sample_losses.h"

namespace sim::air {

/// Delivery of one sample of a program's writer to one agent that had a matched reader when the
/// sample was first sent.
struct SampleDelivery {
  EndpointIndex writer = 0;
  std::int64_t sequence_number = 0;
  hal::AgentId receiver;
  hal::Time entered{};  ///< When its first packet left the sender's interface.
  /// When the last packet needed entered the receiver's interface; nullopt: never.
  std::optional<hal::Time> left{};
  std::uint32_t bytes = 0;      ///< Serialised size.
  std::uint32_t fragments = 1;  ///< Number of RTPS fragments.
  /// Number of fragments, or whole samples, retransmitted to this agent.
  std::uint32_t repairs = 0;
  bool is_repaired = false;          ///< Delivered, but not entirely by its first transmission.
  std::optional<SampleLoss> loss{};  ///< If not delivered: the loss of its last carrier.
  bool is_under_way = false;         ///< Neither delivered nor lost when the run ended.
};

/// Is told what happens to samples at the time when it happens. Its totals at the end of a run are
/// those of SampleSums.
class SampleWatcher {
 public:
  virtual ~SampleWatcher() = default;
  /// A sample was sent to the receiver for the first time. @param is_first  and to no other before.
  virtual void on_sample_sent(hal::Time at, const SampleDelivery& sample, bool is_first) = 0;
  /// The sample, or some of its fragments, was sent to the receiver again.
  /// @param repairs  number, as counted by SampleDelivery::repairs.
  virtual void on_sample_repair(hal::Time at, const SampleDelivery& sample,
                                std::uint32_t repairs) = 0;
  /// It has arrived completely, at `sample.left`.
  virtual void on_sample_delivered(const SampleDelivery& sample) = 0;
};

/// Counts for the samples from one writer to one agent.
struct SampleSums {
  std::uint64_t samples = 0;  ///< Settled samples that were sent there while a reader was matched.
  std::uint64_t delivered = 0;  ///< Completely delivered.
  std::uint64_t first_try = 0;  ///< Delivered without any repair.
  std::uint64_t under_way = 0;  ///< Neither delivered nor lost when the run ended.
  std::uint64_t repairs = 0;    ///< See SampleDelivery.
  std::uint64_t fragments = 0, bytes = 0;
  hal::Duration latency_sum{};
  std::map<LossCause, std::uint64_t> lost{};
  LatencyHistogram latencies{};
  bool changed = false;  ///< Since the counts were last written.
};

/// Follows the samples of programs' writers by GUID and sequence number from the sender's interface
/// to the interfaces of the agents with matched readers, without any help from the programs. A
/// sample is settled kSettled after it was last sent; later repetitions are ignored.
///
/// The cause of a loss is the result of the sample's last carrier: of the data frames that carried
/// its missing part, hop by hop, the last one that ended without reaching its next hop.
class Samples {
 public:
  static constexpr hal::Duration kSettled = std::chrono::seconds{10};
  /// Number of open samples beyond which the oldest are settled early.
  static constexpr std::size_t kMostOpen = 20'000;
  /// A sample with more fragments is not followed, because invalid data may claim any number.
  static constexpr std::uint32_t kMostFragments = 1U << 16U;
  /// Limit for the fragments of all open samples, counted once for each agent that a sample has not
  /// reached: beyond it the oldest samples are settled early.
  static constexpr std::size_t kMostOpenFragments = 1U << 22U;
  using Sink = std::function<void(const SampleDelivery&)>;

  explicit Samples(const Endpoints& endpoints) : endpoints_(endpoints) {}

  /// @param sink  called with each delivery or loss when it is settled.
  void set_sink(Sink sink) { sink_ = std::move(sink); }
  /// @param watcher  must outlive the calls of on_sent() and on_received().
  void set_watcher(SampleWatcher& watcher) { watcher_ = &watcher; }

  /// A part of a datagram left the sender's interface.
  /// @param destination  kEveryone: sent to a group.
  void on_sent(hal::Time at, const Datagram& datagram, const DatagramPart& part,
               hal::AgentId destination);
  /// The agents that a carrier is for.
  struct Whom {
    hal::AgentId destination;  ///< kEveryone: a group.
    /// For a group: only stations associated with this access point.
    std::optional<hal::AgentId> access_point{};
  };
  bool is_for(const Whom& whom, hal::AgentId receiver) const;
  /// A carrier of a part of the sample ended without reaching its next hop.
  void on_lost(const DatagramPart& part, const Whom& whom, const SampleLoss& loss);
  /// A group frame that carries a part of the sample was sent.
  /// @param unnoticed  loss at radios that do not report the frame. @param over  time by which
  /// radios that detect it will have reported it.
  void on_group_frame(const DatagramPart& part, const Whom& whom, const SampleLoss& unnoticed,
                      hal::Time over);
  /// That frame ended at one radio. @param loss  nullopt: received.
  void on_group_frame_end(const DatagramPart& part, const Whom& whom, std::uint64_t frame,
                          const std::optional<SampleLoss>& loss);
  /// The station is now associated with this access point, or was last associated with it.
  void on_association(hal::AgentId station, hal::AgentId access_point) {
    with_[station] = access_point;
  }
  /// A whole datagram entered the receiver's interface.
  void on_received(hal::Time at, const Datagram& datagram, const DatagramPart& part,
                   hal::AgentId receiver);
  /// Settles samples that are old enough.
  void settle(hal::Time now);
  /// Settles all open samples.
  void finish(hal::Time now);

  using Key = std::pair<EndpointIndex, hal::AgentId>;  ///< Writer and receiver.
  std::map<Key, SampleSums>& sums() { return sums_; }
  const std::map<Key, SampleSums>& sums() const { return sums_; }
  std::size_t open() const { return open_.size(); }

 private:
  struct Progress {
    SampleDelivery delivery;
    /// For each fragment: serial number of the datagram that sends it first; 0: none yet. Emptied
    /// when all have arrived.
    std::vector<std::uint64_t> first;
    std::vector<bool> got;
    std::uint32_t missing = 0;
    bool was_sent = false;  ///< false: the writer has not addressed this agent with it.
    SampleLosses losses{};

    /// Records the fragments of a part, which arrived in the datagram with that serial number.
    void take(const DatagramPart& part, std::uint64_t serial);
    /// Records the fragments of a part that is sent. @return number of those sent before.
    std::uint32_t send(const DatagramPart& part, std::uint64_t serial);
  };
  struct Sample {
    hal::Time last_sent{};
    std::vector<Progress> to;
  };
  using SampleKey = std::pair<EndpointIndex, std::int64_t>;

  Sample* find(const DatagramPart& part);
  bool is_old(const DatagramPart& part) const;
  Sample* begin(hal::Time at, const DatagramPart& part);
  bool is_for(const DatagramPart& part, hal::AgentId destination, hal::AgentId receiver) const;
  void tell_sent(hal::Time at, const Sample& sample, const Progress& progress, bool is_new,
                 std::uint32_t repairs);
  void release(Progress& progress);
  void settle_front(bool is_end);
  void settle(Sample& sample, bool is_end);

  template <class Act>
  void for_lost(const DatagramPart& part, const Whom& whom, const Act& act);
  void count(const SampleDelivery& delivery);

  const Endpoints& endpoints_;
  Sink sink_;
  SampleWatcher* watcher_ = nullptr;
  std::map<SampleKey, Sample> open_;
  std::deque<SampleKey> order_;
  std::size_t open_fragments_ = 0;                 ///< See kMostOpenFragments.
  std::map<EndpointIndex, std::int64_t> settled_;  ///< By writer: highest settled sequence number.
  std::map<hal::AgentId, hal::AgentId> with_;      ///< Access point of each station.
  hal::Time now_{};
  std::map<Key, SampleSums> sums_;
};

}  // namespace sim::air
