#include "results/record/event_log.h"

#include <optional>

#include "results/record/hexadecimal.h"

namespace results::record {

EventLog::EventLog(Database& database, bool has_inputs, Commits& commits)
    : insert_scripted_(database, "INSERT INTO events VALUES (?, ?, ?, ?)"),
      insert_turn_(database, "INSERT INTO turns VALUES (?, ?, ?, ?)"),
      insert_arrival_(database, "INSERT INTO arrivals VALUES (?, ?, ?)"),
      has_inputs_(has_inputs),
      commits_(commits) {}

void EventLog::on_scripted(const sim::agents::ScriptedDone& done) {
  std::optional<int> agent;
  if (done.agent != hal::AgentId{}) agent = done.agent.value;
  insert_scripted_.run(hal::to_ns(done.at), std::uint64_t{done.event}, done.action, agent);
  commits_.on_rows(done.at, 1);
}

void EventLog::on_turn(const sim::agents::Turn& turn) {
  insert_turn_.run(hal::to_ns(turn.at), std::uint64_t{turn.port}, turn.replied, turn.began);
  commits_.on_rows(turn.at, 1);
}

void EventLog::on_arrival(const sim::OutsideArrival& arrival) {
  if (!has_inputs_) return;
  insert_arrival_.run(hal::to_ns(arrival.at), arrival.door, to_hexadecimal(arrival.bytes));
  commits_.on_rows(arrival.at, 1);
}

std::vector<Table> EventLog::scripted_tables() {
  return {
      {"events",
       "actions of the scenario's `events`",
       {{"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"event", "INTEGER NOT NULL", "", "index in `events` of the scenario, from 0"},
        {"action", "TEXT NOT NULL", "", "as in the scenario: 'kill', 'switch_off', 'jam'"},
        {"agent", "INTEGER", "", "agent that it acted on; null: it acted on the air"}}},
  };
}

std::vector<Table> EventLog::tables() {
  return {
      {"turns",
       "in real time: the turns of controller processes",
       {{"at_ns", "INTEGER NOT NULL", "ns", "all events up to this time had run"},
        {"process", "INTEGER NOT NULL", "",
         "controller processes in order of their lowest agent, from 0"},
        {"replied", "INTEGER NOT NULL", "", "1: its answer took effect at this time"},
        {"began", "INTEGER NOT NULL", "",
         "1: it was given the events that had waited, after that answer if there was one"}}},
      {"arrivals",
       "inputs from outside, which do not follow from scenario and seed",
       {{"at_ns", "INTEGER NOT NULL", "ns",
         "when it was taken in: in real time after the events of that time, in lock-step before"},
        {"door", "TEXT NOT NULL", "", "its destination: 'cmd_vel of r0', 'air of r0', 'programs'"},
        {"bytes", "TEXT NOT NULL", "",
         "hexadecimal; cmd_vel: m/s forward, m/s left, rad/s as binary64, little-endian; air: the "
         "Ethernet frame; programs: how one ended the run"}}},
  };
}

}  // namespace results::record
