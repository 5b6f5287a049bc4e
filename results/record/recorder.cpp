#include "results/record/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>

#include "hal/types/log.h"
#include "results/record/air_log.h"
#include "results/record/observables.h"
#include "results/record/schema.h"
#include "sim/agents/drawn_bodies.h"

namespace results::record {
namespace {

std::string_view kind_of(const sim::agents::AgentConfig& agent) {
  if (!has_body(agent)) return "station";
  return is_robot(agent) ? "robot" : "mote";
}

sim::air::Ledger* ledger_of(AirLog* air) { return air == nullptr ? nullptr : &air->ledger(); }

}  // namespace

Recorder::Recorder(const std::filesystem::path& file, const sim::agents::SimulationConfig& config,
                   RecorderOptions options)
    : database_(file),
      options_(options),
      protocols_(config),
      commits_(database_),
      set_(database_, "REPLACE INTO run VALUES (?, ?)"),
      insert_fingerprint_(database_, "INSERT INTO fingerprints VALUES (?, ?, ?, ?)") {
  Recording recording{database_, options_, config, protocols_, commits_, *this};
  add_writers(recording);
  ObserverList::add(commits_);
  ObserverList::add(frame_digest_);
  database_.execute("BEGIN");
  describe(config);
  add_countable(sim::scenario::countable_of(
      config, {.frames = options_.counts_frames(),
               .messages = options_.messages != sim::scenario::Detail::kNone,
               .samples = options_.samples != sim::scenario::Detail::kNone}));
  commit();
}

NewDatabase::NewDatabase(const std::filesystem::path& file) : Database(file, Mode::kCreate) {
  create_tables(*this);
  // With a write-ahead log others can read while the run goes on. A checkpoint at each commit that
  // leaves more than a hundred pages keeps the log as short as a commit, so that little of it is
  // left to merge if a full disk ends the run.
  execute("PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 100");
}

Recorder::~Recorder() {
  try {
    if (!is_given_up_) commits_.write_totals();
    if (!is_given_up_) commits_.commit();
    // Leaves a single file, which can also be read where nothing can be written.
    if (!is_given_up_) database_.execute("COMMIT");
    database_.execute("PRAGMA journal_mode = DELETE");
  } catch (const std::exception& e) {
    hal::log::warning(commits_.now(), "record", "{}", e.what());
  }
}

template <class Value>
void Recorder::set_value(std::string_view key, const Value& value) {
  set_.run(key, value);
  if (is_finished_) commit();
}

void Recorder::set(std::string_view key, std::string_view value) { set_value(key, value); }
void Recorder::set(std::string_view key, double value) { set_value(key, value); }
void Recorder::set(std::string_view key, std::uint64_t value) { set_value(key, value); }

void Recorder::describe(const sim::agents::SimulationConfig& config) {
  set("result", std::string_view("running"));
  set("seed", config.seed);
  set("profile", sim::radio::profile_name(config.radio));
  set("controller_latency_s", hal::to_seconds(config.controller_latency));
  set("control_phase",
      std::string_view(config.control_phase == sim::agents::ControlPhase::kAligned ? "aligned"
                                                                                   : "uniform"));
  set("control_period_s", hal::to_seconds(config.control_period));
  Statement insert(database_, "INSERT INTO agents VALUES (?, ?, ?, ?, ?, ?, ?)");
  for (const sim::agents::AgentConfig& agent : config.agents) {
    insert.run(agent.id.value, agent.name, kind_of(agent), agent.program, agent.pose.x,
               agent.pose.y, agent.pose.theta);
  }
  Statement insert_wall(database_, "INSERT INTO walls VALUES (?, ?, ?, ?, ?, ?)");
  for (const sim::physics::StaticBox& wall : config.walls) {
    if (!sim::agents::stands_on(*config.world.ground, wall)) continue;
    insert_wall.run(wall.name, wall.centre.x, wall.centre.y, wall.yaw, wall.size.x, wall.size.y);
  }
  std::vector<std::pair<hal::AgentId, std::string>> names;
  for (const sim::agents::AgentConfig& agent : config.agents)
    names.emplace_back(agent.id, agent.name);
  Statement insert_end(database_, "INSERT INTO ends VALUES (?, ?, ?, ?)");
  for (const sim::agents::EndCondition& end : config.ends) {
    std::optional<int> agent;
    std::optional<std::string> state;
    if (end.agent) agent = end.agent->value;
    if (end.agent) state = end.state;
    if (end.when) state = to_text(*end.when, names);
    insert_end.run(agent, state, end.after.count(), end.result);
  }
}

void Recorder::add_settings(const std::vector<std::pair<std::string, std::string>>& settings) {
  Statement insert(database_, "REPLACE INTO settings VALUES (?, ?)");
  for (const auto& [key, value] : settings) insert.run(key, value);
}

void Recorder::add_countable(const std::vector<sim::scenario::Countable>& words) {
  Statement insert(database_, "REPLACE INTO countable VALUES (?, ?, ?)");
  for (const sim::scenario::Countable& one : words) insert.run(one.family, one.program, one.word);
}

void Recorder::commit() {
  if (is_given_up_) return;
  if (is_finished_ || commits_.has_few_totals()) commits_.write_totals();
  commits_.commit();
}

void Recorder::add(const sim::Fingerprint::Row& row) {
  std::optional<std::int64_t> hash;
  if (row.hash) hash = static_cast<std::int64_t>(*row.hash);
  insert_fingerprint_.run(row.second, sim::name(row.part), row.agent.value, hash);
  commits_.on_rows(hal::Time{std::chrono::seconds{row.second}}, 1);
}

Observables& Recorder::observe(
    std::vector<sim::scenario::ObservableRequest> requests,
    const sim::agents::SimulationConfig& config, const sim::agents::Simulation& simulation,
    std::function<std::string(hal::AgentId, const std::string&)> unit_of) {
  auto observables = std::make_unique<Observables>(
      std::move(requests), Observables::Surroundings{.simulation = simulation,
                                                     .config = config,
                                                     .database = database_,
                                                     .commits = commits_,
                                                     .unit_of = std::move(unit_of),
                                                     .ledger = ledger_of(find<AirLog>())});
  Observables& one = *observables;
  commits_.add(std::move(observables));
  return one;
}

void Recorder::give_up(const sim::agents::Outcome& outcome) {
  is_given_up_ = true;
  database_.roll_back();
  database_.execute("BEGIN");
  write(outcome);
  database_.execute("COMMIT");
}

void Recorder::finish(const sim::agents::Outcome& outcome, const sim::Fingerprint& fingerprint) {
  for (const auto& writer : commits_.writers()) writer->finish(outcome.ended_at);
  write(outcome);
  write_totals(fingerprint);
  is_finished_ = true;
  commit();
}

void Recorder::write(const sim::agents::Outcome& outcome) {
  commits_.see(outcome.ended_at);
  set("result", outcome.result);
  if (!outcome.error.empty()) set("error", outcome.error);
  set("ended_ns", static_cast<std::uint64_t>(hal::to_ns(outcome.ended_at)));
  set("simulated_s", hal::to_seconds(outcome.ended_at));
  set("events", outcome.events);
  set("exchanges", outcome.exchanges);
  set("refused_actions", outcome.refused_actions);
  set("ode_messages", outcome.ode_messages);
  if (outcome.real_time) write(*outcome.real_time);
}

void Recorder::write(const sim::agents::RealTimeSummary& summary) {
  set("overruns", summary.overruns);
  set("missed_cycles", summary.missed_cycles);
  set("command_timeouts", summary.command_timeouts);
  set("lost_events", summary.lost_events);
  set("control_jitter_median_s", hal::to_seconds(summary.jitter_median));
  set("control_jitter_p99_s", hal::to_seconds(summary.jitter_p99));
  set("control_jitter_max_s", hal::to_seconds(summary.jitter_max));
  if (summary.air) write(*summary.air);
}

void Recorder::write(const sim::agents::AirSummary& summary) {
  const auto edge = [this](const std::string& name, const sim::agents::EdgeSummary& of) {
    set(name + "_frames", of.frames);
    set(name + "_late_frames", of.beyond_limit);
    set(name + "_lateness_median_s", hal::to_seconds(of.median));
    set(name + "_lateness_p99_s", hal::to_seconds(of.p99));
    set(name + "_lateness_max_s", hal::to_seconds(of.greatest));
  };
  edge("entering", summary.entering);
  edge("leaving", summary.leaving);
}

void Recorder::write_totals(const sim::Fingerprint& fingerprint) {
  set("fingerprint", sim::to_hex(fingerprint.total()));
  const auto parts = fingerprint.parts();
  for (std::size_t i = 0; i < parts.size(); ++i)
    set(fmt::format("fingerprint_{}", sim::name(static_cast<sim::Part>(i))), sim::to_hex(parts[i]));
  set("frames_digest", sim::to_hex(frames_digest()));
}

void Recorder::on_start(const std::vector<std::pair<hal::AgentId, hal::AgentId>>& links) {
  ObserverList::on_start(links);
  Statement insert(database_, "INSERT INTO links VALUES (?, ?)");
  for (const auto& [a, b] : links) insert.run(a.value, b.value);
}

void Recorder::look_at(const sim::agents::Simulation& simulation) {
  for (const auto& writer : commits_.writers()) writer->look_at(simulation);
}

}  // namespace results::record
