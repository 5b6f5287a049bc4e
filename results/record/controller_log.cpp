#include "results/record/controller_log.h"

namespace results::record {

ControllerLog::ControllerLog(Database& database, Commits& commits)
    : insert_state_(database, "INSERT INTO states VALUES (?, ?, ?)"),
      insert_value_(database, "INSERT INTO recorded VALUES (?, ?, ?, ?)"),
      put_unit_(database, "REPLACE INTO recorded_units VALUES (?, ?, ?)"),
      commits_(commits) {}

void ControllerLog::add_units(
    const std::map<std::pair<std::string, std::string>, std::string>& units) {
  for (const auto& [of, unit] : units) put_unit_.run(of.first, of.second, unit);
}

void ControllerLog::on_state(hal::Time at, hal::AgentId agent, std::string_view state) {
  insert_state_.run(agent.value, hal::to_ns(at), state);
  commits_.on_rows(at, 1);
}

void ControllerLog::on_record(hal::Time at, hal::AgentId agent, std::string_view name,
                              double value) {
  insert_value_.run(agent.value, hal::to_ns(at), name, value);
  commits_.on_rows(at, 1);
}

std::vector<Table> ControllerLog::state_tables() {
  return {
      {"states",
       "states that controllers entered",
       {{"agent", "INTEGER NOT NULL", "", "agent of the controller"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when it was entered"},
        {"state", "TEXT NOT NULL", "", "name given by the controller"}}},
  };
}

std::vector<Table> ControllerLog::value_tables() {
  return {
      {"recorded",
       "numbers that controllers recorded",
       {{"agent", "INTEGER NOT NULL", "", "agent of the controller"},
        {"at_ns", "INTEGER NOT NULL", "ns", "of the event in which it was recorded"},
        {"name", "TEXT NOT NULL", "", "name given by the controller"},
        {"value", "REAL NOT NULL", "", "in the unit of recorded_units, if it has one there"}}},
      {"recorded_units",
       "units of what controllers record, as they declare them",
       {{"program", "TEXT NOT NULL", "", "the controller, as in agents"},
        {"name", "TEXT NOT NULL", "", "as in recorded"},
        {"unit", "TEXT NOT NULL", "", "'m', or '1': a count or a share"}},
       "program, name"},
  };
}

}  // namespace results::record
