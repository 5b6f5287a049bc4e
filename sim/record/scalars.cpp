#include "sim/record/scalars.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace sim::record {
namespace {

bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }

/// "topics.TOPIC.sent" with "call" for the word in capitals.
std::string with_part(std::string_view family, std::string_view part) {
  const auto* const begin = std::ranges::find_if(family, is_capital);
  const auto* const end = std::find_if_not(begin, family.end(), is_capital);
  std::string name(family.begin(), begin);
  name += name_part(part);
  name.append(end, family.end());
  return name;
}

void read(RunReader& reader, const ScalarKind& kind, std::vector<Scalar>& to) {
  const bool is_family = std::ranges::any_of(kind.name, is_capital);
  Statement rows = reader.query(kind.query);
  while (rows.next()) {
    if (rows.is_null(1)) continue;
    const double value = rows.real(1);
    if (!std::isfinite(value)) continue;
    to.push_back({.name = is_family ? with_part(kind.name, rows.text(2)) : std::string(kind.name),
                  .unit = std::string(kind.unit),
                  .agent = rows.text(0),
                  .value = value});
  }
}

/// With each part as in a name: what a controller records may be called anything.
std::string observable_name(const std::string& name) {
  std::string result;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('.', begin), name.size());
    result +=
        (result.empty() ? "" : ".") + name_part(std::string_view(name).substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

/// What there is of the observables in short. Where one is kept in two ways, the first counts.
constexpr const char* kSums =
    "WITH first AS (SELECT MIN(observable) AS observable FROM observables GROUP BY name, agent),"
    " some AS (SELECT o.name, o.agent, o.unit, count, mean, mean_over_time, sd, min, max, last"
    " FROM first JOIN observables o USING (observable) JOIN observable_sums USING (observable)"
    " WHERE count > 0)"
    " SELECT a.name, p.name, part, p.unit, v FROM ("
    "SELECT name, agent, unit, 0 AS place, '.count' AS part, count AS v FROM some"
    " UNION ALL SELECT name, agent, unit, 1, '.mean', mean FROM some"
    " UNION ALL SELECT name, agent, unit, 2, '.mean_over_time', mean_over_time FROM some"
    " UNION ALL SELECT name, agent, unit, 3, '.sd', sd FROM some"
    " UNION ALL SELECT name, agent, unit, 4, '.min', min FROM some"
    " UNION ALL SELECT name, agent, unit, 5, '.max', max FROM some"
    " UNION ALL SELECT name, agent, unit, 6, '.last', last FROM some"
    " UNION ALL SELECT name, agent, unit, 7 + share, printf('.p%02d', round(100 * share)), value"
    " FROM observable_quantiles JOIN observables USING (observable)) p"
    " JOIN agents a USING (agent) WHERE v IS NOT NULL ORDER BY p.name, agent, place";

void read_sums(RunReader& reader, std::vector<Scalar>& to) {
  Statement rows = reader.query(kSums);
  while (rows.next()) {
    const bool is_count = rows.text(2) == ".count";
    to.push_back({.name = observable_name(rows.text(1)) + rows.text(2),
                  .unit = is_count ? "1" : rows.text(3),
                  .agent = rows.text(0),
                  .value = rows.real(4)});
  }
}

/// @param rows  of agent, name, s, value, unit; those of one series follow one another.
void read_points(Statement& rows, const std::string& domain, std::vector<Series>& to) {
  while (rows.next()) {
    const std::string name = observable_name(domain + rows.text(1));
    if (to.empty() || to.back().name != name || to.back().agent != rows.text(0)) {
      to.push_back({.name = name, .unit = rows.text(4), .agent = rows.text(0), .points = {}});
    }
    to.back().points.emplace_back(rows.real(2), rows.real(3));
  }
}

}  // namespace

std::string name_part(std::string_view text) {
  std::string part(text);
  for (char& c : part) {
    if (is_capital(c)) c = static_cast<char>(c - 'A' + 'a');
    const bool is_kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    if (!is_kept) c = '_';
  }
  return part;
}

std::vector<Scalar> scalars_of(RunReader& reader) {
  std::vector<Scalar> scalars;
  for (const ScalarKind& kind : scalar_kinds()) read(reader, kind, scalars);
  std::vector<Scalar> observed;
  read_sums(reader, observed);
  std::set<std::pair<std::string, std::string>> names;
  for (const Scalar& one : observed) names.emplace(one.name, one.agent);
  // What a controller records and is observed as well counts as observed.
  std::erase_if(scalars, [&](const Scalar& one) { return names.contains({one.name, one.agent}); });
  scalars.insert(scalars.end(), observed.begin(), observed.end());
  return scalars;
}

std::vector<Series> series_of(RunReader& reader) {
  std::vector<Series> all;
  Statement samples = reader.query(
      "SELECT a.name, o.name, at_ns * 1e-9, value, unit FROM observable_samples s"
      " JOIN observables o USING (observable) JOIN agents a USING (agent)"
      " ORDER BY o.name, agent, observable, s.rowid");
  read_points(samples, "", all);
  Statement recorded = reader.query(
      "SELECT a.name, r.name, at_ns * 1e-9, value, '' FROM recorded r JOIN agents a USING (agent)"
      " WHERE NOT EXISTS (SELECT 1 FROM observables o WHERE o.agent = r.agent"
      " AND o.name = 'controllers.' || r.name AND keeps = 'samples')"
      " ORDER BY r.name, r.agent, r.rowid");
  read_points(recorded, "controllers.", all);
  return all;
}

std::vector<Bins> bins_of(RunReader& reader) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  Statement rows = reader.query(
      "SELECT a.name, o.name, unit, lower, upper, count FROM observable_bins b"
      " JOIN observables o USING (observable) JOIN agents a USING (agent)"
      " ORDER BY o.name, agent, observable, b.rowid");
  std::vector<Bins> all;
  while (rows.next()) {
    const std::string name = observable_name(rows.text(1));
    if (all.empty() || all.back().name != name || all.back().agent != rows.text(0)) {
      all.push_back({.name = name, .unit = rows.text(2), .agent = rows.text(0), .bins = {}});
    }
    all.back().bins.push_back({.lower = rows.is_null(3) ? -kInfinite : rows.real(3),
                               .upper = rows.is_null(4) ? kInfinite : rows.real(4),
                               .count = static_cast<std::uint64_t>(rows.integer(5))});
  }
  return all;
}

}  // namespace sim::record
