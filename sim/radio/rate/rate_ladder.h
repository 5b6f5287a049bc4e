#pragma once

#include <cstdint>
#include <memory>
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
  std::uint32_t bits = 0;  ///< Length of such a frame as a QoS MPDU.
  hal::Duration answer{};  ///< SIFS and the answer to it.
};
using Ladder = std::vector<Rung>;  ///< In ascending order of rates, not empty.

/// Exchange of a PPDU with `mpdus` MPDUs of average length, without what precedes it: as many of
/// them as the longest PPDU of the mode has room for.
struct AverageExchange {
  double mpdus = 1;
  hal::Duration time{};
};
AverageExchange average_exchange(const Rung& rung, std::uint32_t mpdus);

/// The modes of a station with this config for any receiver: those without MCSs up to the reference
/// rate of its data mode, in ascending order of rates, then those with MCSs; the data mode itself
/// is the last.
Ladder make_ladder(const DcfConfig& config, const ModeSet& modes);

/// The modes of one station's data frames, depending on the capabilities of the receiver: those of
/// the newest class that both know, in the greatest common width, up to as many streams as both
/// have and up to the MCS of the sender's data mode; of the classes without MCSs all rates that
/// both know.
class RateLadders {
 public:
  /// @param all  of make_ladder().
  /// @param cell  outlives this object and has all stations before the first call of to().
  RateLadders(const Ladder& all, const Cell& cell);

  /// @return a reference that is valid as long as this object.
  const Ladder& to(hal::AgentId station) const { return *made(station).ladder; }
  /// All modes of that class up to those limits, of every width and guard interval: a ladder for
  /// each (streams, width, guard interval), the narrowest with one stream first. Empty: the class
  /// has no MCSs. @return a reference that is valid as long as this object.
  const std::vector<Ladder>& groups_to(hal::AgentId station) const { return *made(station).groups; }

 private:
  struct Made {
    Capabilities capabilities;
    std::unique_ptr<const Ladder> ladder;
    std::unique_ptr<const std::vector<Ladder>> groups;
  };

  const Made& made(hal::AgentId station) const;

  Ladder ladder_for(const Capabilities& receiver) const;
  Ladder legacy_ladder(const Capabilities& receiver) const;
  Ladder mcs_ladder(const ModeId& best) const;
  std::vector<Ladder> groups_for(const Capabilities& receiver) const;

  Ladder all_;
  const Cell& cell_;
  ModeId wanted_;                   ///< The data mode.
  mutable std::vector<Made> made_;  ///< For each kind of receiver that was asked for.
};

}  // namespace sim::radio
