#include "results/record/unheard_topics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace results::record {
namespace {

constexpr std::size_t kMostNamed = 8;

/// One row per topic, sender and verdict, for topics of which nothing was delivered.
constexpr const char* kUnheard =
    "WITH ends AS MATERIALIZED (SELECT * FROM message_ends)"
    " SELECT e.topic, a.name, e.verdict, SUM(e.count) FROM ends e"
    " JOIN agents a ON a.agent = e.sender"
    " WHERE e.topic NOT IN (SELECT topic FROM ends WHERE verdict = 'delivered')"
    " AND e.verdict <> 'under way'"
    " GROUP BY e.topic, e.sender, e.verdict ORDER BY e.topic, e.sender, e.verdict";

}  // namespace

std::vector<UnheardTopic> unheard_topics(Database& database) {
  std::vector<UnheardTopic> unheard;
  std::map<std::string, std::uint64_t> by_verdict;
  Statement query(database, kUnheard);
  while (query.next()) {
    if (unheard.empty() || unheard.back().topic != query.text(0)) {
      unheard.push_back({.topic = query.text(0)});
      by_verdict.clear();
    }
    UnheardTopic& last = unheard.back();
    if (last.senders.empty() || last.senders.back() != query.text(1)) {
      last.senders.push_back(query.text(1));
    }
    const auto count = static_cast<std::uint64_t>(query.integer(3));
    last.messages += count;
    const std::uint64_t with = by_verdict[query.text(2)] += count;
    if (with > last.with_verdict) {
      last.with_verdict = with;
      last.verdict = query.text(2);
    }
  }
  return unheard;
}

std::string to_line(const UnheardTopic& unheard) {
  const std::size_t named = std::min(kMostNamed, unheard.senders.size());
  const auto end = unheard.senders.begin() + static_cast<std::ptrdiff_t>(named);
  std::string senders = fmt::format("{}", fmt::join(unheard.senders.begin(), end, ", "));
  if (named < unheard.senders.size()) {
    senders += fmt::format(" and {} more", unheard.senders.size() - named);
  }
  return fmt::format("topic '{}': none of {} messages of {} arrived at anyone; {} ({})",
                     unheard.topic, unheard.messages, senders, unheard.verdict,
                     unheard.with_verdict);
}

}  // namespace results::record
