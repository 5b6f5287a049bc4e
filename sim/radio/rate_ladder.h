#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/agent_id.h"
#include "sim/radio/cell.h"
#include "sim/radio/mode_set.h"
#include "sim/radio/phy_mode.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// A mode in which a data frame may go out, and what that takes of the medium.
struct Rung {
  const PhyMode* mode = nullptr;
  hal::Duration airtime{};  ///< Of a frame of average length.
  std::uint32_t tries = 1;  ///< Exchanges of such a frame, backoffs included, that fit into 6 ms.
};
using Ladder = std::vector<Rung>;  ///< Ascending rates, not empty.

/// Of a station with this config: all its modes up to DcfConfig's data rate.
Ladder make_ladder(const DcfConfig& config, const ModeSet& modes);

/// The modes of one station's data frames, by who is to receive them: a NonERP station knows no
/// OFDM.
class RateLadders {
 public:
  /// @param all  those of the station up to its highest, ascending; the first is DSSS.
  /// @param cell  outlives it.
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
