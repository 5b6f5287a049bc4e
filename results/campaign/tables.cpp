#include <string>

#include "results/campaign/schema.h"

namespace results::campaign {
namespace {

using record::Table;

std::vector<Table> plan_tables() {
  return {
      {"campaign",
       "one value per key: the request",
       {{"key", "TEXT NOT NULL", "", "see the keys of the table campaign"},
        {"value", "", "", "a number or a text"}},
       "key"},
      {"points",
       "settings that are compared: one row for each combination that is run",
       {{"point", "INTEGER PRIMARY KEY", "", "from 1, in the order of the campaign file"},
        {"label", "TEXT NOT NULL", "", "what distinguishes it, for people: 'speed=0.3 m/s'"},
        {"scenario", "TEXT NOT NULL", "",
         "resolved: includes, defaults and the values of the point written out"}}},
      {"factors",
       "keys of the scenario that are varied",
       {{"factor", "INTEGER PRIMARY KEY", "", "from 1, in the order of the campaign file"},
        {"key", "TEXT NOT NULL", "", "dotted path, as for --set"},
        {"unit", "TEXT NOT NULL", "", "of levels.number; '' for none"}}},
      {"levels",
       "the value that each factor has at each point",
       {{"point", "INTEGER NOT NULL", "", "in points"},
        {"factor", "INTEGER NOT NULL", "", "in factors"},
        {"text", "TEXT NOT NULL", "", "as in a scenario file, with its unit"},
        {"number", "REAL", "", "the same in the factor's unit; null: it is no number"},
        {"is_default", "INTEGER NOT NULL", "",
         "1: the point does not set the key; text is the scenario's value, '' if it has no such "
         "key"}},
       "point, factor"},
  };
}

std::vector<Table> run_tables() {
  return {
      {"runs",
       "every run of the campaign, and how it ended",
       {{"run", "INTEGER PRIMARY KEY", "", "from 1"},
        {"point", "INTEGER NOT NULL", "", "in points"},
        {"replication", "INTEGER NOT NULL", "", "from 1 at each point"},
        {"seed", "INTEGER NOT NULL", "", "of its random streams"},
        {"state", "TEXT NOT NULL", "", "'waiting', 'running', 'done' or 'failed'"},
        {"result", "TEXT", "", "as in the table run of its result; null: it has not ended"},
        {"expectations_met", "INTEGER", "",
         "1: all expectations of the scenario; null: the run did not succeed"},
        {"error", "TEXT", "", "why it failed"},
        {"fingerprint", "TEXT", "", "of everything observed, 64 bits in hexadecimal"},
        {"simulated_s", "REAL", "s", "simulated time at its end"},
        {"wall_s", "REAL", "s", "real time from the start of its process to the end"},
        {"user_s", "REAL", "s", "processor time of its processes; null: not known"},
        {"host", "TEXT", "", "computer that ran it"},
        {"attempts", "INTEGER NOT NULL", "", "how many times it was started"},
        {"started", "TEXT", "", "when, the last time, UTC: '2026-11-22T20:31:14Z'"},
        {"ended", "TEXT", "", "when, UTC"},
        {"folder", "TEXT", "", "of its result in the campaign's folder; null: not kept"}}},
      {"observables",
       "names of the numbers that were measured",
       {{"observable", "INTEGER PRIMARY KEY", "", "from 1"},
        {"name", "TEXT NOT NULL", "", "see `baraka describe observables`"},
        {"unit", "TEXT NOT NULL", "", "of its values; '' for none"},
        {"agent", "TEXT NOT NULL", "", "whose; '' for one of the whole run"}}},
  };
}

std::vector<Table> measured_tables() {
  return {
      {"measurements",
       "one number of one run",
       {{"run", "INTEGER NOT NULL", "", "in runs"},
        {"observable", "INTEGER NOT NULL", "", "in observables"},
        {"value", "REAL", "",
         "in the observable's unit; 0 also if it was possible and did not occur; null: not defined "
         "in the run"}},
       "observable, run"},
      {"series",
       "values over time, of observables requested as samples",
       {{"run", "INTEGER NOT NULL", "", "in runs"},
        {"observable", "INTEGER NOT NULL", "", "in observables"},
        {"at_s", "REAL NOT NULL", "s", "simulated time"},
        {"value", "REAL", "", "in the observable's unit"}}},
      {"bins",
       "histograms, of observables requested as histograms",
       {{"run", "INTEGER NOT NULL", "", "in runs"},
        {"observable", "INTEGER NOT NULL", "", "in observables"},
        {"lower", "REAL NOT NULL", "", "of the bin, in the observable's unit, included"},
        {"upper", "REAL NOT NULL", "", "of the bin, excluded except in the last bin"},
        {"count", "INTEGER NOT NULL", "", "values in the bin"}}},
  };
}

}  // namespace

const std::vector<record::Table>& tables() {
  static const std::vector<Table> all = [] {
    std::vector<Table> sum = plan_tables();
    for (const std::vector<Table>& more : {run_tables(), measured_tables()})
      sum.insert(sum.end(), more.begin(), more.end());
    return sum;
  }();
  return all;
}

const std::vector<record::RunKey>& campaign_keys() {
  static const std::vector<record::RunKey> keys = {
      {"name", "", "of the campaign"},
      {"version", "", "of baraka"},
      {"scenario", "", "file of the scenario, as the campaign file names it"},
      {"design", "", "'one point', 'grid', 'list' or 'latin hypercube'"},
      {"base_seed", "", "of replication 1, and of what is sampled"},
      {"replications", "", "at each point"},
      {"seeds", "", "'common': replication k has the same seed at every point; 'independent'"},
      {"until", "", "simulated time at which each run ends, or 'its end'"},
      {"controllers", "", "'in-process' or 'spawn'"},
      {"pace", "",
       "'lockstep', 'realtime' or 'realtime:F': how simulated time advances in its runs; not there "
       "for `baraka run --replications`, which is in lock-step"},
      {"programs", "",
       "hashes of the files that play the runs, 64 bits in hexadecimal: of baraka, and of each "
       "controller's program and plug-in"},
      {"file", "", "text of the campaign file; not there for `baraka run --replications`"},
      {"sampled", "", "with a Latin hypercube: how many points it has"},
      {"engine", "", "'local' or 'slurm': what started its runs last"},
      {"slurm.campaign", "", "with slurm: the common part of its jobs' names"},
      {"slurm.1", "",
       "with slurm: of its first submission (then slurm.2, ...) the job's name, the run of index 0 "
       "of its array, and the job's number if Slurm gave one"},
  };
  return keys;
}

std::string schema_sql() {
  return record::schema_sql(tables()) +
         "CREATE UNIQUE INDEX runs_of_points ON runs (point, replication);\n"
         "CREATE UNIQUE INDEX observables_by_name ON observables (name, agent);\n"
         "CREATE INDEX series_of_observables ON series (observable, run);\n"
         "CREATE INDEX bins_of_observables ON bins (observable, run);\n";
}

}  // namespace results::campaign
