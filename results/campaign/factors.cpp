#include "results/campaign/factors.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "hal/files/config/units.h"
#include "hal/files/config/value.h"
#include "hal/types/random.h"

namespace results::campaign {
namespace {

using hal::files::config::WrittenNumber;

/// The unit that all these numbers share; "": there is none.
std::string common_unit(const std::vector<std::optional<WrittenNumber>>& numbers) {
  std::set<std::string> units;
  std::set<std::string_view> dimensions;
  for (const auto& number : numbers) {
    if (!number) continue;
    units.insert(number->unit);
    dimensions.insert(hal::files::config::base_unit(number->unit));
  }
  if (dimensions.size() != 1) return "";
  return *units.begin() == "dBm" && units.size() == 1 ? "dBm" : std::string(*dimensions.begin());
}

/// Gives a factor its unit, and its levels their numbers.
void add_numbers(Factor& factor, std::size_t index, std::vector<PointRow>& points) {
  std::vector<std::optional<WrittenNumber>> numbers;
  numbers.reserve(points.size());
  for (const PointRow& point : points) {
    numbers.push_back(hal::files::config::written_number(point.levels[index].text));
  }
  const std::string unit = common_unit(numbers);
  if (unit.empty()) return;
  factor.unit = unit == "1" ? "" : unit;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!numbers[i]) continue;
    points[i].levels[index].number = hal::files::config::converted(
        numbers[i]->number, *hal::files::config::find_unit(numbers[i]->unit),
        *hal::files::config::find_unit(unit));
  }
}

/// The last part of each key, or the whole key where several keys end with the same part.
std::vector<std::string> short_names(const std::vector<std::string>& keys) {
  const auto last = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
  std::map<std::string, int> count;
  for (const std::string& key : keys) ++count[last(key)];
  std::vector<std::string> names;
  names.reserve(keys.size());
  for (const std::string& key : keys) names.push_back(count[last(key)] > 1 ? key : last(key));
  return names;
}

std::string label_of(const std::vector<Level>& levels, const std::vector<std::string>& names) {
  std::string label;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (levels[i].is_default && levels[i].text.empty()) continue;
    label += fmt::format("{}{}={}", label.empty() ? "" : ", ", names[i], levels[i].text);
  }
  return label;
}

PointRow row_of(const DesignPoint& point, const std::vector<std::string>& keys,
                const std::vector<std::string>& names) {
  PointRow row;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto value = std::ranges::find(point, keys[i], &FactorValue::key);
    const bool is_set = value != point.end();
    row.levels.push_back({is_set ? value->text : "", std::nullopt, !is_set});
  }
  row.label = label_of(row.levels, names);
  return row;
}

}  // namespace

FactorTable factor_table(const std::vector<std::string>& keys,
                         const std::vector<DesignPoint>& points) {
  FactorTable table;
  const std::vector<std::string> names = short_names(keys);
  for (const DesignPoint& point : points) {
    table.points.push_back(row_of(point, keys, names));
    table.points.back().point = static_cast<int>(table.points.size());
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    add_numbers(table.factors.emplace_back(Factor{keys[i], ""}), i, table.points);
  }
  return table;
}

void set_defaults(FactorTable& table, const std::vector<std::vector<std::string>>& defaults) {
  std::vector<std::string> keys;
  for (const Factor& factor : table.factors) keys.push_back(factor.key);
  const std::vector<std::string> names = short_names(keys);
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    PointRow& point = table.points[i];
    for (std::size_t k = 0; k < point.levels.size(); ++k) {
      point.levels[k].number.reset();
      if (point.levels[k].is_default) point.levels[k].text = defaults[i][k];
    }
    point.label = label_of(point.levels, names);
  }
  for (std::size_t k = 0; k < keys.size(); ++k) {
    table.factors[k].unit.clear();
    add_numbers(table.factors[k], k, table.points);
  }
}

std::uint64_t seed_of(Seeds seeds, std::uint64_t base, const PointRow& point, int replication) {
  if (seeds == Seeds::kCommon) return base + static_cast<std::uint64_t>(replication) - 1;
  std::string name = "campaign/seed";
  for (const Level& level : point.levels) name += "/" + (level.is_default ? "" : level.text);
  hal::RandomStream stream(base, fmt::format("{}/{}", name, replication));
  return stream.next() & static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
}

}  // namespace results::campaign
