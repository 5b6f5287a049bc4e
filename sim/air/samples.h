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

/// Delivery of a sample of a program's writer to one agent with a reader that was matched when it
/// was first sent.
struct SampleDelivery {
  EndpointIndex writer = 0;
  std::int64_t sequence_number = 0;
  hal::AgentId receiver;
  hal::Time entered{};               ///< When its first packet came out of the sender's interface.
  std::optional<hal::Time> left{};   ///< When the last that it needed went into the receiver's.
  std::uint32_t bytes = 0;           ///< Serialised.
  std::uint32_t fragments = 1;       ///< Of RTPS.
  std::uint32_t repairs = 0;         ///< Fragments, or whole samples, sent there again.
  bool is_repaired = false;          ///< Delivered, and not all of it by what was sent first.
  std::optional<SampleLoss> loss{};  ///< If not delivered: the loss of its last carrier.
  bool is_under_way = false;         ///< The run ended first.
};

/// Counts of the samples of one writer at one agent.
struct SampleSums {
  std::uint64_t samples = 0;    ///< Sent there while a reader was matched, and settled.
  std::uint64_t delivered = 0;  ///< Whole.
  std::uint64_t first_try = 0;  ///< Of these, without any repair.
  std::uint64_t under_way = 0;  ///< Neither delivered nor lost when the run ended.
  std::uint64_t repairs = 0;    ///< See SampleDelivery.
  std::uint64_t fragments = 0, bytes = 0;
  hal::Duration latency_sum{};
  std::map<LossCause, std::uint64_t> lost{};
  LatencyHistogram latencies{};
  bool changed = false;  ///< Since they were last written.
};

/// Follows the samples of programs' writers by GUID and sequence number from the sender's interface
/// to the interfaces of the agents whose readers are matched: nothing is asked of the programs. A
/// sample is settled kSettled after it was last sent; what is repeated later changes nothing.
///
/// The cause of a loss is the result of the sample's last carrier: of the data frames that carried
/// its missing part, hop by hop, the last one that ended without reaching its next hop.
class Samples {
 public:
  static constexpr hal::Duration kSettled = std::chrono::seconds{10};
  /// Beyond so many the oldest are settled early.
  static constexpr std::size_t kMostOpen = 20'000;
  /// A sample of more is not followed: whoever sends garbage can name any number.
  static constexpr std::uint32_t kMostFragments = 1U << 16U;
  /// Likewise of all samples that are open, each counted for each agent that it has not reached:
  /// beyond so many the oldest samples are settled early.
  static constexpr std::size_t kMostOpenFragments = 1U << 22U;
  using Sink = std::function<void(const SampleDelivery&)>;

  explicit Samples(const Endpoints& endpoints) : endpoints_(endpoints) {}

  /// Gets each delivery, or loss, when it is settled.
  void set_sink(Sink sink) { sink_ = std::move(sink); }

  /// A part of a datagram came out of the sender's interface.
  /// @param destination  kEveryone: of a group.
  void on_sent(hal::Time at, const Datagram& datagram, const DatagramPart& part,
               hal::AgentId destination);
  /// Whom a carrier is for.
  struct Whom {
    hal::AgentId destination;  ///< kEveryone: of a group.
    /// Of a group: only those that are with this access point.
    std::optional<hal::AgentId> access_point{};
  };
  bool is_for(const Whom& whom, hal::AgentId receiver) const;
  /// A carrier of some of it ended without having got to its next hop.
  void on_lost(const DatagramPart& part, const Whom& whom, const SampleLoss& loss);
  /// A frame to everyone that carries some of it went on the air.
  /// @param over  when radios that notice it must have said how it ended.
  void on_group_frame(const DatagramPart& part, const Whom& whom, const SampleLoss& unnoticed,
                      hal::Time over);
  /// … and ended so at one radio. @param loss  none: it came in.
  void on_group_frame_end(const DatagramPart& part, const Whom& whom, std::uint64_t frame,
                          const std::optional<SampleLoss>& loss);
  /// The station is with this access point from now on, or was with it last.
  void on_association(hal::AgentId station, hal::AgentId access_point) {
    with_[station] = access_point;
  }
  /// All of the datagram went into the receiver's interface.
  void on_received(hal::Time at, const Datagram& datagram, const DatagramPart& part,
                   hal::AgentId receiver);
  /// Settles what is old enough.
  void settle(hal::Time now);
  /// Settles all that is left.
  void finish(hal::Time now);

  using Key = std::pair<EndpointIndex, hal::AgentId>;  ///< Writer and receiver.
  std::map<Key, SampleSums>& sums() { return sums_; }
  const std::map<Key, SampleSums>& sums() const { return sums_; }
  std::size_t open() const { return open_.size(); }

 private:
  struct Progress {
    SampleDelivery delivery;
    /// By fragment: serial number of the datagram that brings it first; 0: none yet. Empty once all
    /// of them arrived.
    std::vector<std::uint64_t> first;
    std::vector<bool> got;
    std::uint32_t missing = 0;
    bool was_sent = false;  ///< Otherwise the writer knows better than we that it is not for it.
    SampleLosses losses{};

    /// Fragments came by the datagram with that serial number.
    void take(const DatagramPart& part, std::uint64_t serial);
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
  void release(Progress& progress);
  void settle_front(bool is_end);
  void settle(Sample& sample, bool is_end);

  template <class Act>
  void for_lost(const DatagramPart& part, const Whom& whom, const Act& act);
  void count(const SampleDelivery& delivery);

  const Endpoints& endpoints_;
  Sink sink_;
  std::map<SampleKey, Sample> open_;
  std::deque<SampleKey> order_;
  std::size_t open_fragments_ = 0;                 ///< See kMostOpenFragments.
  std::map<EndpointIndex, std::int64_t> settled_;  ///< By writer: the highest number.
  std::map<hal::AgentId, hal::AgentId> with_;      ///< Access points, by station.
  hal::Time now_{};
  std::map<Key, SampleSums> sums_;
};

}  // namespace sim::air
