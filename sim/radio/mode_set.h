#pragma once

#include <memory>
#include <vector>

#include "sim/radio/phy_mode.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// The PHY modes that a radio's stations can send and receive. A new PHY is a class of modes and a
/// line in the constructor.
class ModeSet {
 public:
  explicit ModeSet(const RadioConfig& config);

  /// @pre there is one of this rate. Valid as long as the set.
  const PhyMode& at(hal::BitsPerSecond rate) const;
  /// Ascending rates.
  const std::vector<std::unique_ptr<const PhyMode>>& all() const { return modes_; }
  const PhyMode& lowest() const { return *modes_.front(); }
  const PhyMode& data() const { return *data_; }
  const PhyMode& broadcast() const { return *broadcast_; }
  const PhyMode& control() const { return *control_; }  ///< RTS.
  /// Of a CTS or ACK that answers a frame sent so: DcfConfig::basic_rates, or control() without.
  const PhyMode& response_to(const PhyMode& mode) const;

 private:
  void add(const WavesConfig& config);
  void add(const DcfConfig& config);
  void add(const Ieee80211gConfig& config);
  void add_dsss(const WavesConfig& config);
  void choose(const PhyConfig& config);
  void add(const DiskConfig& config);
  void add(const IdealConfig& config);
  void add_plain(hal::BitsPerSecond rate, bool is_instant);

  std::vector<std::unique_ptr<const PhyMode>> modes_;  ///< By rate, not empty.
  std::vector<const PhyMode*> basic_;                  ///< Ascending rates; none: control_.
  const PhyMode *data_ = nullptr, *broadcast_ = nullptr, *control_ = nullptr;
};

}  // namespace sim::radio
