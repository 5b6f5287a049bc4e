#include "results/record/pair_counts.h"

#include <algorithm>

namespace results::record {
namespace {

constexpr int kCountBits = 39;
constexpr std::uint64_t kChanged = std::uint64_t{1} << kCountBits;
constexpr std::uint64_t kCountMask = kChanged - 1;
constexpr int kKeyShift = kCountBits + 1;
constexpr std::size_t kSmallest = 8;

}  // namespace

/// Index of the word with the key, or of the free word for it. @pre at least one word is free.
std::size_t PairCounts::Table::place_of(std::uint32_t key) const {
  // Fibonacci hashing (Knuth, vol. 3, 6.4), scaled to the size of the table instead of masked.
  const std::uint32_t hash = key * std::uint32_t{2654435769U};
  std::size_t place = (std::size_t{hash} * words_.size()) >> 32U;
  while (words_[place] != 0 && words_[place] >> kKeyShift != key) {
    if (++place == words_.size()) place = 0;
  }
  return place;
}

bool PairCounts::Table::add(std::uint32_t key) {
  if (8 * std::size_t{used_} >= 7 * words_.size()) grow();
  std::uint64_t& word = words_[place_of(key)];
  if (word == 0) {
    word = std::uint64_t{key} << kKeyShift;
    ++used_;
  }
  const bool is_first = (word & kChanged) == 0;
  word = (word | kChanged) + 1;
  changed_ += is_first ? 1 : 0;
  return is_first;
}

void PairCounts::Table::grow() {
  std::vector<std::uint64_t> old(std::max(kSmallest, words_.size() + words_.size() / 2));
  old.swap(words_);
  for (const std::uint64_t word : old) {
    if (word != 0) words_[place_of(static_cast<std::uint32_t>(word >> kKeyShift))] = word;
  }
}

void PairCounts::Table::take_changes(Seconds range, std::uint16_t first,
                                     std::vector<Change>& changes) {
  if (changed_ == 0) return;
  for (std::uint64_t& word : words_) {
    if ((word & kChanged) == 0) continue;
    const auto key = static_cast<std::uint32_t>(word >> kKeyShift);
    const std::uint32_t second = key >> kKindBits;
    if (second < range.low || second >= range.high) continue;
    word &= ~kChanged;
    --changed_;
    changes.push_back({first, static_cast<std::uint16_t>(second), static_cast<std::uint8_t>(key),
                       word & kCountMask});
  }
}

}  // namespace results::record
