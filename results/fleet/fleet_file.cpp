#include "results/fleet/fleet_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <utility>

#include "hal/files/config/document.h"
#include "hal/files/config/errors.h"
#include "hal/files/config/paths_beside.h"
#include "hal/files/config/shared_folders.h"
#include "hal/files/description/field_io.h"
#include "hal/files/description/names.h"

namespace results::fleet {
namespace {

namespace fs = std::filesystem;

using campaign::FactorValue;
using hal::files::config::Form;
using hal::files::config::Key;
using hal::files::config::Mapping;
using hal::files::config::with_paths_beside;
using hal::files::config::WrittenEntry;
using hal::files::description::FieldReader;
using hal::files::description::Fields;

constexpr int kMostRobots = 1000;
constexpr double kLongest = 1e6;  // s

/// Folder of the file in "file:line:column".
fs::path folder_of(const std::string& place) {
  const std::size_t line = place.rfind(':', place.rfind(':') - 1);
  return fs::path(place.substr(0, line)).parent_path();
}

std::vector<FactorValue> values_in(Mapping& in) {
  std::vector<FactorValue> values;
  for (const WrittenEntry& entry : in.written_values()) {
    if (entry.key == "seed") {
      in.mistake(entry.key, "each replication has a seed of its own; see `seed` of the fleet");
      continue;
    }
    const std::string& place = entry.value.place;
    values.push_back({entry.key, entry.value.text,
                      with_paths_beside(entry.key, entry.value.yaml, folder_of(place)), place});
  }
  return values;
}

/// A key that is read if present, and never written.
void read_if_there(Fields& io, const Key& key, Form::Kind form,
                   const std::function<void(Mapping&)>& read) {
  io.own(
      key, {.kind = form},
      [&](Mapping& in) {
        if (in.has(key.name)) read(in);
      },
      [](hal::files::config::Writer& /*out*/) {});
}

void set_key(Fields& io, FleetFile& fleet) {
  const Key key{
      "set",
      "Keys of the scenario, as dotted paths, that are set in every run. Paths of files are "
      "relative to this file, here and in `radios`, `sites` and `profiles`.",
      "{agents.robots.topics: [{from: lab.mcap, readers: [base]}]}"};
  read_if_there(io, key, Form::Kind::kMapping, [&](Mapping& in) {
    Mapping inner = in.mapping(key);
    fleet.set = values_in(inner);
    inner.finish();
  });
}

/// Radios or sites: names, each with keys of the scenario.
void variants_key(Fields& io, const Key& key, std::vector<Variant>& variants) {
  read_if_there(io, key, Form::Kind::kMapping, [&](Mapping& in) {
    Mapping named = in.mapping(key);
    for (const std::string& name : named.keys()) {
      Mapping one = named.mapping({name, "Keys of the scenario.", "{radio.mcs: 4}"});
      variants.push_back({.name = name, .values = values_in(one), .xml = {}, .vendor = {}});
      one.finish();
    }
    if (named.keys().empty()) in.mistake(key.name, "must have at least one");
    named.finish();
  });
  if (variants.empty()) variants.emplace_back();
}

/// A profile's file: beside the fleet file, otherwise one of those that come with BARAKA.
fs::path found_profile(Mapping& in, const std::string& file) {
  const fs::path beside = folder_of(in.place("file")) / file;
  if (fs::is_regular_file(beside)) return fs::absolute(beside).lexically_normal();
  try {
    return fs::absolute(hal::files::config::named_file(file, {"dds"}));
  } catch (const hal::files::config::ConfigErrors& e) {
    in.mistake("file", e.messages().front());
    return {};
  }
}

/// Whether a file may be one of that vendor: it has the root element of its XML.
bool is_of(const fs::path& file, const std::string& vendor) {
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const bool is_cyclone = text.find("<CycloneDDS") != std::string::npos;
  return is_cyclone == (vendor == "cyclonedds");
}

void profile_keys(Fields& io, Variant& profile) {
  io.given_text(
      {"vendor", "DDS of the players of `topics`, cyclonedds or fastdds; default: the scenario's.",
       "cyclonedds"},
      profile.vendor);
  if (!profile.vendor.empty() && profile.vendor != "cyclonedds" && profile.vendor != "fastdds") {
    io.mistake("vendor", fmt::format("'{}' is not one of cyclonedds, fastdds", profile.vendor));
  }
  std::string file;
  io.given_text({"file",
                 "XML of that DDS: a path relative to this file, or one of those that come with "
                 "BARAKA.",
                 "cyclone_one_frame.xml"},
                file);
  if (!file.empty() && io.reading() != nullptr) profile.xml = found_profile(*io.reading(), file);
  if (profile.xml && !profile.xml->empty() && !profile.vendor.empty() &&
      !is_of(*profile.xml, profile.vendor)) {
    io.mistake("file", fmt::format("{} is not XML of {}", profile.xml->string(), profile.vendor));
  }
  const Key set{"set", "Further keys of the scenario, as dotted paths.",
                "{agents.server.present: true}"};
  read_if_there(io, set, Form::Kind::kMapping, [&](Mapping& in) {
    Mapping inner = in.mapping(set);
    profile.values = values_in(inner);
    inner.finish();
  });
}

void profiles_key(Fields& io, FleetFile& fleet) {
  const Key key{"profiles",
                "Profiles of DDS to compare, by name; default: that of the scenario alone."};
  const Key each{"NAME", "One profile: which DDS, with which XML."};
  io.inside_given(key, false, [&](Fields& named) {
    if (named.reading() == nullptr) {
      return named.named(each, {}, [](Fields& one, const std::string& /*name*/) {
        Variant any;
        profile_keys(one, any);
      });
    }
    Mapping& in = *named.reading();
    for (const std::string& name : in.keys()) {
      Variant profile{.name = name, .values = {}, .xml = {}, .vendor = {}};
      profile.place = in.place(name);
      FieldReader(in).inside({name, each.meaning},
                             [&](Fields& one) { profile_keys(one, profile); });
      fleet.profiles.push_back(std::move(profile));
    }
  });
  if (fleet.profiles.empty()) fleet.profiles.emplace_back();
}

void need_keys(Fields& io, Need& need) {
  if (io.reading() != nullptr) need.place = io.reading()->place();
  io.text({"topic", "Topics: a name, or a pattern with * and ?.", "'*/scan'"}, need.topic);
  io.text({"readers", "Reading agents: a name, or a pattern with * and ?.", "base"}, need.readers);
  io.given({"delivered", "Least share of the samples that must arrive.", "99 %"}, "1", {0, 1},
           need.delivered);
  io.given({"p50", "Longest median of the latency.", "10 ms"}, {0, kLongest}, need.p50);
  io.given({"p95", "Longest 95 % quantile of the latency.", "50 ms"}, {0, kLongest}, need.p95);
  io.given({"p99", "Longest 99 % quantile of the latency.", "200 ms"}, {0, kLongest}, need.p99);
  io.given({"age",
            "Longest age of the newest sample that a reader has, in 95 % of the time; before the "
            "first one the age is the time since the start of the run.",
            "500 ms"},
           {0, kLongest}, need.age);
  io.given(
      {"discovered",
       "Time since the start of the run by which every reader must have its first sample.", "10 s"},
      {0, kLongest}, need.discovered);
  if (io.reading() != nullptr && !need.delivered && !need.p50 && !need.p95 && !need.p99 &&
      !need.age && !need.discovered) {
    io.mistake("topic", "needs a limit: delivered, p50, p95, p99, age or discovered");
  }
}

/// [2, 4, 8], or {from: 2, to: 12, step: 2}.
struct Numbers {
  int from = 1, to = 1, step = 1;
};

void range_keys(Fields& io, Numbers& numbers) {
  io.needed_count({"from", "Least number of robots.", "2"}, 1, kMostRobots, numbers.from);
  io.needed_count({"to", "Greatest number of robots.", "12"}, 1, kMostRobots, numbers.to);
  io.count({"step", "Difference from one number to the next; `to` is tried in any case.", "2"}, 1,
           kMostRobots, numbers.step);
  if (numbers.from > numbers.to) io.mistake("to", "must not be less than `from`");
}

void robots_key(Fields& io, FleetFile& fleet) {
  io.inside({"robots", "The group of agents whose number varies, and the numbers."},
            [&](Fields& in) {
              in.needed_text({"group",
                              "Name of a group of the scenario, placed by `circle`, "
                              "`line` or `uniform`.",
                              "robots"},
                             fleet.group);
              Numbers numbers;
              range_keys(in, numbers);
              for (int n = numbers.from; n < numbers.to; n += numbers.step) {
                fleet.robots.push_back(n);
              }
              fleet.robots.push_back(numbers.to);
            });
}

void run_keys(Fields& io, FleetFile& fleet) {
  io.duration({"warm_up", "Samples sent earlier than this are not counted: discovery.", "10 s"},
              {0, kLongest}, fleet.warm_up);
  io.duration(
      {"until", "Simulated time at which each run ends, unless its scenario ends it earlier.",
       "60 s"},
      {0.001, kLongest}, fleet.until);
  if (fleet.warm_up >= fleet.until) io.mistake("until", "must be later than `warm_up`");
  io.count({"replications", "Runs of each case, each with another seed.", "5"}, 1, 10'000,
           fleet.replications);
  io.given_count({"seed", "Seed of the first replication.", "1", "the scenario's"}, 0,
                 std::numeric_limits<std::int64_t>::max() - 10'000, fleet.seed);
  io.given_count(
      {"jobs", "Number of simultaneous runs on this computer.", "2", "one for each processor"}, 1,
      1000, fleet.jobs);
  campaign::slurm_key(io, fleet.slurm);
}

}  // namespace

void keys_of(Fields& io, FleetFile& fleet) {
  hal::files::description::needed_version_key(io);
  io.text({"name", "Name of the fleet and of its results folder: letters, digits, '_' and '-'.",
           "warehouse", "the file's name without its ending"},
          fleet.name);
  hal::files::description::check_folder_name(io, fleet.name);
  io.needed_text({"scenario",
                  "Scenario with the robots: a file whose path is relative to this one, or one "
                  "that comes with BARAKA.",
                  "fleet_on_an_access_point"},
                 fleet.scenario);
  if (io.reading() != nullptr) fleet.scenario_place = io.reading()->place("scenario");
  robots_key(io, fleet);
  set_key(io, fleet);
  variants_key(io,
               {"radios", "Radios to compare, by name: keys of the scenario, as dotted paths.",
                "{g: {radio.include: radios/ieee80211g.yaml}}"},
               fleet.radios);
  variants_key(io,
               {"sites", "Sites to compare, by name: keys of the scenario, as dotted paths.",
                "{hall: {}, racks: {'radio.propagation': [{model: log_distance, exponent: 3.5}]}}"},
               fleet.sites);
  profiles_key(io, fleet);
  io.list<Need>({"need", "What must hold."}, fleet.needs,
                [](Fields& item, Need& need) { need_keys(item, need); });
  if (fleet.needs.empty() && io.reading() != nullptr) {
    io.mistake("need", "must have at least one item");
  }
  run_keys(io, fleet);
}

FleetFile load_fleet(const fs::path& file, const std::vector<std::string>& overrides) {
  auto document = hal::files::config::Document::load(file, overrides);
  FleetFile fleet;
  fleet.name = file.stem().string();
  Mapping in = document.root();
  FieldReader io(in);
  keys_of(io, fleet);
  in.finish();
  document.finish();
  return fleet;
}

}  // namespace results::fleet
