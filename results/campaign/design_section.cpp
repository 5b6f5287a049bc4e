#include "results/campaign/design_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "hal/files/config/units.h"
#include "hal/files/config/value.h"

namespace results::campaign {
namespace {

using hal::files::config::Mapping;
using hal::files::config::Option;
using hal::files::config::WrittenEntry;
using hal::files::config::WrittenValue;

constexpr std::array kScales = {Option<bool>{"linear", false}, Option<bool>{"log", true}};

/// Notes what no factor can be. @return whether it can be one.
bool check_key(Mapping& in, const std::string& key) {
  const bool is_path = !key.empty() && key.front() != '.' && key.back() != '.' &&
                       key.find("..") == std::string::npos && key.find('=') == std::string::npos;
  if (!is_path) in.mistake(key, fmt::format("'{}' is no dotted path of a key", key));
  if (key == "seed") {
    in.mistake(key,
               "is not varied: each replication has a seed of its own; see `replications`, "
               "`seeds` and `seed` of the campaign");
  }
  return is_path && key != "seed";
}

FactorValue value_of(const std::string& key, const WrittenValue& value) {
  return {key, value.text, value.yaml, value.place};
}

/// The same values without their places. By their texts, as in the table of levels: "5" in quotes
/// is 5.
std::string identity_of(const DesignPoint& point) {
  std::map<std::string, std::string> values;
  for (const FactorValue& value : point) values[value.key] = value.text;
  std::string identity;
  for (const auto& [key, text] : values) identity.append(key).append("=").append(text).append("\n");
  return identity;
}

void refuse_repeated(Mapping& in, const WrittenEntry& list) {
  std::set<std::string> seen;
  for (const WrittenValue& item : list.items) {
    if (!seen.insert(item.text).second) {
      in.mistake(list.key, fmt::format("has {} twice", item.text));
    }
  }
}

/// A list of values under each key, none of them twice.
std::vector<WrittenEntry> read_lists(Mapping& in) {
  std::vector<WrittenEntry> lists;
  for (WrittenEntry& entry : in.written_values()) {
    if (!check_key(in, entry.key)) continue;
    if (!entry.is_list || entry.items.empty()) {
      in.mistake(entry.key, fmt::format("must be a list of values, e.g. [{0}], not {1}; keys are "
                                        "dotted paths as for --set",
                                        entry.is_list ? "10 m, 20 m" : entry.value.text,
                                        entry.is_list ? "an empty one" : entry.value.text));
      continue;
    }
    refuse_repeated(in, entry);
    lists.push_back(std::move(entry));
  }
  return lists;
}

/// Every combination; the first key changes slowest.
void read_grid(Mapping in, CampaignFile& campaign) {
  campaign.design = Design::kGrid;
  const std::vector<WrittenEntry> lists = read_lists(in);
  in.finish();
  std::size_t product = 1;
  for (const WrittenEntry& list : lists) {
    product *= list.items.size();
    if (product > static_cast<std::size_t>(kMostRuns)) {
      in.mistake(list.key, fmt::format("these are more than {} points", kMostRuns));
      return;
    }
  }
  std::vector<DesignPoint> points(1);
  for (const WrittenEntry& list : lists) {
    campaign.keys.push_back(list.key);
    std::vector<DesignPoint> more;
    for (const DesignPoint& point : points) {
      for (const WrittenValue& item : list.items) {
        more.push_back(point);
        more.back().push_back(value_of(list.key, item));
      }
    }
    points = std::move(more);
  }
  campaign.points = std::move(points);
}

void read_list(std::vector<Mapping> items, CampaignFile& campaign) {
  campaign.design = Design::kList;
  std::map<std::string, std::size_t> numbers;
  for (Mapping& in : items) {
    DesignPoint point;
    for (const WrittenEntry& entry : in.written_values()) {
      if (!check_key(in, entry.key)) continue;
      point.push_back(value_of(entry.key, entry.value));
      if (std::ranges::find(campaign.keys, entry.key) == campaign.keys.end()) {
        campaign.keys.push_back(entry.key);
      }
    }
    in.finish();
    const auto [first, is_new] = numbers.emplace(identity_of(point), campaign.points.size() + 1);
    if (!is_new) in.mistake("", fmt::format("is the same as point {}", first->second));
    campaign.points.push_back(std::move(point));
  }
}

/// A limit of a range: a number with or without a unit.
std::optional<hal::files::config::WrittenNumber> read_limit(Mapping& in,
                                                            const hal::files::config::Key& key) {
  const std::string text = in.text(key);
  auto number = hal::files::config::written_number(text);
  if (!number && !text.empty()) {
    in.mistake(key.name, fmt::format("'{}' must be a number, with its unit if it has one", text));
  }
  return number;
}

void read_limits(Mapping& in, SampledRange& range) {
  const auto from = read_limit(in, {"from", "Least value, with its unit.", "0.1 m/s"});
  const auto to =
      read_limit(in, {"to", "Greatest value, with a unit of the same kind.", "0.9 m/s"});
  range.logarithmic = in.choice({"scale",
                                 "Whether equal steps are equally likely, or equal ratios: log is "
                                 "for ranges over powers of ten.",
                                 "log"},
                                kScales, false);
  range.whole = in.flag({"whole", "Whether only whole numbers are taken.", "true"}, false);
  if (range.whole && range.logarithmic) in.mistake("whole", "is not for `scale: log`");
  if (!from || !to) return;
  const hal::files::config::Unit& wanted = *hal::files::config::find_unit(from->unit);
  const hal::files::config::Unit& given = *hal::files::config::find_unit(to->unit);
  if (wanted.dimension != given.dimension) {
    in.mistake("to", fmt::format("must have a unit like that of `from`, {}", from->unit));
    return;
  }
  range.unit = from->unit;
  range.from = from->number;
  range.to = hal::files::config::converted(to->number, given, wanted);
  if (range.from >= range.to) {
    in.mistake("to", "must be greater than `from`");
  } else if (range.whole && std::ceil(range.from) > std::floor(range.to)) {
    in.mistake("whole", "there is no whole number between `from` and `to`");
  }
  if (range.logarithmic && range.from <= 0) {
    in.mistake("from", "must be greater than 0 with `scale: log`");
  }
}

SampledRange read_range(Mapping& ranges, const std::string& key) {
  SampledRange range;
  range.key = key;
  range.place = ranges.place(key);
  Mapping in = ranges.mapping({key,
                               "Range of one key of the scenario (here NAME, a dotted path), or "
                               "a list of values, each taken equally often."});
  read_limits(in, range);
  in.finish();
  return range;
}

void read_hypercube(Mapping in, CampaignFile& campaign) {
  campaign.design = Design::kLatinHypercube;
  campaign.samples = static_cast<int>(in.integer(
      {"latin_hypercube",
       "How many points: each range is cut into as many equally likely parts, and each part of "
       "each range is taken once (McKay, Beckman, Conover, 1979).",
       "50"},
      2, 100'000));
  Mapping ranges =
      in.mapping({"ranges", "What is sampled: ranges or lists, each under a key of the scenario.",
                  "{agents.robots.controller.parameters.speed: {from: 0.1 m/s, to: 0.9 m/s}}"});
  std::map<std::string, std::vector<WrittenValue>> lists;
  for (WrittenEntry& entry : ranges.written_values()) {
    if (entry.is_list) lists[entry.key] = std::move(entry.items);
  }
  for (const std::string& key : ranges.keys()) {
    if (!check_key(ranges, key)) continue;
    const auto list = lists.find(key);
    if (list == lists.end()) {
      campaign.ranges.push_back(read_range(ranges, key));
    } else if (list->second.empty()) {
      ranges.mistake(key, "must have values");
    } else {
      campaign.ranges.push_back(
          {.key = key, .place = ranges.place(key), .unit = "1", .choices = list->second});
    }
    campaign.keys.push_back(key);
  }
  if (campaign.keys.empty()) in.mistake("ranges", "must have keys");
  in.finish();
}

}  // namespace

void read_design(Mapping& in, CampaignFile& campaign) {
  const bool is_grid = in.has("vary"), is_list = in.has("points"), is_sample = in.has("sample");
  campaign.points = {DesignPoint{}};
  if (is_grid) {
    read_grid(
        in.mapping({"vary",
                    "Keys of the scenario, as dotted paths, each with a list of values: every "
                    "combination is a point.",
                    "{radio.tx_power: [2 mW, 10 mW, 50 mW]}"}),
        campaign);
  }
  if (is_list) {
    campaign.points.clear();
    read_list(
        in.mappings({"points",
                     "Points one by one, each with the keys of the scenario, as dotted paths, "
                     "that it sets.",
                     "[{radio.tx_power: 2 mW}, {radio.tx_power: 50 mW, radio.profile: disk}]"}),
        campaign);
    if (campaign.points.empty()) in.mistake("points", "must have at least one");
  }
  if (is_sample) {
    read_hypercube(in.mapping({"sample", "Points drawn at random from ranges."}), campaign);
  }
  if (static_cast<int>(is_grid) + static_cast<int>(is_list) + static_cast<int>(is_sample) > 1) {
    in.mistake(is_sample ? "sample" : "points",
               "only one of `vary`, `points` and `sample` may be there");
  }
}

}  // namespace results::campaign
