#include "results/record/scalars.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "results/record/topic_name.h"
#include "sim/scenario/dds_value.h"

namespace results::record {
namespace {

bool is_of_dds(std::string_view name) {
  return name.starts_with(sim::scenario::kDdsDomain) &&
         name.substr(sim::scenario::kDdsDomain.size()).starts_with('.');
}

/// "dds.TOPIC.VALUE", where the topic may contain dots.
std::string topic_value_name(const std::string& name) {
  const std::size_t begin = sim::scenario::kDdsDomain.size() + 1;
  const std::size_t end = std::max(begin, name.rfind('.'));
  return name.substr(0, begin) + topic_part(std::string_view(name).substr(begin, end - begin)) +
         name.substr(end);
}

/// Applies name_part() to each part: the name of a value that a controller records is arbitrary.
std::string observable_name(const std::string& name) {
  if (is_of_dds(name)) return topic_value_name(name);
  std::string result;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('.', begin), name.size());
    result +=
        (result.empty() ? "" : ".") + name_part(std::string_view(name).substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

/// Makes unique names from words of scenarios and controllers. Different words can become equal by
/// name_part(), such as "cam-1" and "cam_1": the later ones in their order get the suffix "_2",
/// "_3", ….
class Names {
 public:
  explicit Names(RunReader& reader) {
    Statement words = reader.query(
        "SELECT name FROM observables UNION SELECT 'controllers.' || name FROM recorded"
        " UNION SELECT 'controllers.' || word FROM countable WHERE family = 'controllers'"
        " ORDER BY 1");
    while (words.next()) (void)of_observable(words.text(0));
  }

  std::string of_observable(const std::string& words) { return of(words, observable_name(words)); }

  /// Replaces the word in capitals: "topics.TOPIC.sent" with "call" is "topics.call.sent".
  std::string in_family(std::string_view family, const std::string& word) {
    const auto [head, tail] = *around_word(family);
    const std::string domain(head);
    if (is_of_dds(family)) return (domain + topic_part(word)).append(tail);
    return of(domain + word, domain + name_part(word)).append(tail);
  }

 private:
  std::string of(const std::string& words, const std::string& wanted) {
    const auto [name, is_new] = given_.try_emplace({words, wanted}, wanted);
    for (int next = 2; is_new && !taken_.insert(name->second).second; ++next) {
      name->second = wanted + "_" + std::to_string(next);
    }
    return name->second;
  }

  /// By word and unsuffixed name.
  std::map<std::pair<std::string, std::string>, std::string> given_;
  std::set<std::string> taken_;
};

/// The name of a scalar. @param rows  at a row of the kind's query.
std::string name_of(const ScalarKind& kind, Names& names, const Statement& rows) {
  const auto first = around_word(kind.name);
  if (!first) return std::string(kind.name);
  std::string name = names.in_family(kind.name, rows.text(2));
  const auto second = around_word(first->second);
  if (!second) return name;
  name.resize(name.size() - first->second.size());
  return name.append(second->first).append(name_part(rows.text(3))).append(second->second);
}

void read(RunReader& reader, const ScalarKind& kind, Names& names, std::vector<Scalar>& to) {
  Statement rows = reader.query(kind.query);
  while (rows.next()) {
    if (rows.is_null(1)) continue;
    const double value = rows.real(1);
    if (!std::isfinite(value)) continue;
    if (value < 0 && ::results::record::range_of(kind.name) != Range::kAny)
      rows.refuse(1, "negative");
    to.push_back({.name = name_of(kind, names, rows),
                  .unit = std::string(kind.unit),
                  .agent = rows.text(0),
                  .value = value});
  }
}

/// Sums of the observables. If one is kept in two ways, the first counts.
constexpr const char* kSums =
    "WITH first AS (SELECT MIN(observable) AS observable FROM observables GROUP BY name, agent),"
    " some AS (SELECT o.name, o.agent, o.unit, count, mean, mean_over_time, sd, min, max, last"
    " FROM first JOIN observables o USING (observable) JOIN observable_sums USING (observable))"
    " SELECT a.name, p.name, part, p.unit, v FROM ("
    "SELECT name, agent, unit, 0 AS place, '.count' AS part, count AS v FROM some"
    " UNION ALL SELECT name, agent, unit, 1, '.mean', mean FROM some"
    " UNION ALL SELECT name, agent, unit, 2, '.mean_over_time', mean_over_time FROM some"
    " UNION ALL SELECT name, agent, unit, 3, '.sd', sd FROM some"
    " UNION ALL SELECT name, agent, unit, 4, '.min', min FROM some"
    " UNION ALL SELECT name, agent, unit, 5, '.max', max FROM some"
    " UNION ALL SELECT name, agent, unit, 6, '.last', last FROM some"
    " UNION ALL SELECT name, agent, unit, 7 + share, printf('.p%02d', round(100 * share)), value"
    " FROM observable_quantiles JOIN observables USING (observable)"
    " WHERE observable IN (SELECT MIN(observable) FROM observables WHERE keeps = 'quantiles'"
    " GROUP BY name, agent)) p"
    " JOIN agents a USING (agent) WHERE v IS NOT NULL ORDER BY p.name, agent, place";

void read_sums(RunReader& reader, Names& names, std::vector<Scalar>& to) {
  Statement rows = reader.query(kSums);
  while (rows.next()) {
    const bool is_count = rows.text(2) == ".count";
    const double value = rows.real(4);
    if (!std::isfinite(value)) continue;  // overflow of a sum of very large values
    to.push_back({.name = names.of_observable(rows.text(1)) + rows.text(2),
                  .unit = is_count ? "1" : rows.text(3),
                  .agent = rows.text(0),
                  .value = value});
  }
}

/// @param rows  agent, name, ns, value, unit, rowid; grouped by series, each in order of time.
void read_points(Statement& rows, const std::string& domain, Names& names,
                 std::vector<Series>& to) {
  while (rows.next()) {
    const std::string name = names.of_observable(domain + rows.text(1));
    if (to.empty() || to.back().name != name || to.back().agent != rows.text(0)) {
      to.push_back({.name = name, .unit = rows.text(4), .agent = rows.text(0), .points = {}});
    }
    const double at = static_cast<double>(rows.integer(2)) * 1e-9;
    auto& points = to.back().points;
    if (!points.empty() && at < points.back().first)
      rows.refuse(2, "before that of an earlier row");
    points.emplace_back(at, rows.real(3));
  }
}

}  // namespace

std::string name_part(std::string_view text) {
  std::string part(text);
  for (char& c : part) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const bool is_kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (!is_kept) c = '_';
  }
  return part;
}

std::vector<Scalar> scalars_of(RunReader& reader) {
  Names names(reader);
  std::vector<Scalar> scalars;
  for (const ScalarKind& kind : scalar_kinds()) read(reader, kind, names, scalars);
  std::vector<Scalar> observed;
  read_sums(reader, names, observed);
  std::set<std::pair<std::string, std::string>> seen;
  for (const Scalar& one : observed) seen.emplace(one.name, one.agent);
  // If a value that a controller records is also observed, only the observable is kept.
  std::erase_if(scalars, [&](const Scalar& one) { return seen.contains({one.name, one.agent}); });
  scalars.insert(scalars.end(), observed.begin(), observed.end());
  return scalars;
}

std::vector<Series> series_of(RunReader& reader) {
  Names names(reader);
  std::vector<Series> all;
  Statement samples = reader.query(
      "SELECT a.name, o.name, at_ns, value, unit, s.rowid AS rowid FROM observable_samples s"
      " JOIN observables o USING (observable) JOIN agents a USING (agent)"
      " WHERE observable IN (SELECT MIN(observable) FROM observables WHERE keeps = 'samples'"
      " GROUP BY name, agent)"
      " ORDER BY o.name, agent, observable, s.rowid");
  read_points(samples, "", names, all);
  Statement recorded = reader.query(
      "SELECT a.name, r.name, at_ns, value, '', r.rowid AS rowid FROM recorded r"
      " JOIN agents a USING (agent)"
      " WHERE NOT EXISTS (SELECT 1 FROM observables o WHERE o.agent = r.agent"
      " AND o.name = 'controllers.' || r.name AND keeps = 'samples')"
      " ORDER BY r.name, r.agent, r.rowid");
  read_points(recorded, "controllers.", names, all);
  return all;
}

std::vector<Bins> bins_of(RunReader& reader) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Statement rows = reader.query(
      "SELECT a.name, o.name, unit, lower, upper, count FROM observable_bins b"
      " JOIN observables o USING (observable) JOIN agents a USING (agent)"
      " WHERE observable IN (SELECT MIN(observable) FROM observables WHERE keeps = 'histogram'"
      " GROUP BY name, agent)"
      " ORDER BY o.name, agent, observable, b.rowid");
  Names names(reader);
  std::vector<Bins> all;
  while (rows.next()) {
    const std::string name = names.of_observable(rows.text(1));
    if (all.empty() || all.back().name != name || all.back().agent != rows.text(0)) {
      all.push_back({.name = name, .unit = rows.text(2), .agent = rows.text(0), .bins = {}});
    }
    all.back().bins.push_back({.lower = rows.is_null(3) ? -kInfinite : rows.real(3),
                               .upper = rows.is_null(4) ? kInfinite : rows.real(4),
                               .count = static_cast<std::uint64_t>(rows.integer(5))});
  }
  return all;
}

}  // namespace results::record
