#include "results/record/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>
#include <variant>

#include "hal/types/check.h"
#include "hal/types/log.h"
#include "results/record/hexadecimal.h"
#include "results/record/observables.h"
#include "results/record/packet_name.h"
#include "results/record/schema.h"
#include "sim/agents/quantities.h"
#include "sim/radio/frame_class.h"
#include "sim/radio/mac_sap.h"

namespace results::record {
namespace {

std::string_view kind_of(const sim::agents::AgentConfig& agent) {
  if (!has_body(agent)) return "station";
  return is_robot(agent) ? "robot" : "mote";
}

/// How long after its end at the transmitter a frame may end at a receiver: what radio waves need
/// from one end of any field to the other (300 km).
hal::Duration tail_of(const sim::radio::RadioConfig& config) {
  const sim::radio::WavesConfig* const waves = sim::radio::waves_of(config);
  const bool is_delayed = waves != nullptr && waves->propagation.propagation_delay;
  return is_delayed ? std::chrono::milliseconds{1} : hal::Duration{};
}

/// A commit() writes so many rows of totals in any case, and more if each stands for so many
/// frames or messages: a row costs some 2 us, to count some 10 ns.
constexpr std::uint64_t kFewTotals = 1000;
constexpr std::uint64_t kWorthWriting = 64;

}  // namespace

Recorder::Recorder(const std::filesystem::path& file, const sim::agents::SimulationConfig& config,
                   RecorderOptions options)
    : database_(file),
      options_(options),
      frames_(database_),
      relays_(database_),
      in_the_air_(database_, tail_of(config.radio)),
      protocols_(config),
      looks_(database_, {.period = options.pose_period,
                         .readings = options.readings,
                         .queues = options.routes == sim::scenario::Detail::kAll}),
      broadcasts_([this](auto... end) { on_message_end(hal::Time{}, hal::AgentId{}, end...); }),
      bodies_(database_, options.pose_period),
      interfaces_(database_),
      routing_(database_),
      set_(database_, "REPLACE INTO run VALUES (?, ?)"),
      insert_discovery_(database_, "INSERT INTO discoveries VALUES (?, ?, ?, ?, ?, ?)"),
      insert_lost_body_(database_, "INSERT INTO lost_bodies VALUES (?, ?, ?)"),
      insert_state_(database_, "INSERT INTO states VALUES (?, ?, ?)"),
      insert_value_(database_, "INSERT INTO recorded VALUES (?, ?, ?, ?)"),
      insert_scripted_(database_, "INSERT INTO events VALUES (?, ?, ?, ?)"),
      insert_turn_(database_, "INSERT INTO turns VALUES (?, ?, ?, ?)"),
      insert_arrival_(database_, "INSERT INTO arrivals VALUES (?, ?, ?)"),
      insert_association_(database_, "INSERT INTO associations VALUES (?, ?, ?)"),
      insert_fingerprint_(database_, "INSERT INTO fingerprints VALUES (?, ?, ?, ?)") {
  const bool lists_frames = options_.frames == sim::scenario::Detail::kSample ||
                            options_.frames == sim::scenario::Detail::kAll;
  if (lists_frames) frame_log_.emplace(database_, options_.frames, protocols_);
  if (options_.routes == sim::scenario::Detail::kAll) route_log_.emplace(database_, protocols_);
  if (options_.messages == sim::scenario::Detail::kAll) message_log_.emplace(database_);
  if (options_.messages == sim::scenario::Detail::kCounts) message_counts_.emplace(database_);
  const bool has_network = std::ranges::any_of(
      config.agents, [](const auto& agent) { return agent.network.has_value(); });
  if (has_network) air_.emplace(database_, options_.samples);
  database_.execute("BEGIN");
  describe(config);
  add_countable(sim::scenario::countable_of(config, counts_frames(),
                                            options_.messages != sim::scenario::Detail::kNone));
  commit();
}

NewDatabase::NewDatabase(const std::filesystem::path& file) : Database(file, Mode::kCreate) {
  create_tables(*this);
  // A write-ahead log lets others read while the run goes on. It is worked in when it has a hundred
  // pages, so that little of it is left where a full disk ends the run.
  execute("PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 100");
}

Recorder::~Recorder() {
  try {
    if (!is_given_up_) update_totals();
    if (!is_given_up_) commit_rows();
    // One plain file stays, readable also where nothing can be written.
    if (!is_given_up_) database_.execute("COMMIT");
    database_.execute("PRAGMA journal_mode = DELETE");
  } catch (const std::exception& e) {
    hal::log::warning(now_, "record", "{}", e.what());
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

void Recorder::add_units(const std::map<std::pair<std::string, std::string>, std::string>& units) {
  Statement insert(database_, "REPLACE INTO recorded_units VALUES (?, ?, ?)");
  for (const auto& [of, unit] : units) insert.run(of.first, of.second, unit);
}

void Recorder::add_countable(const std::vector<sim::scenario::Countable>& words) {
  Statement insert(database_, "REPLACE INTO countable VALUES (?, ?, ?)");
  for (const sim::scenario::Countable& one : words) insert.run(one.family, one.program, one.word);
}

void Recorder::on_arrival(const sim::OutsideArrival& arrival) {
  insert_arrival_.run(hal::to_ns(arrival.at), arrival.door, to_hexadecimal(arrival.bytes));
  on_rows(arrival.at, 1);
}

void Recorder::on_air_entered(hal::Time at, hal::AgentId agent,
                              const sim::radio::MacRequest& request) {
  if (air_) air_->ledger().on_entered(at, agent, request);
  interfaces_.on_entered(agent, request.payload->size());
}

void Recorder::on_air_left(hal::Time at, hal::AgentId agent,
                           const sim::radio::MacIndication& indication) {
  if (air_) air_->ledger().on_left(at, agent, indication);
  interfaces_.on_left(agent, indication.payload->size());
}

void Recorder::on_air_refused(hal::Time, hal::AgentId agent, sim::air::Refusal refusal,
                              std::size_t bytes) {
  interfaces_.on_refused(agent, refusal, bytes);
}

void Recorder::add(const ProgramRow& program) {
  Statement insert(database_, "INSERT INTO programs VALUES (?, ?, ?, ?, ?)");
  std::optional<std::int64_t> ended;
  std::optional<int> status;
  if (program.ended) ended = hal::to_ns(*program.ended);
  if (program.ended) status = program.status;
  insert.run(program.agent.value, program.name, hal::to_ns(program.started), ended, status);
}

void Recorder::on_scripted(const sim::agents::ScriptedDone& done) {
  std::optional<int> agent;
  if (done.agent != hal::AgentId{}) agent = done.agent.value;
  insert_scripted_.run(hal::to_ns(done.at), std::uint64_t{done.event}, done.action, agent);
  on_rows(done.at, 1);
}

void Recorder::on_turn(const sim::agents::Turn& turn) {
  insert_turn_.run(hal::to_ns(turn.at), std::uint64_t{turn.port}, turn.replied, turn.began);
  on_rows(turn.at, 1);
}

void Recorder::commit() {
  if (is_given_up_) return;
  std::uint64_t rows = frames_.rows();
  std::uint64_t counted = frames_.counted();
  if (message_counts_) rows += message_counts_->rows();
  if (message_counts_) counted += message_counts_->counted();
  if (air_) rows += air_->rows();
  if (is_finished_ || rows <= kFewTotals + counted / kWorthWriting) update_totals();
  commit_rows();
}

void Recorder::update_totals() {
  frames_.write();
  relays_.write(now_);
  if (counts_frames()) in_the_air_.write(now_);
  if (message_counts_) message_counts_->write();
  if (air_) air_->write();
  bodies_.write();
  interfaces_.write();
  routing_.write();
}

void Recorder::commit_rows() {
  database_.execute("COMMIT; BEGIN");
  rows_ = 0;
}

void Recorder::on_rows(hal::Time at, int rows) {
  rows_ += rows;
  now_ = std::max(now_, at);
  if (rows_ < kCommitRows && at < next_commit_) return;
  if (at >= next_commit_) {
    update_totals();
    next_commit_ = at + kCommitPeriod;
  }
  commit_rows();
}

void Recorder::add_use(hal::AgentId agent, const sim::agents::AgentUse& use) {
  Statement insert(database_, "INSERT INTO agent_use VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  std::optional<std::uint64_t> retries;
  if (counts_frames()) retries = frames_.retries(agent);
  insert.run(agent.value, use.radio.transmitting.count(), use.radio.receiving.count(),
             use.radio.listening.count(), use.radio.off.count(), retries, use.energy, use.load);
}

void Recorder::add(const sim::Fingerprint::Row& row) {
  std::optional<std::int64_t> hash;
  if (row.hash) hash = static_cast<std::int64_t>(*row.hash);
  insert_fingerprint_.run(row.second, sim::name(row.part), row.agent.value, hash);
  on_rows(hal::Time{std::chrono::seconds{row.second}}, 1);
}

Observables& Recorder::observe(
    std::vector<sim::scenario::ObservableRequest> requests,
    const sim::agents::SimulationConfig& config, const sim::agents::Simulation& simulation,
    std::function<std::string(hal::AgentId, const std::string&)> unit_of) {
  observables_ = std::make_unique<Observables>(
      std::move(requests),
      Observables::Surroundings{.simulation = simulation,
                                .config = config,
                                .database = database_,
                                .on_rows = [this](hal::Time at, int rows) { on_rows(at, rows); },
                                .unit_of = std::move(unit_of)});
  return *observables_;
}

void Recorder::give_up(const sim::agents::Outcome& outcome) {
  is_given_up_ = true;
  database_.roll_back();
  database_.execute("BEGIN");
  write(outcome);
  database_.execute("COMMIT");
}

void Recorder::finish(const sim::agents::Outcome& outcome, const sim::Fingerprint& fingerprint) {
  broadcasts_.finish(outcome.ended_at);
  if (air_) air_->finish(outcome.ended_at);
  if (observables_) observables_->finish(outcome.ended_at);
  write(outcome);
  write_totals(fingerprint);
  is_finished_ = true;
  commit();
}

void Recorder::write(const sim::agents::Outcome& outcome) {
  now_ = outcome.ended_at;
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
}

void Recorder::on_start(const std::vector<std::pair<hal::AgentId, hal::AgentId>>& links) {
  Statement insert(database_, "INSERT INTO links VALUES (?, ?)");
  for (const auto& [a, b] : links) insert.run(a.value, b.value);
}

void Recorder::on_frame_start(hal::Time at, const sim::radio::Frame& frame) {
  if (air_) air_->ledger().on_frame_start(at, frame);
  if (counts_frames()) count_start(at, frame);
  if (options_.messages != sim::scenario::Detail::kNone) broadcasts_.on_frame_start(at, frame);
  if (frame_log_) on_rows(at, frame_log_->on_start(at, frame));
  on_rows(at, looks_.on_queue(at, frame.transmitter));
}

void Recorder::count_start(hal::Time at, const sim::radio::Frame& frame) {
  now_ = std::max(now_, at);
  frames_.on_frame_start(frame);
  in_the_air_.on_frame_start(at, frame);
}

void Recorder::on_frame_cut(hal::Time at, const sim::radio::Frame& frame) {
  if (air_) air_->ledger().on_frame_cut(at, frame);
  in_the_air_.on_frame_cut(at, frame);
}

void Recorder::on_faint(const sim::radio::Frame& frame, std::uint32_t radios) {
  if (counts_frames()) frames_.on_faint(frame, radios);
}

void Recorder::on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                            hal::Verdict verdict, double rssi_dbm) {
  if (air_) air_->ledger().on_reception(at, frame, receiver, verdict, rssi_dbm);
  if (counts_frames()) count_end(at, frame, receiver, verdict);
  if (options_.messages != sim::scenario::Detail::kNone) broadcasts_.on_reception(frame, verdict);
  if (frame_log_) on_rows(at, frame_log_->on_reception(at, frame, receiver, verdict, rssi_dbm));
}

void Recorder::count_end(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                         hal::Verdict verdict) {
  now_ = std::max(now_, at);
  frames_.on_reception(frame, receiver, verdict);
  in_the_air_.on_reception(frame, receiver);
}

void Recorder::on_delivered(hal::Time, const sim::radio::Frame& frame, hal::AgentId receiver) {
  if (counts_frames()) frames_.on_delivered(frame, receiver);
}

void Recorder::on_request_end(hal::Time at, hal::AgentId sender, hal::AgentId destination,
                              hal::Verdict verdict) {
  if (counts_frames()) frames_.on_request_end(sender, destination, verdict);
  on_rows(at, looks_.on_queue(at, sender));
}

void Recorder::on_relay_lost(hal::Time at, hal::AgentId source,
                             const sim::radio::MacRequest& request, hal::Verdict verdict) {
  if (const auto message = packet_name(request, source, protocols_).message) {
    on_message_end(at, source, message->sender, message->id, verdict);
  }
}

void Recorder::on_relay_queued(hal::Time at, const sim::radio::Msdu& msdu) {
  if (counts_frames()) relays_.on_queued(at, msdu);
}

void Recorder::on_msdu_end(hal::Time at, const sim::radio::Msdu& msdu,
                           const sim::radio::MsduEnd& end) {
  if (air_) air_->ledger().on_msdu_end(at, msdu, end);
  if (counts_frames()) relays_.on_end(at, msdu, end);
}

void Recorder::on_association(hal::Time at, hal::AgentId station,
                              std::optional<hal::AgentId> access_point) {
  std::optional<int> with;
  if (access_point) with = access_point->value;
  if (air_) air_->ledger().on_association(at, station, access_point);
  insert_association_.run(hal::to_ns(at), station.value, with);
  on_rows(at, 1);
}

void Recorder::look_at(const sim::agents::Simulation& simulation) {
  const auto& all = sim::agents::quantities();
  const auto queue = std::ranges::find_if(
      all, [](const auto& one) { return one.domain == "radio" && one.name == "queue"; });
  BARAKA_CHECK(queue != all.end());
  looks_.open(
      {.queue =
           [&simulation, &queue = *queue](hal::AgentId agent) {
             return static_cast<std::uint64_t>(simulation.read(queue, agent).value_or(0));
           },
       .contacts = [&simulation](hal::AgentId agent) { return simulation.contacts(agent); }});
}

void Recorder::on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                          std::span<const double> values) {
  on_rows(at, looks_.on_reading(at, agent, channel, values));
}

void Recorder::on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) {
  if (!route_log_) return;
  route_log_->on_route_change(at, agent, change);
  on_rows(at, 1);
}

void Recorder::on_body(hal::Time at, hal::AgentId agent, const sim::agents::BodyState& body) {
  // Who has not moved since the last row was not pushed either: who did it is.
  if (!bodies_.on_body(at, agent, body)) return;
  on_rows(at, 1 + looks_.on_body(at, agent));
}

void Recorder::on_displaced(hal::Time, hal::AgentId agent) { bodies_.on_displaced(agent); }

void Recorder::on_body_lost(const sim::physics::LostBody& lost) {
  insert_lost_body_.run(lost.agent.value, hal::to_ns(lost.at), sim::physics::name(lost.how));
  on_rows(lost.at, 1);
}

void Recorder::on_message_sent(hal::Time at, const hal::Message& message) {
  if (message_counts_) message_counts_->on_sent(at, message);
  if (!message_log_) return;
  message_log_->on_sent(at, message);
  on_rows(at, 1);
}

void Recorder::on_message_delivered(hal::Time at, hal::AgentId receiver,
                                    const hal::Message& message, int transmissions) {
  if (message_counts_) {
    message_counts_->on_message_delivered(at, receiver, message, transmissions);
  }
  if (!message_log_) return;
  message_log_->on_message_delivered(at, receiver, message, transmissions);
  on_rows(at, 1);
}

void Recorder::on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) {
  if (message_counts_) message_counts_->on_fate(sender, id, fate);
  if (message_log_) message_log_->on_fate(at, sender, id, fate);
}

void Recorder::on_message_end(hal::Time, hal::AgentId, hal::AgentId sender, hal::MessageId id,
                              hal::Verdict verdict) {
  if (message_counts_) message_counts_->on_end(sender, id, verdict);
  if (message_log_) message_log_->on_end(sender, id, verdict);
}

void Recorder::on_discovery(hal::Time at, hal::AgentId agent,
                            const sim::agents::Discovery& discovery) {
  insert_discovery_.run(agent.value, discovery.topic, discovery.destination.value, hal::to_ns(at),
                        discovery.took.count(), discovery.found);
  on_rows(at, 1);
}

void Recorder::on_state(hal::Time at, hal::AgentId agent, std::string_view state) {
  insert_state_.run(agent.value, hal::to_ns(at), state);
  on_rows(at, 1);
}

void Recorder::on_record(hal::Time at, hal::AgentId agent, std::string_view name, double value) {
  insert_value_.run(agent.value, hal::to_ns(at), name, value);
  on_rows(at, 1);
}

}  // namespace results::record
