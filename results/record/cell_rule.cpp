#include "results/record/cell_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "hal/types/verdict.h"
#include "sim/radio/mac/frame_class.h"

namespace results::record {
namespace {

using Kind = CellRule::Kind;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMostAgents = 65535;  // includes the group addresses
/// Greatest number of frames, messages, bytes, ...: above it binary64 cannot represent all
/// integers. A radio that sends a million frames per second for 32 years stays below it.
constexpr std::int64_t kMostCounted = std::int64_t{1} << 53;
/// Greatest sum of times, over all agents or all messages.
constexpr std::int64_t kLongestSum = std::int64_t{1} << 62;
constexpr std::int64_t kMostInt = std::numeric_limits<int>::max();
constexpr double kFarthest = 1e12;       // m and rad
constexpr double kLongestSeconds = 1e9;  // as kLatestTime
constexpr std::size_t kLongestName = std::size_t{64} << 10;
constexpr std::size_t kLongestText = std::size_t{16} << 20;

constexpr std::array<std::string_view, 8> kAgentColumns{
    "agent", "a", "b", "sender", "station", "transmitter", "source", "lost_at"};
constexpr std::array<std::string_view, 5> kAddressColumns{"peer", "receiver", "destination",
                                                          "next_hop", "access_point"};
constexpr std::array<std::string_view, 7> kFlagColumns{
    "addressed", "retry", "found", "replied", "began", "is_default", "expectations_met"};
constexpr std::array<std::string_view, 3> kShortColumns{"sequence", "hops", "port"};
/// Columns that are read as int.
constexpr std::array<std::string_view, 6> kIntColumns{"point",    "factor",        "replication",
                                                      "attempts", "transmissions", "process"};
constexpr std::array<std::string_view, 5> kAnyIntegerColumns{"seed", "hash", "payload_hash",
                                                             "frame", "status"};
constexpr std::array<std::string_view, 3> kTimeColumns{"at_ns", "sent_ns", "fate_ns"};
constexpr std::array<std::string_view, 6> kLongTextColumns{"value",   "scenario", "error",
                                                           "reading", "bytes",    "text"};
/// Columns that a computation can make infinite, or in which infinity stands for an open end.
constexpr std::array<std::string_view, 8> kUnboundedColumns{
    "lower", "upper", "sum", "mean", "sd", "min", "max", "mean_over_time"};

bool is_in(const auto& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// Adds the words that the meaning has in quotes, such as 'queue full'.
void add_quoted(std::vector<std::string_view>& words, std::string_view meaning) {
  for (std::size_t open = 0; (open = meaning.find('\'', open)) != std::string_view::npos;) {
    const std::size_t close = meaning.find('\'', open + 1);
    if (close == std::string_view::npos) return;
    const std::string_view word = meaning.substr(open + 1, close - open - 1);
    if (!is_in(words, word)) words.push_back(word);
    open = close + 1;
  }
}

std::vector<std::string_view> verdict_words() {
  std::vector<std::string_view> words;
  words.reserve(hal::kVerdictCount);
  for (int i = 0; i < hal::kVerdictCount; ++i)
    words.push_back(hal::name(static_cast<hal::Verdict>(i)));
  // "under way", "transmitted", ...: verdicts that only some tables have.
  for (const Table& table : tables()) {
    for (const Column& column : table.columns) {
      if (column.name == "verdict") add_quoted(words, column.meaning);
    }
  }
  return words;
}

std::vector<std::string_view> class_words() {
  std::vector<std::string_view> words;
  words.reserve(sim::radio::kFrameClasses);
  for (int i = 0; i < sim::radio::kFrameClasses; ++i)
    words.push_back(sim::radio::name(static_cast<sim::radio::FrameClass>(i)));
  return words;
}

std::span<const std::string_view> words_of(std::string_view table, std::string_view column) {
  static const std::vector<std::string_view> verdicts = verdict_words(), classes = class_words();
  static constexpr std::array<std::string_view, 3> kKinds{"mote", "robot", "station"};
  static constexpr std::array<std::string_view, 4> kKept{"samples", "histogram", "quantiles",
                                                         "counter"};
  static constexpr std::array<std::string_view, 4> kStates{"waiting", "running", "done", "failed"};
  if (column == "verdict") return verdicts;
  if (column == "class") return classes;
  if (table == "agents" && column == "kind") return kKinds;
  if (table == "observables" && column == "keeps") return kKept;
  if (table == "runs" && column == "state") return kStates;
  return {};
}

/// Whether the meaning defines 0, as in "agent; 0: unknown".
bool meaning_of_zero(std::string_view meaning) {
  return meaning.starts_with("0: ") || meaning.find(" 0: ") != std::string_view::npos;
}

void set_range(CellRule& rule) {
  const std::string_view name = rule.column->name;
  rule.is_agent = is_in(kAgentColumns, name) && rule.table->name != "agents";
  rule.may_be_zero = rule.is_agent && meaning_of_zero(rule.column->meaning);
  rule.is_time = is_in(kTimeColumns, name);
  rule.most = kMostCounted;
  if (rule.is_time) {
    rule.most = kLatestTime;
  } else if (rule.column->unit == "ns") {
    rule.most = kLongestSum;
  } else if (is_in(kAgentColumns, name) || is_in(kAddressColumns, name) ||
             is_in(kShortColumns, name)) {
    rule.most = kMostAgents;
  } else if (is_in(kFlagColumns, name)) {
    rule.most = 1;
  } else if (is_in(kIntColumns, name)) {
    rule.most = kMostInt;
  } else if (name == "second") {
    rule.most = kLatestTime / 1'000'000'000;
  } else if (is_in(kAnyIntegerColumns, name)) {
    rule.least = -kLast - 1;
    rule.most = kLast;
  }
}

void set_bounds(CellRule& rule) {
  const std::string_view unit = rule.column->unit;
  if (unit == "m" || unit == "rad") {
    rule.highest = kFarthest;
    rule.lowest = -kFarthest;
  } else if (unit == "s") {
    rule.highest = kLongestSeconds;
    rule.lowest = 0;
  } else if (unit == "dB" || unit == "dBm" || is_in(kUnboundedColumns, rule.column->name)) {
    rule.highest = kInfinite;  // e.g. without noise or power
    rule.lowest = -kInfinite;
  }
}

std::string quoted_list(std::span<const std::string_view> words) {
  return fmt::format("'{}'", fmt::join(words, "', '"));
}

std::string broken_integer_sql(const CellRule& rule) {
  const std::string_view name = rule.column->name;
  std::string sql = fmt::format("{} NOT BETWEEN {} AND {}", name, rule.least, rule.most);
  if (!rule.is_agent) return sql;
  return sql +
         fmt::format(" OR {0} BETWEEN {1} AND 65533 AND {0} NOT IN (SELECT agent FROM agents)",
                     name, rule.may_be_zero ? 1 : 0);
}

std::string broken_text_sql(const CellRule& rule) {
  const std::string_view name = rule.column->name;
  std::string sql = fmt::format("length(CAST({} AS BLOB)) > {}", name, rule.longest);
  if (rule.words.empty()) return sql;
  return sql + fmt::format(" OR {} NOT IN ({})", name, quoted_list(rule.words));
}

/// The WHEN branches for values that are neither null nor a blob.
std::string broken_value_sql(const CellRule& rule) {
  const std::string_view name = rule.column->name;
  switch (rule.kind) {
    case Kind::kInteger:
      return fmt::format("WHEN 'integer' THEN {} ELSE 1", broken_integer_sql(rule));
    case Kind::kReal:
      if (rule.highest == kInfinite) return "WHEN 'text' THEN 1 ELSE 0";
      return fmt::format("WHEN 'text' THEN 1 ELSE {} NOT BETWEEN {:.17g} AND {:.17g}", name,
                         rule.lowest, rule.highest);
    case Kind::kText:
      return fmt::format("WHEN 'text' THEN {} ELSE 1", broken_text_sql(rule));
    case Kind::kAny:
      break;
  }
  return fmt::format("WHEN 'text' THEN {} WHEN 'integer' THEN 0 ELSE abs({}) > {:.17g}",
                     broken_text_sql(rule), name, rule.highest);
}

}  // namespace

CellRule rule_of(const Table& table, const Column& column) {
  CellRule rule{.table = &table, .column = &column};
  const std::string_view type = column.type.substr(0, column.type.find(' '));
  rule.may_be_null = column.type.find("NOT NULL") == std::string_view::npos &&
                     column.type.find("PRIMARY KEY") == std::string_view::npos;
  rule.longest = is_in(kLongTextColumns, column.name) ? kLongestText : kLongestName;
  if (type == "INTEGER") {
    rule.kind = Kind::kInteger;
    set_range(rule);
  } else if (type == "REAL") {
    rule.kind = Kind::kReal;
    set_bounds(rule);
  } else if (type == "TEXT") {
    rule.kind = Kind::kText;
    rule.words = words_of(table.name, column.name);
  }
  return rule;
}

bool is_alike(const CellRule& one, const CellRule& other) {
  return one.kind == other.kind && one.is_agent == other.is_agent && one.is_time == other.is_time &&
         one.least == other.least && one.most == other.most && one.lowest == other.lowest &&
         one.highest == other.highest && one.longest == other.longest &&
         one.words.data() == other.words.data();
}

bool may_be_summed(const CellRule& rule) {
  if (rule.kind == Kind::kReal) return true;
  return rule.kind == Kind::kInteger && rule.most >= kMostCounted && !rule.is_time;
}

std::string broken_sql(const CellRule& rule) {
  const std::string_view name = rule.column->name;
  // typeof(): the query planner trusts NOT NULL and declared types, and answers IS NULL without
  // reading the cell.
  return fmt::format("CASE typeof({}) WHEN 'null' THEN {} WHEN 'blob' THEN 1 {} END", name,
                     rule.may_be_null ? 0 : 1, broken_value_sql(rule));
}

std::string expected(const CellRule& rule) {
  switch (rule.kind) {
    case Kind::kInteger:
      if (rule.is_agent) return "no agent of this run";
      return fmt::format("not a whole number from {} to {}{}", rule.least, rule.most,
                         rule.is_time ? ", when the run ended" : "");
    case Kind::kReal:
      if (rule.highest == kInfinite) return "not a number";
      return fmt::format("not a number from {:g} to {:g}", rule.lowest, rule.highest);
    case Kind::kText:
      if (!rule.words.empty()) return fmt::format("not one of {}", quoted_list(rule.words));
      break;
    case Kind::kAny:
      break;
  }
  return fmt::format("not {} of up to {} bytes",
                     rule.kind == Kind::kText ? "a text" : "a number, nor a text", rule.longest);
}

}  // namespace results::record
