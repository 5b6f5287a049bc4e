#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/protocols.h"
#include "results/record/topics.h"
#include "results/record/unheard_topics.h"
#include "sim/agents/observer_list.h"
#include "sim/agents/simulation.h"
#include "sim/agents/simulation_config.h"
#include "sim/core/fingerprint.h"
#include "sim/scenario/countable.h"
#include "sim/scenario/observable.h"

namespace results::record {

class Observables;

/// A file with empty tables, ready for statements.
class NewDatabase : public Database {
 public:
  explicit NewDatabase(const std::filesystem::path& file);
};

/// Writes what is observed of a run to an SQLite file with the tables of schema.h: it owns the
/// file, says what was run and how it ended, and hands all else to the writers of topics.h.
///
///   Recorder recorder(folder / "run.sqlite", config);
///   recorder.set("scenario", "case_study");
///   FingerprintFeed feed([&](const auto& row) { recorder.add(row); });
///   Simulation simulation(config, {&recorder, &feed, …});
///   …run…
///   recorder.find<BodyLog>()->add_contacts(agent, simulation.contacts(agent));  // of each agent
///   feed.finish();
///   recorder.finish(outcome, feed.fingerprint());
///
/// If the process dies, the file holds everything up to the last commit: one every
/// Commits::kCommitPeriod of simulated time, every kCommitRows rows, and at each commit(). Totals
/// (the tables bodies, frames_sent, receptions, packets, requests and relays, and of messages that
/// are not listed) are those of the last kCommitPeriod, or of the last commit() that found them few
/// beside what was counted: so to keep them costs little beside counting, however many pairs of
/// agents there are. Every member throws std::runtime_error if the file cannot be written; then
/// only give_up() is left.
class Recorder final : public sim::agents::ObserverList {
 public:
  Recorder(const std::filesystem::path& file, const sim::agents::SimulationConfig& config,
           RecorderOptions options = {});
  ~Recorder() override;

  /// A row of the table run; replaces an earlier one of that key.
  void set(std::string_view key, std::string_view value);
  void set(std::string_view key, double value);
  void set(std::string_view key, std::uint64_t value);

  /// Rows of the table settings.
  void add_settings(const std::vector<std::pair<std::string, std::string>>& settings);

  /// Words of which the run can have counts, besides those of countable_of(): what its controllers
  /// declare. Some may be there.
  void add_countable(const std::vector<sim::scenario::Countable>& words);

  void add(const sim::Fingerprint::Row& row);

  /// A writer of this run, to be told what observers are not. @return null: the run has none such.
  template <class One>
  One* find() const {
    for (const auto& writer : commits_.writers()) {
      if (auto* const one = dynamic_cast<One*>(writer.get())) return one;
    }
    return nullptr;
  }

  /// Observes what is asked for. Before the run; at most once.
  /// @param simulation  of that run; the caller makes what is returned its observer and sampler.
  /// @param unit_of  unit of what an agent's controller records under a name; "": not known.
  Observables& observe(std::vector<sim::scenario::ObservableRequest> requests,
                       const sim::agents::SimulationConfig& config,
                       const sim::agents::Simulation& simulation,
                       std::function<std::string(hal::AgentId, const std::string&)> unit_of);

  /// As TopicWriter::look_at(), of all.
  void look_at(const sim::agents::Simulation& simulation);

  /// Writes how a run ended that did not begin, or that could not be written to its end: what came
  /// after the last commit is lost, its end is not if there is room for a few thousand bytes.
  void give_up(const sim::agents::Outcome& outcome);

  /// Writes how the run ended. set() still works, and takes effect, afterwards.
  void finish(const sim::agents::Outcome& outcome, const sim::Fingerprint& fingerprint);

  /// Message classes of which nothing arrived at anyone. After finish().
  std::vector<UnheardTopic> unheard_topics() { return record::unheard_topics(database_); }

  /// Makes what there is so far readable for others: all rows, and the totals unless they are many.
  void commit();

  void on_start(const std::vector<std::pair<hal::AgentId, hal::AgentId>>& links) override;

 private:
  template <class Value>
  void set_value(std::string_view key, const Value& value);
  void describe(const sim::agents::SimulationConfig& config);
  void write(const sim::agents::Outcome& outcome);
  void write(const sim::agents::RealTimeSummary& summary);
  void write(const sim::agents::AirSummary& summary);
  void write_totals(const sim::Fingerprint& fingerprint);

  NewDatabase database_;
  RecorderOptions options_;
  Protocols protocols_;
  Commits commits_;
  Statement set_, insert_fingerprint_;
  bool is_finished_ = false;
  bool is_given_up_ = false;
};

}  // namespace results::record
