#include "sim/radio/channel/random_loss.h"

#include <algorithm>

#include "hal/types/check.h"
#include "hal/types/pattern.h"
#include "hal/types/random.h"

namespace sim::radio {
namespace {

/// Mask for the part of a frame's id that counts its transmitter's frames, without the address.
constexpr std::uint64_t kNumber = (std::uint64_t{1} << 48) - 1;

std::vector<bool> fitting(const std::string& pattern, const RandomLoss::Names& names) {
  std::vector<bool> fits;
  fits.reserve(names.size());
  for (const auto& [agent, name] : names) fits.push_back(hal::matches(pattern, name));
  return fits;
}

}  // namespace

RandomLoss::RandomLoss(const LossConfig& config, std::uint64_t seed, const Names& names)
    : everywhere_(config.probability) {
  for (const auto& [agent, name] : names) {
    stations_.push_back({agent, hal::RandomStream(seed, name + "/loss").next()});
  }
  for (const LossConfig::Link& link : config.links) {
    links_.push_back({fitting(link.from, names), fitting(link.to, names), link.probability});
  }
}

std::size_t RandomLoss::place_of(hal::AgentId agent) const {
  const auto found = std::ranges::lower_bound(stations_, agent, {}, &Station::agent);
  BARAKA_CHECK(found != stations_.end() && found->agent == agent);
  return static_cast<std::size_t>(found - stations_.begin());
}

double RandomLoss::probability(std::size_t from, std::size_t to) const {
  const auto last = std::find_if(links_.rbegin(), links_.rend(), [from, to](const Link& link) {
    return link.from[from] && link.to[to];
  });
  return last == links_.rend() ? everywhere_ : last->probability;
}

bool RandomLoss::strikes(const Frame& frame, hal::AgentId receiver) const {
  const std::size_t from = place_of(frame.transmitter), to = place_of(receiver);
  const double lost = probability(from, to);
  if (lost <= 0) return false;
  // Odd factors: the reverse direction is another link, and another frame is another draw.
  const std::uint64_t link = stations_[from].name * 0x9e3779b97f4a7c15u + stations_[to].name;
  const std::uint64_t number = (frame.id & kNumber) * 0xd1342543de82ef95u;
  return hal::RandomStream(link + number, "loss").uniform() < lost;
}

}  // namespace sim::radio
