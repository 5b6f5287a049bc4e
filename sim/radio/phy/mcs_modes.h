#pragma once

#include <memory>
#include <vector>

#include "sim/radio/phy/mcs_mode.h"

namespace sim::radio {

/// Whether there is such a mode of a class with MCSs.
bool exists(const ModeId& id);

/// Of a class with MCSs: 7, 9 or 11.
std::uint8_t highest_mcs(ModulationClass modulation);

/// @pre exists(id).
std::unique_ptr<const PhyMode> make_mcs_mode(const ModeId& id, const McsMode::Options& options);

/// The modes that a station sends in that has `most` for stations like itself: of each class up to
/// its own that exists in the band, up to its MCS, streams and width, with its guard interval if
/// the class has it, and with 800 ns. Older classes first, then in ascending order of ModeId.
std::vector<ModeId> modes_up_to(const ModeId& most, std::uint32_t channel);

}  // namespace sim::radio
