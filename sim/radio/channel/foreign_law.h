#pragma once

#include "sim/radio/channel/path_loss.h"

namespace sim::radio {

/// A law of a program that links the simulator, or of a test. Files cannot name it; records and
/// messages do.
struct ForeignLawConfig {
  std::string_view model;  ///< Its name; outlives the config, as a literal does.
  PathLossKind kind = PathLossKind::kLawOfDistance;
  /// Never null. @param air  as path_loss() gets it.
  std::unique_ptr<const PathLoss> (*make)(const PropagationConfig& air) = nullptr;
};

/// Its settings are in itself.
template <class Fields>
void keys_of(Fields& /*io*/, ForeignLawConfig& /*config*/) {}

inline std::unique_ptr<const PathLoss> make(const ForeignLawConfig& config,
                                            const PropagationConfig& air,
                                            const Ground& /*ground*/) {
  return config.make(air);
}

}  // namespace sim::radio
