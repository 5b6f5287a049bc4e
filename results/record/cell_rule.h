#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "results/record/schema.h"

namespace results::record {

/// Upper limit of times [ns], about 32 years: the longest duration that a scenario can have.
inline constexpr std::int64_t kLatestTime = 1'000'000'000'000'000'000;

/// Values that a column allows: all that a run can write there, and some more. A file that somebody
/// else wrote can have any value of any type in any cell (sqlite.org/flextypegood.html).
struct CellRule {
  enum class Kind : std::uint8_t { kInteger, kReal, kText, kAny };

  const Table* table = nullptr;
  const Column* column = nullptr;
  Kind kind = Kind::kAny;
  bool may_be_null = true;
  bool is_agent = false;             ///< The value must be in the table agents, or a group address.
  bool may_be_zero = false;          ///< For an agent: 0 stands for none.
  bool is_time = false;              ///< Not after the end of the run, which lowers `most`.
  std::int64_t least = 0, most = 0;  ///< Limits of an integer.
  double lowest = -std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::max();  ///< Limits of a real number.
  std::size_t longest = 0;                              ///< Maximum length of a text [byte].
  std::span<const std::string_view> words{};            ///< Allowed texts; empty: any.
};

/// Derives the rule from the column's type, name, unit and meaning. An agent may be 0 only where
/// the meaning says so ("0: unknown"). A verdict must be one that a frame can have, or one that the
/// meaning of a column `verdict` of any table has in quotes.
CellRule rule_of(const Table& table, const Column& column);

/// Whether two rules are equal except for nulls and for agent 0.
bool is_alike(const CellRule& one, const CellRule& other);

/// Whether a sum of such cells obeys the same rule: not for flags, times and addresses.
bool may_be_summed(const CellRule& rule);

/// SQL condition that is true for a cell that breaks the rule; used to find its row.
std::string broken_sql(const CellRule& rule);

/// For messages about a cell that breaks the rule: "not a whole number from 0 to 65535".
std::string expected(const CellRule& rule);

}  // namespace results::record
