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

/// Statements that write to the tables of observables.
struct ObservableTables {
  explicit ObservableTables(Database& database);
  Statement observable, sample, sums, bin, quantile, left_out;
};

/// Collects the values of one observable of one agent for the results. Its memory is bounded.
class ObservedValue {
 public:
  /// Which observable of which agent.
  struct Identity {
    std::int64_t row = 0;  ///< Number and row in the table observables.
    hal::AgentId agent;
    std::string name;  ///< "agents.x"
    std::string unit;
  };

  /// Writes the row of the table observables. @param request  outlives this object.
  ObservedValue(ObservableTables& tables, const sim::scenario::ObservableRequest& request,
                const Identity& identity);

  /// @return number of rows written. Values that are not finite, or beyond 1e150, are ignored.
  int add(hal::Time at, double value);

  /// Writes everything except the samples. @param end  of the run.
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
