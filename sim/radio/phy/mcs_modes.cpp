#include "sim/radio/phy/mcs_modes.h"

#include <algorithm>

#include "sim/radio/phy/he_mode.h"
#include "sim/radio/phy/ht_mode.h"
#include "sim/radio/phy/vht_mode.h"

namespace sim::radio {
namespace {

using namespace std::chrono_literals;

constexpr hal::Duration kGuardOfAll = 800ns;
constexpr std::uint16_t kWidths[] = {20, 40, 80};

std::vector<ModulationClass> mcs_classes(ModulationClass newest, std::uint32_t channel) {
  std::vector<ModulationClass> classes{ModulationClass::kHt, ModulationClass::kVht,
                                       ModulationClass::kHe};
  std::erase_if(classes, [&](ModulationClass one) {
    return one > newest || (one == ModulationClass::kVht && !is_5ghz(channel));
  });
  return classes;
}

}  // namespace

bool exists(const ModeId& id) {
  switch (id.modulation) {
    case ModulationClass::kHt:
      return HtMode::exists(id);
    case ModulationClass::kVht:
      return VhtMode::exists(id);
    case ModulationClass::kHe:
      return HeMode::exists(id);
    default:
      return false;
  }
}

std::uint8_t highest_mcs(ModulationClass modulation) {
  if (modulation == ModulationClass::kHt) return HtMode::kHighestMcs;
  return modulation == ModulationClass::kVht ? VhtMode::kHighestMcs : HeMode::kHighestMcs;
}

std::unique_ptr<const PhyMode> make_mcs_mode(const ModeId& id, const McsMode::Options& options) {
  if (id.modulation == ModulationClass::kHt) return std::make_unique<HtMode>(id, options);
  if (id.modulation == ModulationClass::kVht) return std::make_unique<VhtMode>(id, options);
  return std::make_unique<HeMode>(id, options);
}

namespace {

/// Adds the modes of a class, MCS and number of streams, up to a width, with both guard intervals.
void add_widths(ModeId id, const ModeId& most, std::vector<ModeId>& all) {
  for (const std::uint16_t width : kWidths) {
    if (width > most.width) return;
    id.width = width;
    id.guard = kGuardOfAll;
    if (exists(id)) all.push_back(id);
    id.guard = most.guard;
    if (most.guard != kGuardOfAll && exists(id)) all.push_back(id);
  }
}

}  // namespace

std::vector<ModeId> modes_up_to(const ModeId& most, std::uint32_t channel) {
  std::vector<ModeId> all;
  for (const ModulationClass modulation : mcs_classes(most.modulation, channel)) {
    ModeId id{.modulation = modulation};
    for (id.mcs = 0; id.mcs <= most.mcs; ++id.mcs) {
      for (id.streams = 1; id.streams <= most.streams; ++id.streams) add_widths(id, most, all);
    }
  }
  std::ranges::sort(all);
  return all;
}

}  // namespace sim::radio
