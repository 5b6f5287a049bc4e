#include "sim/radio/channel/links.h"

#include <algorithm>

namespace sim::radio {

AskedLinks::Tick AskedLinks::tick(hal::Time time) {
  constexpr int kShift = 20;
  const std::int64_t ticks = time.time_since_epoch().count() >> kShift;
  return static_cast<Tick>(std::min<std::int64_t>(ticks, kForEver - 1));
}

void AskedLinks::insert(const Link& link, Tick until) {
  const auto place = std::ranges::lower_bound(links_, link.receiver, {}, &Link::receiver);
  until_.insert(until_.begin() + (place - links_.begin()), until);
  links_.insert(place, link);
  earliest_ = std::min(earliest_, until);
}

void AskedLinks::erase(StationIndex receiver) {
  const auto place = std::ranges::lower_bound(links_, receiver, {}, &Link::receiver);
  if (place == links_.end() || place->receiver != receiver) return;
  until_.erase(until_.begin() + (place - links_.begin()));
  links_.erase(place);
}

void AskedLinks::shrink() {
  links_.shrink_to_fit();
  until_.shrink_to_fit();
}

}  // namespace sim::radio
