#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/air/ledger.h"
#include "sim/scenario/dds_value.h"

namespace results::record {

/// Keeps the values of dds_value_kinds() for each agent and topic, from the events of a ledger.
class DdsValues final : public sim::air::SampleWatcher {
 public:
  /// A topic at an agent: the topic is an index into Endpoints::topics().
  using Place = std::pair<hal::AgentId, std::uint32_t>;
  /// Called when a place is found to have the values of a side, once for each.
  using OnKnown = std::function<void(const Place&, sim::scenario::DdsSide)>;
  /// Called when a value has changed, and for each latency.
  using OnEvent = std::function<void(hal::Time, const Place&, sim::scenario::DdsValue)>;

  /// Watches the ledger from now on. @param ledger  outlives this object.
  DdsValues(sim::air::Ledger& ledger, OnKnown on_known, OnEvent on_event);
  DdsValues(const DdsValues&) = delete;
  DdsValues& operator=(const DdsValues&) = delete;

  /// Finds the agents that have begun to send something of a topic.
  void find_transmitters();

  /// None: there is no such value yet. kAirShare has none of its own: it is the rate of kAirtime.
  /// @pre on_known was called for the place and the value's side.
  std::optional<double> value(hal::Time now, const Place& place,
                              sim::scenario::DdsValue value) const;

  const std::string& topic(std::uint32_t number) const {
    return ledger_.endpoints().topics()[number];
  }

  void on_sample_sent(hal::Time at, const sim::air::SampleDelivery& sample, bool is_first) override;
  void on_sample_repair(hal::Time at, const sim::air::SampleDelivery& sample,
                        std::uint32_t repairs) override;
  void on_sample_delivered(const sim::air::SampleDelivery& sample) override;

 private:
  struct Counts {
    bool is_writer = false, is_reader = false, is_transmitter = false;
    std::uint64_t sent = 0, samples = 0, delivered = 0, first_try = 0, repairs = 0;
    std::optional<hal::Duration> latency{};  ///< Of the sample delivered last.
    std::optional<hal::Time> newest{};       ///< When the newest delivered sample was sent.
    std::vector<std::size_t> accounts{};     ///< Indices into AirAccounts::all().
  };

  void learn(sim::air::EndpointIndex endpoint);
  void know(bool Counts::*side, const Place& place, sim::scenario::DdsSide name);
  std::uint32_t topic_of(const sim::air::SampleDelivery& sample) const;
  double airtime(const Counts& counts) const;

  sim::air::Ledger& ledger_;
  OnKnown on_known_;
  OnEvent on_event_;
  std::map<Place, Counts> counts_;
  std::size_t accounts_ = 0;  ///< Number of accounts that find_transmitters() has seen.
};

}  // namespace results::record
