#include "results/record/run_tables.h"

namespace results::record {

std::vector<Table> run_tables() {
  return {
      {"run",
       "one value per key: what was run, and how the run ended",
       {{"key", "TEXT NOT NULL", "", "see the keys of the table run"},
        {"value", "", "", "a number or a text"}},
       "key"},
      {"settings",
       "the resolved scenario, value by value, and --until and --pace of the command line",
       {{"key", "TEXT NOT NULL", "", "dotted path in scenario.resolved.yaml, items from 0"},
        {"value", "TEXT NOT NULL", "", "as written there, with its unit"}},
       "key"},
      {"agents",
       "the agents of the run",
       {{"agent", "INTEGER PRIMARY KEY", "", "address"},
        {"name", "TEXT NOT NULL", "", "for display"},
        {"kind", "TEXT NOT NULL", "", "'mote', 'robot' or 'station'"},
        {"program", "TEXT NOT NULL", "", "controller"},
        {"x_m", "REAL NOT NULL", "m", "x at the start"},
        {"y_m", "REAL NOT NULL", "m", "y at the start"},
        {"theta_rad", "REAL NOT NULL", "rad", "heading at the start"}}},
      {"ends",
       "end conditions of the scenario",
       {{"agent", "INTEGER", "",
         "agent whose state ends the run; null: a condition or the time ends it"},
        {"state", "TEXT", "",
         "state of this agent's controller that ends the run; without an agent: the condition that "
         "ends it; null: it ends at a time"},
        {"after_ns", "INTEGER NOT NULL", "ns",
         "delay of the end after that; without a state or condition: the time of the end"},
        {"result", "TEXT NOT NULL", "", "result of the run in that case"}}},
      {"walls",
       "static boxes that stand on the ground, also those of maps, seen from above",
       {{"name", "TEXT NOT NULL", "", "for display"},
        {"x_m", "REAL NOT NULL", "m", "middle"},
        {"y_m", "REAL NOT NULL", "m", "middle"},
        {"yaw_rad", "REAL NOT NULL", "rad", "heading of its own x axis"},
        {"size_x_m", "REAL NOT NULL", "m", "length along its own x axis"},
        {"size_y_m", "REAL NOT NULL", "m", "length along its own y axis"}}},
      {"links",
       "pairs of agents within radio range of each other at the start",
       {{"a", "INTEGER NOT NULL", "", "the lower address"},
        {"b", "INTEGER NOT NULL", "", "the higher address"}}},
  };
}

std::vector<Table> countable_tables() {
  return {
      {"countable",
       "what this run could count: if no other table has a count of a word listed here, the count "
       "is 0; a word not listed here was not counted in this run",
       {{"family", "TEXT NOT NULL", "",
         "what is counted, as in the first part of the names that `baraka describe observables` "
         "lists: 'frames', 'receptions', 'requests', 'messages.ends', 'routing.events', 'air', "
         "'dds.lost' (samples of all topics), 'states', 'controllers'; if there is no row for "
         "frames, messages or samples, they were not counted in this run"},
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
       "hashes of what was observed, by part, agent and second; a row only where the hash changes "
       "from one second to the next. The first row that differs between two runs shows where they "
       "begin to differ",
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
