#include "results/campaign/extension.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "hal/files/config/errors.h"
#include "results/campaign/factors.h"
#include "results/campaign/schema.h"

namespace results::campaign {
namespace {

/// Keys of the table `campaign` whose values must be the same for all runs.
constexpr std::string_view kFixed[] = {"version", "design",  "base_seed", "seeds",
                                       "until",   "sampled", "pace"};

[[noreturn]] void refuse(const CampaignReader& reader, const std::string& why) {
  throw hal::files::config::ConfigErrors(
      {fmt::format("{}: holds another campaign: {}; only more replications and more points are "
                   "added to it: give another --out, or remove the folder",
                   reader.folder().string(), why)});
}

std::string value_of(const WantedRuns& wanted, std::string_view key) {
  const auto found = std::ranges::find(
      wanted.values, key, [](const auto& pair) { return std::string_view(pair.first); });
  return found == wanted.values.end() ? "" : found->second;
}

/// A value of the table `campaign`. Without a pace, which `--replications` and earlier versions do
/// not write, the runs are in lock-step.
std::string in_words(std::string_view key, const std::string& value) {
  return key == "pace" && value.empty() ? std::string(kLockstep) : value;
}

/// Runs with different versions of a controller are not samples of the same population. As long as
/// no run is done, the programs may change.
void require_same_programs(const WantedRuns& wanted, CampaignReader& reader) {
  const std::string before = reader.value("programs"), now = value_of(wanted, "programs");
  if (before.empty() || before == now) return;  // empty: written by an earlier version of baraka
  const auto is_done = [](const RunRow& row) { return row.state == RunState::kDone; };
  if (std::ranges::none_of(reader.runs(), is_done)) return;
  refuse(reader, fmt::format("its runs were played by other files: programs: there '{}', now '{}'",
                             before, now));
}

std::int64_t replications_in(const std::string& text, const CampaignReader& reader) {
  std::int64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc{} && rest == end) return number;
  throw std::runtime_error(
      fmt::format("{}: table campaign, row replications: value is '{}', not a whole number",
                  (reader.folder() / kCampaignDatabase).string(), text));
}

void require_same_values(const WantedRuns& wanted, CampaignReader& reader) {
  for (const std::string_view key : kFixed) {
    const std::string before = in_words(key, reader.value(key));
    const std::string now = in_words(key, value_of(wanted, key));
    if (before != now) refuse(reader, fmt::format("{}: there '{}', now '{}'", key, before, now));
  }
  require_same_programs(wanted, reader);
  const std::string replications = reader.value("replications");
  if (!wanted.may_be_fewer && replications_in(replications, reader) > wanted.replications) {
    refuse(reader,
           fmt::format("replications: there {}, now {}", replications, wanted.replications));
  }
  const std::vector<Factor> factors = reader.factors();
  const auto same = [](const Factor& a, const Factor& b) {
    return a.key == b.key && a.unit == b.unit;
  };
  if (std::ranges::equal(factors, wanted.factors, same)) return;
  const auto list = [](const std::vector<Factor>& all) {
    std::string text;
    for (const Factor& factor : all) {
      text += fmt::format("{}{} [{}]", text.empty() ? "" : ", ", factor.key, factor.unit);
    }
    return text.empty() ? std::string("nothing") : text;
  };
  refuse(reader, fmt::format("there {} is varied, now {}", list(factors), list(wanted.factors)));
}

using Texts = std::vector<std::string>;

/// The levels as the campaign file sets them; "" for defaults.
Texts texts_of(const PointRow& point) {
  Texts texts;
  for (const Level& level : point.levels) texts.push_back(level.is_default ? "" : level.text);
  return texts;
}

/// Refuses if a point in the database is not wanted any more or has another scenario. @return the
/// numbers of the points in the database.
/// @param rewritten  receives the points whose text has changed only where no run depends on it.
std::map<Texts, int> require_same_points(const WantedRuns& wanted, CampaignReader& reader,
                                         std::vector<PointRow>& rewritten) {
  std::map<Texts, const PointRow*> by_texts;
  for (const PointRow& point : wanted.points) by_texts[texts_of(point)] = &point;
  std::map<Texts, int> numbers;
  for (const PointRow& before : reader.points()) {
    const Texts texts = texts_of(before);
    numbers[texts] = before.point;
    const auto now = by_texts.find(texts);
    if (now == by_texts.end()) {
      refuse(reader, fmt::format("point {} there, {}, is asked for no more", before.point,
                                 before.label.empty() ? "of one scenario" : before.label));
    }
    if (now->second->scenario == before.scenario) continue;
    const std::string old_essence = wanted.essence(before.scenario);
    const std::string new_essence = wanted.essence(now->second->scenario);
    if (old_essence != new_essence) {
      refuse(reader, fmt::format("another scenario{}: {}",
                                 before.label.empty() ? "" : fmt::format(" ({})", before.label),
                                 first_difference(old_essence, new_essence)));
    }
    rewritten.push_back(before);
    rewritten.back().scenario = now->second->scenario;
  }
  return numbers;
}

/// Points in the database keep their numbers, new ones get the next numbers.
std::vector<PointRow> numbered(std::vector<PointRow> points, const std::map<Texts, int>& numbers) {
  int last = static_cast<int>(numbers.size());
  for (PointRow& point : points) {
    const auto known = numbers.find(texts_of(point));
    point.point = known != numbers.end() ? known->second : ++last;
  }
  return points;
}

/// Adds the runs of the plan's points that the database lacks.
void add_runs(const WantedRuns& wanted, CampaignReader& reader, CampaignDatabase::Plan& plan) {
  std::set<std::pair<int, int>> there;
  std::int64_t last = 0;
  for (const RunRow& row : reader.runs()) {
    there.emplace(row.plan.point, row.plan.replication);
    last = std::max(last, row.plan.run);
  }
  for (const PointRow& point : plan.points) {
    for (int k = 1; k <= wanted.replications; ++k) {
      if (there.contains({point.point, k})) continue;
      plan.runs.push_back(
          {++last, point.point, k, seed_of(wanted.seeds, wanted.base_seed, point, k)});
    }
  }
}

std::string many(std::size_t count, std::string_view one) {
  return fmt::format("{} more {}{}", count, one, count == 1 ? "" : "s");
}

}  // namespace

std::string first_difference(const std::string& old_text, const std::string& new_text) {
  std::istringstream old_lines(old_text), new_lines(new_text);
  std::string before, after;
  do {
    if (!std::getline(old_lines, before)) before.clear();
    if (!std::getline(new_lines, after)) after.clear();
  } while (before == after && (old_lines || new_lines));
  return fmt::format("there '{}', now '{}'", before, after);
}

Extension extension(const WantedRuns& wanted, CampaignReader& reader) {
  const bool is_new = reader.count_rows().at("campaign") == 0;
  Extension result;
  result.plan.values = wanted.values;
  std::map<Texts, int> numbers;
  if (is_new) {
    result.plan.factors = wanted.factors;
  } else {
    require_same_values(wanted, reader);
    numbers = require_same_points(wanted, reader, result.plan.rewritten);
  }
  result.plan.points = numbered(wanted.points, numbers);
  add_runs(wanted, reader, result.plan);
  std::erase_if(result.plan.points,
                [&](const PointRow& point) { return numbers.contains(texts_of(point)); });
  if (is_new || result.plan.runs.empty()) return result;
  if (!result.plan.points.empty()) result.said = many(result.plan.points.size(), "point") + ", ";
  result.said += many(result.plan.runs.size(), "run");
  return result;
}

}  // namespace results::campaign
