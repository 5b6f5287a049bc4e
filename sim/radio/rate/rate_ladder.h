#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/agent_id.h"
#include "sim/radio/cell.h"
#include "sim/radio/phy/mode_set.h"
#include "sim/radio/phy/phy_mode.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// A mode for data frames, and how long frames in it occupy the medium.
struct Rung {
  const PhyMode* mode = nullptr;
  hal::Duration airtime{};  ///< For a frame of average length.
  /// Number of exchanges of such a frame, with backoffs, that fit into 6 ms.
  std::uint32_t tries = 1;
};
using Ladder = std::vector<Rung>;  ///< In ascending order of rates, not empty.

/// The modes of a station with this config up to DcfConfig's data rate.
Ladder make_ladder(const DcfConfig& config, const ModeSet& modes);

/// The modes of one station's data frames, depending on the receiver: a NonERP station does not
/// support OFDM.
class RateLadders {
 public:
  /// @param all  modes of the station up to its highest, in ascending order; the first is DSSS.
  /// @param cell  outlives this object.
  RateLadders(const Ladder& all, const Cell& cell) : erp_(all), cell_(cell) {
    for (const Rung& rung : all) {
      if (rung.mode->modulation_class() != ModulationClass::kOfdm) non_erp_.push_back(rung);
    }
  }

  const Ladder& to(hal::AgentId station) const {
    return cell_.knows_ofdm(station) ? erp_ : non_erp_;
  }

 private:
  Ladder erp_, non_erp_;
  const Cell& cell_;
};

}  // namespace sim::radio
