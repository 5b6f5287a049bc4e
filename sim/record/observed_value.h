#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/record/database.h"
#include "sim/record/observable.h"
#include "sim/record/quantile_summary.h"
#include "sim/record/value_histogram.h"
#include "sim/record/value_sums.h"

namespace sim::record {

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
  ObservedValue(ObservableTables& tables, const ObservableRequest& request,
                const Identity& identity);

  /// @return rows written. What is not finite, or beyond 1e150, is left out.
  int add(hal::Time at, double value);

  /// Writes all but the samples. @param end  of the run.
  void finish(hal::Time end);

 private:
  void write_sums(hal::Time end);

  ObservableTables* tables_;
  std::int64_t row_;
  const ObservableRequest* request_;
  ValueSums sums_;
  std::uint64_t left_out_ = 0;
  std::optional<ValueHistogram> histogram_;
  std::optional<QuantileSummary> quantiles_;
};

}  // namespace sim::record
