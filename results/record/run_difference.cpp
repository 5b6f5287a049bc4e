#include "results/record/run_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "results/record/row_difference.h"
#include "results/record/row_words.h"

namespace results::record {
namespace {

using Key = RunDifference::Key;
using Happening = RunDifference::Happening;

constexpr std::array<std::string_view, 4> kCauses{"scenario", "seed", "version", "pace"};
constexpr std::array<std::string_view, 4> kOutcomes{"result", "ended_ns", "fingerprint",
                                                    "frames_digest"};
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

/// Two runs under comparison.
struct ComparedRuns {
  RunReader& one;
  RunReader& other;
};

template <class Names>
std::vector<Key> keys(const ComparedRuns& runs, const Names& names) {
  std::vector<Key> found;
  found.reserve(names.size());
  for (const std::string_view name : names)
    found.push_back({std::string(name), runs.one.value(name), runs.other.value(name)});
  return found;
}

std::map<std::string, std::string> settings_of(RunReader& run) {
  std::map<std::string, std::string> settings;
  Statement rows = run.query("SELECT key, value FROM settings");
  while (rows.next()) settings[rows.text(0)] = rows.text(1);
  return settings;
}

std::vector<Key> different_settings(const std::map<std::string, std::string>& one,
                                    const std::map<std::string, std::string>& other) {
  const auto value = [](const auto& settings, const std::string& key) {
    const auto found = settings.find(key);
    return found == settings.end() ? std::string() : found->second;
  };
  std::set<std::string> names;
  for (const auto* settings : {&one, &other}) {
    for (const auto& [key, text] : *settings) names.insert(key);
  }
  std::vector<Key> different;
  for (const std::string& name : names) {
    Key key{name, value(one, name), value(other, name)};
    if (!key.is_equal()) different.push_back(std::move(key));
  }
  return different;
}

/// The rows of the table fingerprints of one run, in the order of their key.
class Hashes {
 public:
  using Place = std::tuple<std::int64_t, std::string, std::int64_t>;  ///< Second, part, agent.

  Hashes(RunReader& run, std::string_view condition)
      : rows_(run.query(fmt::format("SELECT second, part, agent, hash FROM fingerprints {} ORDER "
                                    "BY second, part, agent",
                                    condition))) {
    next();
  }

  void next() {
    place_.reset();
    if (!rows_.next()) return;
    place_.emplace(rows_.integer(0), rows_.text(1), rows_.integer(2));
    hash_.reset();
    if (!rows_.is_null(3)) hash_ = rows_.integer(3);
  }

  const std::optional<Place>& place() const { return place_; }
  const std::optional<std::int64_t>& hash() const { return hash_; }

 private:
  Statement rows_;
  std::optional<Place> place_;  ///< nullopt: after the last row.
  std::optional<std::int64_t> hash_;
};

/// @param condition  "WHERE part = 'air'", or "".
std::optional<Hashes::Place> first_different_hash(const ComparedRuns& runs,
                                                  std::string_view condition) {
  Hashes one(runs.one, condition), other(runs.other, condition);
  for (; one.place() && one.place() == other.place(); one.next(), other.next()) {
    if (one.hash() != other.hash()) return one.place();
  }
  if (!one.place() || !other.place()) return one.place() ? one.place() : other.place();
  return std::min(one.place(), other.place());
}

std::string both(const std::string& first, const std::string& second) {
  if (first.empty() || first == second) return second;
  return second.empty() ? first : fmt::format("{} | {}", first, second);
}

/// "0.123456789 s: m3 to r0, ack: sequence 17, 112 bit"
std::string line(RowWords& words, const Row& row) {
  const std::int64_t at = row.integer("at_ns");
  return fmt::format("{}.{:09} s: {}, {}: {}", at / kNanosecondsPerSecond,
                     at % kNanosecondsPerSecond, words.stations(row), words.protocol(row),
                     words.contents(row));
}

Happening happening_of(const RowDifference& rows, RowWords& one, RowWords& other) {
  Happening found;
  const Row& some = rows.first ? *rows.first : *rows.second;
  found.table = some.table->name;
  found.at_ns = some.integer("at_ns");
  std::array<std::string, 2> stations, protocols;
  if (rows.first) {
    found.first = line(one, *rows.first);
    stations[0] = one.stations(*rows.first);
    protocols[0] = one.protocol(*rows.first);
  }
  if (rows.second) {
    found.at_ns = std::min(found.at_ns, rows.second->integer("at_ns"));
    found.second = line(other, *rows.second);
    stations[1] = other.stations(*rows.second);
    protocols[1] = other.protocol(*rows.second);
  }
  found.stations = both(stations[0], stations[1]);
  found.protocol = both(protocols[0], protocols[1]);
  if (rows.first && rows.second)
    found.what = differing_values(one, *rows.first, other, *rows.second);
  if (rows.before) found.before = line(one, *rows.before);
  return found;
}

/// The earliest row that differs. Of one instant, what came from programs is before the frames that
/// it causes, and these are before their ends.
std::optional<Happening> first_happening(const ComparedRuns& runs, bool with_frames) {
  RowWords one(runs.one), other(runs.other);
  std::optional<Happening> earliest;
  for (const std::string_view table : {"arrivals", "frames", "frame_ends"}) {
    if (!with_frames && table != "arrivals") continue;
    const auto rows = first_different_row(runs.one, runs.other, table);
    if (!rows) continue;
    Happening found = happening_of(*rows, one, other);
    if (!earliest || found.at_ns < earliest->at_ns) earliest = std::move(found);
  }
  return earliest;
}

/// How much of its frames a run lists: "none", "counts", "sample", "all".
std::string listing(const std::map<std::string, std::string>& settings) {
  const auto found = settings.find("record.frames");
  return found == settings.end() ? "all" : found->second;
}

bool is_listed(std::string_view listing) { return listing == "sample" || listing == "all"; }

const Key& key_called(const std::vector<Key>& keys, std::string_view name) {
  return *std::ranges::find(keys, name, &Key::name);
}

/// What the listed frames do not show.
void add_notes(RunDifference& difference, const ComparedRuns& runs,
               const std::pair<std::string, std::string>& listings) {
  constexpr const char* kListAll = "--set record.frames=all lists every frame";
  const Key& digest = key_called(difference.outcomes, "frames_digest");
  if (digest.is_known() && digest.is_equal()) return;
  const auto& [one, other] = listings;
  if (one != other || !is_listed(one)) {
    difference.notes.push_back(fmt::format("frames were not compared: record.frames is {}; {}",
                                           one == other ? one : fmt::format("{} | {}", one, other),
                                           kListAll));
    return;
  }
  const auto air = first_different_hash(runs, "WHERE part = 'air'");
  if (!air) return;
  const std::int64_t second = std::get<0>(*air);
  if (difference.happening && difference.happening->at_ns / kNanosecondsPerSecond <= second) return;
  if (one == "sample") {
    difference.notes.push_back(
        fmt::format("what differs first on the air, in second {}, is not among the frames listed: "
                    "record.frames is sample; {}",
                    second, kListAll));
  } else {
    difference.notes.push_back(fmt::format(
        "what differs first on the air, in second {}, is nothing that the tables list", second));
  }
}

}  // namespace

bool RunDifference::is_equal() const {
  const auto differs = [](const Key& key) { return key.is_known() && !key.is_equal(); };
  return !hash && !happening && std::ranges::none_of(outcomes, differs);
}

RunDifference compare_runs(RunReader& one, RunReader& other) {
  const ComparedRuns runs{one, other};
  const auto settings = std::pair{settings_of(one), settings_of(other)};
  RunDifference difference;
  difference.causes = keys(runs, kCauses);
  difference.settings = different_settings(settings.first, settings.second);
  difference.outcomes = keys(runs, kOutcomes);
  if (const auto place = first_different_hash(runs, "")) {
    const auto& [second, part, agent] = *place;
    difference.hash = {second, part, RowWords(one).name(fmt::format("{}", agent))};
  }
  const std::pair listings{listing(settings.first), listing(settings.second)};
  difference.happening =
      first_happening(runs, listings.first == listings.second && is_listed(listings.first));
  add_notes(difference, runs, listings);
  return difference;
}

}  // namespace results::record
