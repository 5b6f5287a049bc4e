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
#include "results/record/observed_value.h"
#include "results/record/tallies.h"
#include "results/record/topic_writer.h"
#include "sim/agents/sampler.h"
#include "sim/agents/simulation.h"
#include "sim/agents/simulation_config.h"
#include "sim/scenario/observable.h"

namespace results::record {

/// The observables of a run: looks at them, and keeps what was asked for. Every `every` from time 0
/// on, after all that happens at that instant; or on change: what only happens (a delay, what a
/// controller records) each time, all else at the agent's control instants, if it is not as before.
/// Readings are those of the agent's last control instant.
class Observables final : public TopicWriter, public sim::agents::Sampler {
 public:
  struct Surroundings {
    const sim::agents::Simulation& simulation;
    const sim::agents::SimulationConfig& config;
    Database& database;
    Commits& commits;
    /// Unit of what an agent's controller records under a name; "": not known.
    std::function<std::string(hal::AgentId, const std::string&)> unit_of;
  };

  Observables(std::vector<sim::scenario::ObservableRequest> requests, Surroundings surroundings);

  /// Writes what is known at the end of the run only.
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
                 sim::scenario::RecordedValue>
        source;
    ObservedValue kept;
    std::optional<double> held{};  ///< Of a reading or a recorded value: the last one.
    std::optional<double> seen{};  ///< That was looked at last.
    std::optional<std::pair<hal::Time, double>> rate_from{};  ///< Of a rate.
  };
  /// Those of one request that are looked at periodically. It goes on also while there are none: a
  /// controller may record a name later.
  struct Period {
    hal::Duration every{};
    hal::Time due{};
    std::vector<std::size_t> watches{};
  };
  using Watches = std::vector<std::size_t>;  ///< Places in watches_.

  void add_matching(std::size_t request, const sim::agents::AgentConfig& agent,
                    const std::vector<sim::scenario::Observable>& of_agent);
  void add(std::size_t request, const sim::agents::AgentConfig& agent,
           const sim::scenario::Observable& observable);
  void sort_in(std::size_t watch);
  void begin_tallies();
  const Watches& recorded(hal::AgentId agent, std::string_view name);
  std::optional<double> current(const Watch& watch) const;
  std::optional<double> value(Watch& watch, hal::Time at);
  void take_sample(Watch& watch, hal::Time at);
  void keep(Watch& watch, hal::Time at, double value);

  std::vector<sim::scenario::ObservableRequest> requests_;
  Surroundings surroundings_;
  ObservableTables tables_;
  std::vector<std::unique_ptr<Watch>> watches_;
  std::vector<Period> periods_;               ///< By request; one on change is never due.
  std::unique_ptr<Tallies> tallies_;          ///< Null: nobody asked.
  std::map<hal::AgentId, Watches> changing_;  ///< Looked at at control instants.
  std::map<std::pair<hal::AgentId, std::string>, Watches> readings_;  ///< By channel.
  std::map<std::pair<hal::AgentId, sim::scenario::Tally>, Watches> events_;
  std::map<hal::AgentId, std::map<std::string, Watches, std::less<>>> recorded_;
};

}  // namespace results::record
