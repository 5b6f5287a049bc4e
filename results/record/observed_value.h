#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "results/record/database.h"
#include "results/record/quantile_summary.h"
#include "results/record/value_histogram.h"
#include "results/record/value_sums.h"
#include "sim/scenario/observable.h"

namespace results::record {

/// Ways into the tables of observables.
struct ObservableTables {
  explicit ObservableTables(Database& database);
  Statement observable, sample, sums, bin, quantile, left_out;
};

/// An observable of one agent as it goes into the results. Its memory is bounded.
class ObservedValue {
 public:
  /// Whose value, and which.
  struct Identity {
    std::int64_t row = 0;  ///< Of the table observables, and its number.
    hal::AgentId agent;
    std::string name;  ///< "agents.x"
    std::string unit;
  };

  /// Writes its row of the table observables. @param request  outlives it.
  ObservedValue(ObservableTables& tables, const sim::scenario::ObservableRequest& request,
                const Identity& identity);

  /// @return rows written. What is not finite, or beyond 1e150, is left out.
  int add(hal::Time at, double value);

  /// Writes all but the samples. @param end  of the run.
  void finish(hal::Time end);

 private:
  void write_sums(hal::Time end);

  ObservableTables* tables_;
  std::int64_t row_;
  const sim::scenario::ObservableRequest* request_;
  ValueSums sums_;
  std::uint64_t left_out_ = 0;
  std::optional<ValueHistogram> histogram_;
  std::optional<QuantileSummary> quantiles_;
};

}  // namespace results::record
