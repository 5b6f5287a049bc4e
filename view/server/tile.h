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

/// A tile of a run's record: the time span [index * 8^level, (index + 1) * 8^level) ns. The tiles
/// of one level cover all times without overlap, and each tile consists of eight tiles of the level
/// below. So a datum always has the same address, however the page arrived there.
struct Span {
  static constexpr int kFinest = 4, kCoarsest = 17;

  int level = kFinest;
  std::int64_t index = 0;

  std::int64_t from() const { return index << (3 * level); }
  std::int64_t to() const { return (index + 1) << (3 * level); }

  /// None if there is no such tile.
  static std::optional<Span> of(std::int64_t level, std::int64_t index) {
    constexpr int kBitsOfTime = 62;
    if (level < kFinest || level > kCoarsest || index < 0) return std::nullopt;
    if (index >= std::int64_t{1} << (kBitsOfTime - 3 * level)) return std::nullopt;
    return Span{static_cast<int>(level), index};
  }
};

/// Number of equal parts in the summary of a tile: 8^2, so that each part is a span of the grid as
/// well.
inline constexpr std::int64_t kBins = 64;

/// The part of a span, of kBins, in which a time is. @pre the time is in the span.
inline std::size_t bin_of(const Span& span, std::int64_t at) {
  return static_cast<std::size_t>((at - span.from()) >> (3 * (span.level - 2)));
}

/// Tiles with more rows than this are sent as a summary.
inline constexpr std::int64_t kMostRows = 5000, kMostPoses = 20000;

/// Rows of a table, stored by column.
///
///   Columns states({"agent", "at", "state"});
///   states.add(1, 0, "IDLE");
class Columns {
 public:
  Columns(std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) columns_.emplace_back(std::string(name), JsonArray{});
  }

  /// Adds a row. @pre there are as many values as columns.
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

/// Counts for the parts of a span.
using Counts = std::array<std::int64_t, kBins>;

}  // namespace view::server
