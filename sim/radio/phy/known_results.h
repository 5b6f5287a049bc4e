#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sim::radio {

/// Results of a function of a ratio and a key, of those that were asked for last: between stations
/// that stand still the same few ratios occur again and again. Not for several threads.
/// @tparam Key  compared by ==. @tparam bits  it holds 2^bits results.
template <class Key, int bits>
class KnownResults {
 public:
  /// @param ratio  >= 0. @param compute  called with `ratio`, unless its result is known.
  template <class Compute>
  double of(double ratio, const Key& key, Compute&& compute) {
    Entry& entry = entries_[place_of(ratio)];
    if (entry.ratio != ratio || entry.key != key) entry = {ratio, compute(ratio), key};
    return entry.result;
  }

 private:
  struct Entry {
    double ratio = -1, result = 0;
    Key key{};
  };
  static std::size_t place_of(double ratio) {
    constexpr std::uint64_t kMix = 0x9e37'79b9'7f4a'7c15;  // 2^64 over the golden ratio
    return std::bit_cast<std::uint64_t>(ratio) * kMix >> (64 - bits);
  }

  std::array<Entry, std::size_t{1} << bits> entries_{};
};

}  // namespace sim::radio
