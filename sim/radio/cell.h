#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "sim/radio/phy/capabilities.h"

namespace sim::radio {

/// Capabilities of the stations that share one channel number. In the standard, stations learn them
/// from beacons, association and probes; here they are known from the start.
class Cell {
 public:
  /// @pre each station is added once.
  void add(hal::AgentId station, const Capabilities& capabilities) {
    if (!usual_) usual_ = capabilities;
    of_some_ = static_cast<std::uint8_t>(of_some_ | capabilities.classes);
    of_all_ = static_cast<std::uint8_t>(of_all_ & capabilities.classes);
    if (capabilities.supports(ModulationClass::kHt)) {
      narrowest_ = std::min(narrowest_, capabilities.width);
      widest_ = std::max(widest_, capabilities.width);
    } else {
      ++without_ht_;
    }
    if (capabilities == *usual_) return;
    others_.insert(std::ranges::lower_bound(others_, station, {}, &Other::first),
                   {station, capabilities});
  }
  /// Whether every station supports a class: else its frames need protection, those of OFDM (IEEE
  /// Std 802.11-2020, 10.27.2) and those of HT and what came after it (10.27.3).
  bool all_support(ModulationClass modulation) const {
    return (of_all_ & Capabilities::bit(modulation)) != 0;
  }
  /// Whether some stations support OFDM and others do not.
  bool is_mixed() const {
    return !all_support(ModulationClass::kOfdm) &&
           (of_some_ & Capabilities::bit(ModulationClass::kOfdm)) != 0;
  }
  /// Number of stations without HT.
  std::size_t without_ht() const { return without_ht_; }
  /// Least and greatest width of the stations with HT, MHz; 20 if there are none.
  std::uint16_t narrowest() const { return std::min(narrowest_, widest_); }
  std::uint16_t widest() const { return widest_; }
  /// Whether all stations have equal capabilities.
  bool is_uniform() const { return others_.empty(); }
  /// Of an address without a station: those of the station that was added first.
  Capabilities capabilities(hal::AgentId station) const {
    const auto found = std::ranges::lower_bound(others_, station, {}, &Other::first);
    if (found != others_.end() && found->first == station) return found->second;
    return usual_.value_or(Capabilities{});
  }

 private:
  using Other = std::pair<hal::AgentId, Capabilities>;

  std::optional<Capabilities>
      usual_;                  ///< Of the first station, and of all that are not in others_.
  std::vector<Other> others_;  ///< In ascending order of stations.
  std::uint8_t of_some_ = 0, of_all_ = 0xff;
  std::size_t without_ht_ = 0;
  std::uint16_t narrowest_ = 0xffff, widest_ = 20;  ///< MHz
};

}  // namespace sim::radio
