#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "results/record/schema.h"

namespace results::record {

/// A run ends before this [ns], about 32 years: the longest duration that a scenario can have.
inline constexpr std::int64_t kLatestTime = 1'000'000'000'000'000'000;

/// What a cell of a column may hold: what a run can have written there, with room. A file that
/// somebody else wrote may have any value of any type in any cell (sqlite.org/flextypegood.html).
struct CellRule {
  enum class Kind : std::uint8_t { kInteger, kReal, kText, kAny };

  const Table* table = nullptr;
  const Column* column = nullptr;
  Kind kind = Kind::kAny;
  bool may_be_null = true;
  bool is_agent = false;             ///< An agent of the table agents, or everyone.
  bool may_be_zero = false;          ///< Of an agent: 0 stands for none.
  bool is_time = false;              ///< Not after the end of the run: `most` can become less.
  std::int64_t least = 0, most = 0;  ///< Of an integer.
  double lowest = -std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::max();  ///< Of a real number.
  std::size_t longest = 0;                              ///< Bytes of a text.
  std::span<const std::string_view> words{};            ///< Of a text; empty: any.
};

/// By the column's type, name, unit and meaning: an agent is 0 only where the meaning says
/// "0: unknown", a verdict is one that a frame can have or one that the meaning of any column of
/// that name has in quotes.
CellRule rule_of(const Table& table, const Column& column);

/// Whether both allow the same but for nulls, and for 0 of agents.
bool is_alike(const CellRule& one, const CellRule& other);

/// Whether a sum of such cells is as one of them may be: not of flags, times or addresses.
bool may_be_summed(const CellRule& rule);

/// "true in SQL for a cell that may not be": to find its row.
std::string broken_sql(const CellRule& rule);

/// "not a whole number from 0 to 65535": of a cell that may not be.
std::string expected(const CellRule& rule);

}  // namespace results::record
