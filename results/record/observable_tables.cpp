#include "results/record/observable_tables.h"

namespace results::record {
namespace {

std::vector<Table> value_tables() {
  return {
      {"observables",
       "what record: {observables: ...} asked for, agent by agent; what a controller records, once "
       "it has recorded it",
       {{"observable", "INTEGER PRIMARY KEY", "", "number in this result, from 1"},
        {"name", "TEXT NOT NULL", "",
         "as `baraka describe observables` has it, without the agent: 'agents.x'"},
        {"agent", "INTEGER NOT NULL", "", "whose"},
        {"unit", "TEXT NOT NULL", "",
         "unit of the values; '' if a controller records them without declaring a unit"},
        {"keeps", "TEXT NOT NULL", "", "'samples', 'histogram', 'quantiles' or 'counter'"},
        {"every_ns", "INTEGER", "ns", "sampling period; null: on change"},
        {"left_out", "INTEGER NOT NULL", "",
         "samples beyond the `most` of the request: in observable_sums, not in "
         "observable_samples"}}},
      {"observable_samples",
       "values of the observables that keep samples, by time",
       {{"observable", "INTEGER NOT NULL", "", "as in observables"},
        {"at_ns", "INTEGER NOT NULL", "ns", "time of the sample"},
        {"value", "REAL NOT NULL", "", "in the unit of the observable"}}},
  };
}

std::vector<Table> summary_tables() {
  return {
      {"observable_sums",
       "summary of each observable, written at the end of the run",
       {{"observable", "INTEGER PRIMARY KEY", "", "as in observables"},
        {"count", "INTEGER NOT NULL", "", "number of values; 0: there was none"},
        {"mean", "REAL", "", "of the values"},
        {"sd", "REAL", "",
         "standard deviation with divisor count - 1; null: fewer than two values"},
        {"min", "REAL", "", "the least"},
        {"max", "REAL", "", "the greatest"},
        {"sum", "REAL NOT NULL", "", "of the values"},
        {"last", "REAL", "", "at the end"},
        {"mean_over_time", "REAL", "",
         "mean of the values weighted by the time until the next value or the end"}}},
      {"observable_bins",
       "histograms of the observables that keep one, written at the end of the run",
       {{"observable", "INTEGER NOT NULL", "", "as in observables"},
        {"lower", "REAL", "", "lower edge, included; null: everything below `upper`"},
        {"upper", "REAL", "", "upper edge, excluded; null: everything from `lower` on"},
        {"count", "INTEGER NOT NULL", "", "values"}}},
      {"observable_quantiles",
       "quantiles of the observables that keep them, written at the end of the run",
       {{"observable", "INTEGER NOT NULL", "", "as in observables"},
        {"share", "REAL NOT NULL", "", "share of the values that are less or equal"},
        {"value", "REAL NOT NULL", "", "in the unit of the observable"},
        {"error", "REAL NOT NULL", "",
         "bound of the error of the share; 0: exact (type 7 of Hyndman and Fan), which it is for "
         "up to 10000 values"}},
       "observable, share"},
  };
}

}  // namespace

std::vector<Table> observable_tables() {
  std::vector<Table> tables = value_tables();
  const std::vector<Table> summaries = summary_tables();
  tables.insert(tables.end(), summaries.begin(), summaries.end());
  return tables;
}

}  // namespace results::record
