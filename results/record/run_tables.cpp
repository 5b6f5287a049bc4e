#include "results/record/run_tables.h"

namespace results::record {

std::vector<Table> run_tables() {
  return {
      {"run",
       "one value per key: what was run and how it ended",
       {{"key", "TEXT NOT NULL", "", "see the keys of the table run"},
        {"value", "", "", "a number or a text"}},
       "key"},
      {"settings",
       "the resolved scenario, value by value, and --until and --pace of the command line",
       {{"key", "TEXT NOT NULL", "", "dotted path in scenario.resolved.yaml, items from 0"},
        {"value", "TEXT NOT NULL", "", "as written there, with its unit"}},
       "key"},
      {"agents",
       "who took part",
       {{"agent", "INTEGER PRIMARY KEY", "", "address"},
        {"name", "TEXT NOT NULL", "", "for people"},
        {"kind", "TEXT NOT NULL", "", "'mote', 'robot' or 'station'"},
        {"program", "TEXT NOT NULL", "", "controller"},
        {"x_m", "REAL NOT NULL", "m", "place at the start"},
        {"y_m", "REAL NOT NULL", "m", "place at the start"},
        {"theta_rad", "REAL NOT NULL", "rad", "heading at the start"}}},
      {"ends",
       "end conditions of the scenario",
       {{"agent", "INTEGER", "", "whose state ends the run; null: a condition or the time does"},
        {"state", "TEXT", "",
         "that this agent's controller enters; without an agent: the condition that ends the run; "
         "null: the time does"},
        {"after_ns", "INTEGER NOT NULL", "ns", "the end comes so long after, or at this time"},
        {"result", "TEXT NOT NULL", "", "what the run is then called"}}},
      {"walls",
       "boxes that never move, seen from above",
       {{"name", "TEXT NOT NULL", "", "for people"},
        {"x_m", "REAL NOT NULL", "m", "middle"},
        {"y_m", "REAL NOT NULL", "m", "middle"},
        {"yaw_rad", "REAL NOT NULL", "rad", "of its own x axis"},
        {"size_x_m", "REAL NOT NULL", "m", "length along its own x axis"},
        {"size_y_m", "REAL NOT NULL", "m", "length along its own y axis"}}},
      {"links",
       "pairs that can hear each other at the start",
       {{"a", "INTEGER NOT NULL", "", "the lower address"},
        {"b", "INTEGER NOT NULL", "", "the higher address"}}},
  };
}

std::vector<Table> countable_tables() {
  return {
      {"countable",
       "what this run could count: a count of such a word that no other table has is 0, a count of "
       "another does not exist in this run",
       {{"family", "TEXT NOT NULL", "",
         "of what, as the numbers of `baraka describe observables` begin: 'frames', 'receptions', "
         "'requests', 'messages.ends', 'routing.events', 'states', 'controllers'; without any row "
         "of frames or messages these were not counted"},
        {"program", "TEXT NOT NULL", "",
         "states, controllers: the controller that declares it, of the agents with that program; "
         "else ''"},
        {"word", "TEXT NOT NULL", "",
         "class, verdict, event, state or name, as other tables have it"}},
       "family, program, word"},
  };
}

std::vector<Table> fingerprint_tables() {
  return {
      {"fingerprints",
       "hashes of what was observed, per part, agent and second, where they change from one second "
       "to the next: two runs differ first where these rows do",
       {{"second", "INTEGER NOT NULL", "", "number of the simulated second, from 0"},
        {"part", "TEXT NOT NULL", "", "'air', 'bodies', 'exchange' or 'routing'"},
        {"agent", "INTEGER NOT NULL", "", "who"},
        {"hash", "INTEGER", "",
         "64 bits, of this second and those that follow until the next row of the part and agent; "
         "times are counted within the second; null: nothing was observed"}},
       "second, part, agent"},
  };
}

}  // namespace results::record
