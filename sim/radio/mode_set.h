#pragma once

#include <memory>
#include <vector>

#include "sim/radio/phy_mode.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// The modes of a radio: what its stations can send and receive. A new PHY is a class of modes and
/// a line in the constructor.
class ModeSet {
 public:
  explicit ModeSet(const RadioConfig& config);

  /// @pre there is one of this rate. Valid as long as the set.
  const PhyMode& at(hal::BitsPerSecond rate) const;
  const PhyMode& lowest() const { return *modes_.front(); }

 private:
  std::vector<std::unique_ptr<const PhyMode>> modes_;  ///< By rate, not empty.
};

}  // namespace sim::radio
