#include "sim/record/scalars.h"

#include <algorithm>
#include <cmath>

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
  return scalars;
}

std::vector<Series> series_of(RunReader& reader) {
  Statement rows = reader.query(
      "SELECT a.name, r.name, at_ns * 1e-9, value FROM recorded r JOIN agents a USING (agent)"
      " ORDER BY r.name, r.agent, r.rowid");
  std::vector<Series> all;
  while (rows.next()) {
    const std::string name = "controllers." + name_part(rows.text(1));
    if (all.empty() || all.back().name != name || all.back().agent != rows.text(0)) {
      all.push_back({.name = name, .unit = "", .agent = rows.text(0), .points = {}});
    }
    all.back().points.emplace_back(rows.real(2), rows.real(3));
  }
  return all;
}

std::vector<Bins> bins_of(RunReader&) { return {}; }

}  // namespace sim::record
