#include "results/campaign/design_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "hal/files/config/units.h"
#include "hal/files/config/value.h"
#include "hal/files/description/field_io.h"

namespace results::campaign {
namespace {

using hal::files::config::Form;
using hal::files::config::Key;
using hal::files::config::Mapping;
using hal::files::config::Option;
using hal::files::config::WrittenEntry;
using hal::files::config::WrittenValue;
using hal::files::description::FieldReader;
using hal::files::description::Fields;

constexpr std::array kScales = {Option<bool>{"linear", false}, Option<bool>{"log", true}};

/// Notes a mistake if the key cannot be varied. @return whether it can.
bool check_key(Mapping& in, const std::string& key) {
  const bool is_path = !key.empty() && key.front() != '.' && key.back() != '.' &&
                       key.find("..") == std::string::npos && key.find('=') == std::string::npos;
  if (!is_path) in.mistake(key, fmt::format("'{}' is not the dotted path of a key", key));
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

/// The values of a point without their places in the file, for comparison. Values are compared as
/// text, as in the table of levels, so a quoted "5" equals 5.
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

/// Reads a list of values under each key; no value may occur twice.
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

/// All combinations of the values; the first key changes slowest.
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

using hal::files::config::WrittenNumber;

/// Reads a limit of a range: a number with or without a unit. None after a mistake.
std::optional<WrittenNumber> limit_key(Fields& io, const Key& key) {
  std::string text;
  io.needed_text(key, text);
  auto number = hal::files::config::written_number(text);
  if (!number && !text.empty()) {
    io.mistake(key.name, fmt::format("'{}' must be a number, with its unit if it has one", text));
  }
  return number;
}

/// @param from, to  limits of the range.
void check_limits(Fields& io, const WrittenNumber& from, const WrittenNumber& to,
                  SampledRange& range) {
  const hal::files::config::Unit& wanted = *hal::files::config::find_unit(from.unit);
  const hal::files::config::Unit& given = *hal::files::config::find_unit(to.unit);
  if (wanted.dimension != given.dimension) {
    io.mistake("to", fmt::format("must have a unit like that of `from`, {}", from.unit));
    return;
  }
  range.unit = from.unit;
  range.from = from.number;
  range.to = hal::files::config::converted(to.number, given, wanted);
  if (range.from >= range.to) {
    io.mistake("to", "must be greater than `from`");
  } else if (range.whole && std::ceil(range.from) > std::floor(range.to)) {
    io.mistake("whole", "there is no whole number between `from` and `to`");
  }
  if (range.logarithmic && range.from <= 0)
    io.mistake("from", "must be greater than 0 with `scale: log`");
}

void keys_of(Fields& io, SampledRange& range) {
  const auto from = limit_key(io, {"from", "Lower bound, with its unit.", "0.1 m/s"});
  const auto to =
      limit_key(io, {"to", "Upper bound, with a unit of the same dimension.", "0.9 m/s"});
  io.choice({"scale",
             "Distribution of the values. linear: uniform; log: uniform in the logarithm, for "
             "ranges over several powers of ten.",
             "log"},
            kScales, range.logarithmic);
  io.flag({"whole", "Whether only integers are taken.", "true"}, range.whole);
  if (range.whole && range.logarithmic) io.mistake("whole", "is not for `scale: log`");
  if (from && to) check_limits(io, *from, *to, range);
}

const Key kRange{"NAME",
                 "Range of one key of the scenario (here NAME, a dotted path), or a list of values "
                 "that are taken equally often."};

/// Reads the ranges and the lists of choices.
void read_ranges(Mapping& ranges, CampaignFile& campaign) {
  std::map<std::string, std::vector<WrittenValue>> lists;
  for (WrittenEntry& entry : ranges.written_values()) {
    if (entry.is_list) lists[entry.key] = std::move(entry.items);
  }
  for (const std::string& key : ranges.keys()) {
    if (!check_key(ranges, key)) continue;
    const auto list = lists.find(key);
    SampledRange range{.key = key, .place = ranges.place(key), .unit = "1"};
    if (list == lists.end()) {
      FieldReader(ranges).inside({key, kRange.meaning}, [&](Fields& io) { keys_of(io, range); });
    } else if (list->second.empty()) {
      ranges.mistake(key, "must have values");
    } else {
      range.choices = list->second;
    }
    if (list == lists.end() || !list->second.empty()) campaign.ranges.push_back(std::move(range));
    campaign.keys.push_back(key);
  }
}

void sample_keys(Fields& io, CampaignFile& campaign) {
  if (io.reading() != nullptr) campaign.design = Design::kLatinHypercube;
  io.needed_count(
      {"latin_hypercube",
       "Number of points of the Latin hypercube: each range is divided into this many equally "
       "likely parts, and each part is used exactly once (McKay, Beckman, Conover, 1979).",
       "50"},
      2, 100'000, campaign.samples);
  io.inside({"ranges", "Ranges to sample, each under a key of the scenario (a dotted path).",
             "{agents.robots.controller.parameters.speed: {from: 0.1 m/s, to: 0.9 m/s}}"},
            [&](Fields& ranges) {
              if (ranges.reading() != nullptr) return read_ranges(*ranges.reading(), campaign);
              ranges.named(kRange, {}, [](Fields& range, const std::string& /*key*/) {
                SampledRange any;
                keys_of(range, any);
              });
            });
  if (campaign.keys.empty()) io.mistake("ranges", "must have keys");
}

/// A key that is read if present and never written. @return whether it is present.
bool read_if_there(Fields& io, const Key& key, Form::Kind form,
                   const std::function<void(Mapping&)>& read) {
  bool is_there = false;
  io.own(
      key, {.kind = form},
      [&](Mapping& in) {
        is_there = in.has(key.name);
        if (is_there) read(in);
      },
      [](hal::files::config::Writer& /*out*/) {});
  return is_there;
}

}  // namespace

void design_keys(Fields& io, CampaignFile& campaign) {
  campaign.points = {DesignPoint{}};
  const Key vary{"vary",
                 "Keys of the scenario, as dotted paths, each with a list of values; every "
                 "combination of values is a point.",
                 "{radio.tx_power: [2 mW, 10 mW, 50 mW]}"};
  const bool is_grid = read_if_there(io, vary, Form::Kind::kMapping,
                                     [&](Mapping& in) { read_grid(in.mapping(vary), campaign); });
  const Key points{"points",
                   "List of points; each sets keys of the scenario, given as dotted paths.",
                   "[{radio.tx_power: 2 mW}, {radio.tx_power: 50 mW, radio.profile: disk}]"};
  const bool is_list = read_if_there(io, points, Form::Kind::kMappings, [&](Mapping& in) {
    campaign.points.clear();
    read_list(in.mappings(points), campaign);
    if (campaign.points.empty()) in.mistake(points.name, "must have at least one");
  });
  const bool is_sample = io.inside_given({"sample", "Points drawn at random from ranges."}, false,
                                         [&](Fields& sample) { sample_keys(sample, campaign); });
  if (static_cast<int>(is_grid) + static_cast<int>(is_list) + static_cast<int>(is_sample) > 1) {
    io.mistake(is_sample ? "sample" : "points",
               "only one of `vary`, `points` and `sample` may be there");
  }
}

}  // namespace results::campaign
