#pragma once

#include <memory>
#include <vector>

#include "sim/radio/phy/phy_mode.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// The PHY modes that a radio's stations can transmit and receive. To add a PHY, add a class of
/// modes and a line in the constructor.
class ModeSet {
 public:
  explicit ModeSet(const RadioConfig& config);

  /// The mode of a class without MCSs that has this rate.
  /// @pre there is one. @return a reference that is valid as long as the set.
  const PhyMode& at(hal::BitsPerSecond rate) const;
  /// Null: the set has no such mode.
  const PhyMode* find(const ModeId& id) const;
  /// @pre find() is not null.
  const PhyMode& at(const ModeId& id) const;
  /// All modes: those of classes without MCSs in ascending order of rates, then the others, older
  /// classes first.
  const std::vector<std::unique_ptr<const PhyMode>>& all() const { return modes_; }
  const PhyMode& lowest() const { return *modes_.front(); }
  const PhyMode& data() const { return *data_; }  ///< Of unicast data to a station of equal kind.
  const PhyMode& broadcast() const { return *broadcast_; }
  const PhyMode& beacon() const { return *beacon_; }
  const PhyMode& control() const { return *control_; }  ///< Mode of RTS.
  /// Mode of the CTS or ACK that answers a frame in `mode`: by DcfConfig::basic_rates, or control()
  /// if there are none. The highest basic rate that is not above the frame's reference_rate(), in
  /// its class; frames of classes with MCSs are answered in OFDM (IEEE Std 802.11-2020, 10.6.6.5).
  /// Without such a basic rate the highest mandatory one.
  const PhyMode& response_to(const PhyMode& mode) const;

 private:
  void add(const WavesConfig& config);
  void add(const DcfConfig& config);
  void add(const Ieee80211gConfig& config);
  void add(const HtConfig& config);
  void add_ofdm(const Ieee80211gConfig& config);
  void add_mcs(const HtConfig& config);
  void choose_basic(const DcfConfig& config);
  void add_dsss(const WavesConfig& config);
  void choose(const PhyConfig& config);
  void add(const DiskConfig& config);
  void add(const IdealConfig& config);
  void add_plain(hal::BitsPerSecond rate, bool is_instant);

  std::vector<std::unique_ptr<const PhyMode>> modes_;  ///< In ascending order of rates, not empty.
  std::vector<const PhyMode*> basic_;  ///< In ascending order of rates; if empty, control_ is used.
  const PhyMode *data_ = nullptr, *broadcast_ = nullptr, *control_ = nullptr, *beacon_ = nullptr;
};

}  // namespace sim::radio
