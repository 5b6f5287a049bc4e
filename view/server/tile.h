#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "view/server/json_text.h"

namespace view::server {

/// A tile of a run's record: the span [index * 8^level, (index + 1) * 8^level) ns. Tiles of one
/// level cover all of time once, each has eight below it: a datum has the same address however the
/// page came to it.
struct Span {
  static constexpr int kFinest = 4, kCoarsest = 17;

  int level = kFinest;
  std::int64_t index = 0;

  std::int64_t from() const { return index << (3 * level); }
  std::int64_t to() const { return (index + 1) << (3 * level); }

  /// None: there is no such tile.
  static std::optional<Span> of(std::int64_t level, std::int64_t index) {
    constexpr int kBitsOfTime = 62;
    if (level < kFinest || level > kCoarsest || index < 0) return std::nullopt;
    if (index >= std::int64_t{1} << (kBitsOfTime - 3 * level)) return std::nullopt;
    return Span{static_cast<int>(level), index};
  }
};

/// Parts of equal length that a summary of a tile has: 8^2, so that they are spans as well.
inline constexpr std::int64_t kBins = 64;

/// Which of the 64 parts of a span a time is in. @pre it is in the span
inline std::size_t bin_of(const Span& span, std::int64_t at) {
  return static_cast<std::size_t>((at - span.from()) >> (3 * (span.level - 2)));
}

/// So many rows make a tile too full to be sent whole.
inline constexpr std::int64_t kMostRows = 5000, kMostPoses = 20000;

/// Rows, kept column by column.
///
///   Columns states({"agent", "at", "state"});
///   states.add(1, 0, "IDLE");
class Columns {
 public:
  Columns(std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) columns_.emplace_back(std::string(name), JsonArray{});
  }

  /// As many values as there are columns.
  template <class... Values>
  void add(const Values&... values) {
    std::size_t i = 0;
    (columns_.at(i++).second.add(values), ...);
    ++rows_;
  }

  std::size_t rows() const { return rows_; }

  Json json() const {
    JsonObject object;
    for (const auto& [name, values] : columns_) object.add(name, values.json());
    return object.json();
  }

 private:
  std::vector<std::pair<std::string, JsonArray>> columns_;
  std::size_t rows_ = 0;
};

/// How many in each of the 64 parts of a span.
using Counts = std::array<std::int64_t, kBins>;

}  // namespace view::server
