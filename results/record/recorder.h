#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/record/air_log.h"
#include "results/record/body_log.h"
#include "results/record/broadcast_watch.h"
#include "results/record/database.h"
#include "results/record/frame_counts.h"
#include "results/record/frame_log.h"
#include "results/record/frames_in_the_air.h"
#include "results/record/interface_counts.h"
#include "results/record/look_log.h"
#include "results/record/message_counts.h"
#include "results/record/message_log.h"
#include "results/record/protocols.h"
#include "results/record/relay_counts.h"
#include "results/record/route_log.h"
#include "results/record/routing_counts.h"
#include "results/record/unheard_topics.h"
#include "sim/agents/observer.h"
#include "sim/agents/simulation.h"
#include "sim/agents/simulation_config.h"
#include "sim/core/fingerprint.h"
#include "sim/scenario/countable.h"
#include "sim/scenario/detail.h"
#include "sim/scenario/observable.h"

namespace results::record {

class Observables;

struct RecorderOptions {
  hal::Duration pose_period = std::chrono::seconds{1};
  sim::scenario::Detail frames = sim::scenario::Detail::kCounts;
  sim::scenario::Detail messages = sim::scenario::Detail::kAll;
  sim::scenario::Detail samples =
      sim::scenario::Detail::kCounts;  ///< Of DDS, if an agent has a network.
  sim::scenario::Detail routes =
      sim::scenario::Detail::kNone;  ///< kAll: each change; and with it the lengths of queues.
  sim::scenario::Detail readings = sim::scenario::Detail::kNone;  ///< As LookLog::Settings.
};

/// A file with empty tables, ready for statements.
class NewDatabase : public Database {
 public:
  explicit NewDatabase(const std::filesystem::path& file);
};

/// A program that ran inside an agent.
struct ProgramRow {
  hal::AgentId agent;
  std::string agent_name{};  ///< For people; not in the table.
  std::string name;
  hal::Time started{};
  std::optional<hal::Time> ended{};  ///< None: it ended with the run.
  int status = 0;                    ///< 0..255; 128 + signal if a signal ended it.
};

/// Writes what is observed of a run to an SQLite file with the tables of schema.h.
///
///   Recorder recorder(folder / "run.sqlite", config);
///   recorder.set("scenario", "case_study");
///   FingerprintFeed feed([&](const auto& row) { recorder.add(row); });
///   Simulation simulation(config, {&recorder, &feed, …});
///   …run…
///   recorder.add_contacts(agent, simulation.contacts(agent));   // of each agent
///   feed.finish();
///   recorder.finish(outcome, feed.fingerprint());
///
/// If the process dies, the file holds everything up to the last commit: one every
/// kCommitPeriod of simulated time, every kCommitRows rows, and at each commit(). Totals (the
/// tables bodies, frames_sent, receptions, packets, requests and relays, and of messages that are
/// not listed) are those of the last kCommitPeriod, or of the last commit() that found them few
/// beside what was counted: so to keep them costs little beside counting, however many pairs of
/// agents there are. Every member throws std::runtime_error if the file cannot be written; then
/// only give_up() is left.
class Recorder final : public sim::agents::Observer {
 public:
  static constexpr hal::Duration kCommitPeriod = std::chrono::seconds{10};
  static constexpr int kCommitRows = 2000;

  Recorder(const std::filesystem::path& file, const sim::agents::SimulationConfig& config,
           RecorderOptions options = {});
  ~Recorder() override;

  /// A row of the table run; replaces an earlier one of that key.
  void set(std::string_view key, std::string_view value);
  void set(std::string_view key, double value);
  void set(std::string_view key, std::uint64_t value);

  /// Rows of the table settings.
  void add_settings(const std::vector<std::pair<std::string, std::string>>& settings);

  /// Rows of the table recorded_units. @param units  by controller and name.
  void add_units(const std::map<std::pair<std::string, std::string>, std::string>& units);

  /// Words of which the run can have counts, besides those of countable_of(): what its controllers
  /// declare. Some may be there.
  void add_countable(const std::vector<sim::scenario::Countable>& words);

  void add_contacts(hal::AgentId agent, const sim::agents::ContactCounts& contacts) {
    bodies_.on_contacts(agent, contacts);
  }

  /// @pre once for an agent.
  void add_use(hal::AgentId agent, const sim::agents::AgentUse& use);

  void add(const sim::Fingerprint::Row& row);
  void add(const ProgramRow& program);

  /// Observes what is asked for. Before the run; at most once.
  /// @param simulation  of that run; the caller makes what is returned its observer and sampler.
  /// @param unit_of  unit of what an agent's controller records under a name; "": not known.
  Observables& observe(std::vector<sim::scenario::ObservableRequest> requests,
                       const sim::agents::SimulationConfig& config,
                       const sim::agents::Simulation& simulation,
                       std::function<std::string(hal::AgentId, const std::string&)> unit_of);

  /// Has it look at queues and contacts, which nobody tells of. Before the run.
  /// @param simulation  of that run, outlives it.
  void look_at(const sim::agents::Simulation& simulation);

  /// Writes how a run ended that did not begin, or that could not be written to its end: what came
  /// after the last commit is lost, its end is not if there is room for a few thousand bytes.
  void give_up(const sim::agents::Outcome& outcome);

  /// Writes how the run ended. set() still works, and takes effect, afterwards.
  void finish(const sim::agents::Outcome& outcome, const sim::Fingerprint& fingerprint);

  /// Message classes of which nothing arrived at anyone. After finish().
  std::vector<UnheardTopic> unheard_topics() { return record::unheard_topics(database_); }

  /// What the air is used for; null: no agent has a network.
  sim::air::Ledger* ledger() { return air_ ? &air_->ledger() : nullptr; }

  /// Makes what there is so far readable for others: all rows, and the totals unless they are many.
  void commit();

  void on_start(const std::vector<std::pair<hal::AgentId, hal::AgentId>>& links) override;
  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;
  void on_faint(const sim::radio::Frame& frame, std::uint32_t radios) override;
  void on_frame_cut(hal::Time at, const sim::radio::Frame& frame) override;
  void on_sinr(double sinr_db) override {
    if (frame_log_) frame_log_->on_sinr(sinr_db);
  }
  void on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;
  void on_delivered(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver) override;
  void on_request_end(hal::Time at, hal::AgentId sender, hal::AgentId destination,
                      hal::Verdict verdict) override;
  void on_relay_lost(hal::Time at, hal::AgentId source, const sim::radio::MacRequest& request,
                     hal::Verdict verdict) override;
  void on_relay_queued(hal::Time at, const sim::radio::Msdu& msdu) override;
  void on_msdu_end(hal::Time at, const sim::radio::Msdu& msdu,
                   const sim::radio::MsduEnd& end) override;
  void on_association(hal::Time at, hal::AgentId station,
                      std::optional<hal::AgentId> access_point) override;
  bool observes_readings() const override { return looks_.observes_readings(); }
  bool observes(hal::AgentId, const hal::Channel& channel) const override {
    return looks_.observes(channel);
  }
  void on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                  std::span<const double> values) override;
  void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) override;
  void on_body(hal::Time at, hal::AgentId agent, const sim::agents::BodyState& body) override;
  void on_displaced(hal::Time at, hal::AgentId agent) override;
  void on_body_lost(const sim::physics::LostBody& lost) override;
  void on_message_sent(hal::Time at, const hal::Message& message) override;
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions) override;
  void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) override;
  void on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender, hal::MessageId id,
                      hal::Verdict verdict) override;
  void on_discovery(hal::Time at, hal::AgentId agent,
                    const sim::agents::Discovery& discovery) override;
  void on_protocol_event(hal::AgentId agent, hal::node::routing::ProtocolEvent event) override {
    routing_.on_event(agent, event);
  }
  void on_state(hal::Time at, hal::AgentId agent, std::string_view state) override;
  void on_record(hal::Time at, hal::AgentId agent, std::string_view name, double value) override;
  void on_air_entered(hal::Time at, hal::AgentId agent,
                      const sim::radio::MacRequest& request) override;
  void on_air_left(hal::Time at, hal::AgentId agent,
                   const sim::radio::MacIndication& indication) override;
  void on_air_refused(hal::Time at, hal::AgentId agent, sim::air::Refusal refusal,
                      std::size_t bytes) override;
  void on_scripted(const sim::agents::ScriptedDone& done) override;
  void on_turn(const sim::agents::Turn& turn) override;
  void on_arrival(const sim::OutsideArrival& arrival) override;

 private:
  template <class Value>
  void set_value(std::string_view key, const Value& value);
  void describe(const sim::agents::SimulationConfig& config);
  void write(const sim::agents::Outcome& outcome);
  void write(const sim::agents::RealTimeSummary& summary);
  void write(const sim::agents::AirSummary& summary);
  void write_totals(const sim::Fingerprint& fingerprint);
  void count_start(hal::Time at, const sim::radio::Frame& frame);
  void count_end(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                 hal::Verdict verdict);
  void on_rows(hal::Time at, int rows);
  void update_totals();
  void commit_rows();
  bool counts_frames() const { return options_.frames != sim::scenario::Detail::kNone; }

  NewDatabase database_;
  RecorderOptions options_;
  FrameCounts frames_;
  RelayCounts relays_;
  FramesInTheAir in_the_air_;
  Protocols protocols_;
  std::optional<FrameLog> frame_log_;
  std::optional<RouteLog> route_log_;
  LookLog looks_;
  std::optional<MessageLog> message_log_;
  std::optional<MessageCounts> message_counts_;
  std::optional<AirLog> air_;
  BroadcastWatch broadcasts_;
  BodyLog bodies_;
  InterfaceCounts interfaces_;
  std::unique_ptr<Observables> observables_;
  RoutingCounts routing_;
  Statement set_, insert_discovery_, insert_lost_body_, insert_state_, insert_value_,
      insert_scripted_, insert_turn_, insert_arrival_, insert_association_, insert_fingerprint_;
  int rows_ = 0;     ///< Since the last commit.
  hal::Time now_{};  ///< Of the latest row, or of the end.
  hal::Time next_commit_{kCommitPeriod};
  bool is_finished_ = false;
  bool is_given_up_ = false;
};

}  // namespace results::record
