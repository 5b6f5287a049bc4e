#pragma once

#include <algorithm>
#include <vector>

#include "hal/types/agent_id.h"

namespace sim::radio {

/// Capabilities of the stations that share one channel number. In the standard, stations learn them
/// from beacons and probes; here they are known from the start.
class Cell {
 public:
  /// @param knows_ofdm  false: a NonERP station, which supports only DSSS and HR/DSSS.
  void add(hal::AgentId station, bool knows_ofdm) {
    if (knows_ofdm) {
      has_erp_ = true;
    } else {
      non_erp_.insert(std::ranges::lower_bound(non_erp_, station), station);
    }
  }
  /// Whether some stations support OFDM and others do not, so that OFDM frames need protection
  /// (10.26.2).
  bool is_mixed() const { return has_erp_ && !non_erp_.empty(); }
  /// Whether a station supports OFDM; also true for addresses without a station.
  bool knows_ofdm(hal::AgentId station) const {
    return !std::ranges::binary_search(non_erp_, station);
  }

 private:
  bool has_erp_ = false;
  std::vector<hal::AgentId> non_erp_;  ///< In ascending order.
};

}  // namespace sim::radio
