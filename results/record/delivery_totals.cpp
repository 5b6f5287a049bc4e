#include "results/record/delivery_totals.h"

#include <algorithm>
#include <utility>

namespace results::record {
namespace {

constexpr std::size_t kFewestPlaces = 16;  ///< A power of two.

}  // namespace

bool DeliveryTotals::add(const Key& key, std::uint64_t bytes, std::optional<hal::Duration> delay) {
  Total& total = total_of(key);
  ++total.count;
  total.bytes += bytes;
  if (delay) {
    total.sum += *delay;
    total.least = std::min(total.least, *delay);
    total.greatest = std::max(total.greatest, *delay);
  } else {
    ++total.late;
  }
  return !std::exchange(total.changed, true);
}

DeliveryTotals::Total& DeliveryTotals::total_of(const Key& key) {
  if (next_ >= totals_.size()) next_ = 0;
  if (next_ < totals_.size() && totals_[next_].key == key) return totals_[next_++];
  if (4 * totals_.size() >= 3 * places_.size()) grow();
  std::uint32_t& place = *place_of(key);
  if (place == 0) {
    totals_.push_back({.key = key});
    place = static_cast<std::uint32_t>(totals_.size());
  }
  next_ = place;
  return totals_[place - 1];
}

/// The place of the key, or the free place for it. @pre at least one place is free.
std::uint32_t* DeliveryTotals::place_of(const Key& key) {
  // Fibonacci hashing (D. E. Knuth, "The Art of Computer Programming", vol. 3, 6.4).
  const std::uint64_t word = (std::uint64_t{key.kind} << 32U) |
                             (std::uint64_t{key.transmissions} << 16U) | key.receiver.value;
  const std::size_t mask = places_.size() - 1;
  std::size_t place = ((word * 0x9e3779b97f4a7c15U) >> 32U) & mask;
  while (places_[place] != 0 && totals_[places_[place] - 1].key != key) place = (place + 1) & mask;
  return &places_[place];
}

void DeliveryTotals::grow() {
  places_.assign(std::max(kFewestPlaces, 2 * places_.size()), 0);
  for (std::size_t i = 0; i < totals_.size(); ++i) {
    *place_of(totals_[i].key) = static_cast<std::uint32_t>(i + 1);
  }
}

}  // namespace results::record
