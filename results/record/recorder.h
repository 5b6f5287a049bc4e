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
#include "sim/agents/frame_digest.h"
#include "sim/agents/observer_list.h"
#include "sim/agents/simulation.h"
#include "sim/agents/simulation_config.h"
#include "sim/core/fingerprint.h"
#include "sim/scenario/countable.h"
#include "sim/scenario/observable.h"

namespace results::record {

class Observables;

/// A new database file. The tables exist when the constructor returns, so that members declared
/// after it can prepare statements.
class NewDatabase : public Database {
 public:
  explicit NewDatabase(const std::filesystem::path& file);
};

/// Writes what is observed of a run to an SQLite file with the tables of schema.h. It owns the
/// file, records what was run and how it ended, and passes everything else to the writers of
/// topics.h.
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
/// If the process dies, the file holds everything up to the last commit. There is a commit every
/// Commits::kCommitPeriod of simulated time, every kCommitRows rows, and at each commit(). Totals
/// (the tables bodies, frames_sent, receptions, packets, requests and relays, and those of messages
/// that are not listed) are older: they are written every kCommitPeriod, and at a commit() that
/// finds few of them compared with what they count. So writing them costs little compared with
/// counting, however many pairs of agents there are. Every member throws std::runtime_error if the
/// file cannot be written; after that only give_up() may be called.
class Recorder final : public sim::agents::ObserverList {
 public:
  Recorder(const std::filesystem::path& file, const sim::agents::SimulationConfig& config,
           RecorderOptions options = {});
  ~Recorder() override;

  /// Writes a row of the table run; replaces an earlier one with that key.
  void set(std::string_view key, std::string_view value);
  void set(std::string_view key, double value);
  void set(std::string_view key, std::uint64_t value);

  /// Writes rows of the table settings.
  void add_settings(const std::vector<std::pair<std::string, std::string>>& settings);

  /// Adds words that the run can have counts of, besides those of countable_of(): those that its
  /// controllers declare. Words that are there already are ignored.
  void add_countable(const std::vector<sim::scenario::Countable>& words);

  void add(const sim::Fingerprint::Row& row);

  /// Finds the writer of a type, for calls that are not callbacks of Observer. @return null: the
  /// run has no such writer.
  template <class One>
  One* find() const {
    for (const auto& writer : commits_.writers()) {
      if (auto* const one = dynamic_cast<One*>(writer.get())) return one;
    }
    return nullptr;
  }

  /// Observes what is asked for. Call before the run, at most once.
  /// @param simulation  of that run; the caller adds the result to its observers and samplers.
  /// @param unit_of  unit of a value that an agent's controller records, by name; "": not known.
  Observables& observe(std::vector<sim::scenario::ObservableRequest> requests,
                       const sim::agents::SimulationConfig& config,
                       const sim::agents::Simulation& simulation,
                       std::function<std::string(hal::AgentId, const std::string&)> unit_of);

  /// Calls TopicWriter::look_at() of all writers.
  void look_at(const sim::agents::Simulation& simulation);

  /// Writes the outcome of a run that did not begin, or whose recording failed. What came after the
  /// last commit is lost; the outcome is written if there is room for a few thousand bytes.
  void give_up(const sim::agents::Outcome& outcome);

  /// Writes the outcome of the run. Later calls of set() still take effect.
  void finish(const sim::agents::Outcome& outcome, const sim::Fingerprint& fingerprint);

  /// Of all frames so far; see FrameDigest. Also written by finish().
  std::uint64_t frames_digest() const { return frame_digest_.value(); }

  /// Message classes of which no message was delivered to anyone. Call after finish().
  std::vector<UnheardTopic> unheard_topics() { return record::unheard_topics(database_); }

  /// Commits what has been recorded so far, so that others can read it: all rows, and the totals
  /// unless they are many.
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
  sim::agents::FrameDigest frame_digest_;
  bool is_finished_ = false;
  bool is_given_up_ = false;
};

}  // namespace results::record
