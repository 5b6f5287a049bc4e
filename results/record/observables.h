#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/dds_values.h"
#include "results/record/observed_value.h"
#include "results/record/tallies.h"
#include "results/record/topic_writer.h"
#include "sim/agents/sampler.h"
#include "sim/agents/simulation.h"
#include "sim/agents/simulation_config.h"
#include "sim/scenario/observable.h"

namespace results::record {

/// Samples the observables that were asked for. A request has either a period `every`, and is
/// sampled from time 0 on after all events of that instant, or it is on change. On change, an event
/// (a delay, a value that a controller records) is kept each time it happens; any other observable
/// is compared at the agent's control instants and kept if its value has changed. Readings are
/// those of the agent's latest control instant. Of DDS topics, counts and latencies are kept when a
/// sample is sent or arrives.
class Observables final : public TopicWriter, public sim::agents::Sampler {
 public:
  struct Surroundings {
    const sim::agents::Simulation& simulation;
    const sim::agents::SimulationConfig& config;
    Database& database;
    Commits& commits;
    /// Unit of a value that an agent's controller records, by agent and name; "": not known.
    std::function<std::string(hal::AgentId, const std::string&)> unit_of;
    sim::air::Ledger* ledger = nullptr;  ///< Null: no agent has a network. Outlives this object.
  };

  Observables(std::vector<sim::scenario::ObservableRequest> requests, Surroundings surroundings);

  /// Writes what is known only at the end of the run.
  void finish(hal::Time end) override;

  hal::Time due() const override;
  void look(hal::Time at) override;

  bool observes_readings() const override { return !readings_.empty(); }
  bool observes(hal::AgentId agent, const hal::Channel& channel) const override;
  void on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                  std::span<const double> values) override;
  void on_cycle(hal::Time at, hal::AgentId agent) override;
  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;
  void on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;
  void on_delivered(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver) override;
  void on_request_end(hal::Time at, hal::AgentId sender, hal::AgentId destination,
                      hal::Verdict verdict) override;
  void on_message_sent(hal::Time at, const hal::Message& message) override;
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions) override;
  void on_discovery(hal::Time at, hal::AgentId agent,
                    const sim::agents::Discovery& discovery) override;
  void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) override;
  void on_record(hal::Time at, hal::AgentId agent, std::string_view name, double value) override;

 private:
  /// One observable of one agent.
  struct Watch {
    hal::AgentId agent;
    bool on_change = false;
    std::variant<sim::scenario::QuantityValue, sim::scenario::Tally, sim::scenario::ReadingValue,
                 sim::scenario::RecordedValue, sim::scenario::TopicValue>
        source;
    ObservedValue kept;
    std::optional<double> held{};  ///< Latest reading or recorded value.
    std::optional<double> seen{};  ///< The value kept last.
    /// For a rate: time and value at the last sample.
    std::optional<std::pair<hal::Time, double>> rate_from{};
  };
  /// The observables of one request that are sampled periodically. The period also runs while there
  /// are none: a controller may record a new name later.
  struct Period {
    hal::Duration every{};
    hal::Time due{};
    std::vector<std::size_t> watches{};
  };
  using Watches = std::vector<std::size_t>;  ///< Indices in watches_.

  void add_matching(std::size_t request, const sim::agents::AgentConfig& agent,
                    const std::vector<sim::scenario::Observable>& of_agent);
  void add(std::size_t request, const sim::agents::AgentConfig& agent,
           const sim::scenario::Observable& observable);
  void sort_in(std::size_t watch);
  void begin_tallies();
  void begin_dds();
  void add_topic(const DdsValues::Place& place, sim::scenario::DdsSide side);
  void on_dds(hal::Time at, const DdsValues::Place& place, sim::scenario::DdsValue value);
  const sim::agents::AgentConfig& config_of(hal::AgentId agent) const;
  const Watches& recorded(hal::AgentId agent, std::string_view name);
  std::optional<double> current(const Watch& watch, hal::Time at) const;
  std::optional<double> value(Watch& watch, hal::Time at);
  void take_sample(Watch& watch, hal::Time at);
  void keep(Watch& watch, hal::Time at, double value);

  std::vector<sim::scenario::ObservableRequest> requests_;
  Surroundings surroundings_;
  ObservableTables tables_;
  std::vector<std::unique_ptr<Watch>> watches_;
  std::vector<Period> periods_;               ///< By request; never due if it is on change.
  std::unique_ptr<Tallies> tallies_;          ///< Null: no request needs them.
  std::unique_ptr<DdsValues> dds_;            ///< Null: no request needs them.
  std::map<hal::AgentId, Watches> changing_;  ///< Compared at control instants.
  std::map<std::pair<hal::AgentId, std::string>, Watches> readings_;  ///< By channel.
  std::map<std::pair<hal::AgentId, sim::scenario::Tally>, Watches> events_;
  /// Values of topics that are kept on change.
  std::map<std::pair<DdsValues::Place, sim::scenario::DdsValue>, Watches> of_topics_;
  std::map<hal::AgentId, std::map<std::string, Watches, std::less<>>> recorded_;
};

}  // namespace results::record
