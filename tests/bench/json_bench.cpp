// What the text of a tile of `baraka view` costs, by the view's own writer of JSON (json_text.h)
// and by nlohmann-json: poses of 37 agents, which wander, and frames with how they ended at 36
// radios, as many rows as a tile may have.
//
//   json_bench [rounds=20]
//
// Prints "key: value" lines. Fails if the two do not read back to the same values.

#include <fmt/core.h>
#include <sys/resource.h>

#include <cstdlib>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "view/server/tile.h"

namespace {

using nlohmann::ordered_json;
using view::server::Columns;
using view::server::JsonArray;

constexpr int kAgents = 37;

struct Pose {
  std::int64_t agent, at;
  double x, y, theta;
};

struct End {
  std::int64_t agent, at, verdict;
  double rssi, sinr;
};

struct Frame {
  std::int64_t transmitter, number, at, receiver, bits, airtime;
  std::string kind;
  std::optional<std::int64_t> nav;
  std::vector<End> ends;
};

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

std::vector<Pose> wander(std::mt19937_64& random) {
  std::uniform_real_distribution<> step(-0.05, 0.05);
  std::vector<Pose> all(view::server::kMostPoses);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto agent = static_cast<std::int64_t>(i % kAgents + 1);
    all[i] = {agent, static_cast<std::int64_t>(i / kAgents) * 100'000'000, 0, 0, 0};
    if (i < kAgents) continue;
    const Pose& before = all[i - kAgents];
    all[i].x = before.x + step(random);
    all[i].y = before.y + step(random);
    all[i].theta = before.theta + step(random);
  }
  return all;
}

/// So many ends as a tile may have of frames that all radios hear.
std::vector<Frame> talk(std::mt19937_64& random) {
  constexpr std::int64_t kMostEnds = 100'000;
  std::uniform_real_distribution<> level(-95, -40);
  std::vector<Frame> all(kMostEnds / (kAgents - 1));
  std::int64_t at = 1'000'000'000;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto from = static_cast<std::int64_t>(i % kAgents + 1);
    at += 1'234'567;
    all[i] = {from,        static_cast<std::int64_t>(i / kAgents),
              at,          65535,
              1024,        1'248'000,
              "broadcast", std::nullopt,
              {}};
    for (std::int64_t to = 1; to <= kAgents; ++to) {
      const double rssi = level(random);
      if (to != from) all[i].ends.push_back({to, at + 1'248'033, to % 5, rssi, rssi + 95});
    }
  }
  return all;
}

std::string ours(const std::vector<Pose>& rows) {
  Columns columns({"agent", "at", "x", "y", "theta"});
  for (const Pose& row : rows) columns.add(row.agent, row.at, row.x, row.y, row.theta);
  return columns.json().text;
}

std::string ours(const std::vector<Frame>& rows) {
  Columns columns(
      {"transmitter", "number", "at", "class", "receiver", "bits", "airtime", "nav", "ends"});
  for (const Frame& row : rows) {
    JsonArray ends;
    for (const End& end : row.ends) {
      ends.add(JsonArray()
                   .add(end.agent)
                   .add(end.at)
                   .add(end.verdict)
                   .add(end.rssi)
                   .add(end.sinr)
                   .json());
    }
    columns.add(row.transmitter, row.number, row.at, row.kind, row.receiver, row.bits, row.airtime,
                row.nav, ends.json());
  }
  return columns.json().text;
}

/// Texts of a record need not be UTF-8.
std::string text_of(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// Columns by name, in the order in which the view has them.
class TheirColumns {
 public:
  TheirColumns(std::initializer_list<std::string_view> names, std::size_t rows)
      : names_(names), columns_(names.size()) {
    for (ordered_json::array_t& one : columns_) one.reserve(rows);
  }

  template <class... Values>
  void add(Values&&... values) {
    std::size_t i = 0;
    (columns_[i++].emplace_back(std::forward<Values>(values)), ...);
  }

  std::string text() {
    ordered_json object;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      object[std::string(names_[i])] = std::move(columns_[i]);
    }
    return text_of(object);
  }

 private:
  std::vector<std::string_view> names_;
  std::vector<ordered_json::array_t> columns_;
};

std::string theirs(const std::vector<Pose>& rows) {
  TheirColumns columns({"agent", "at", "x", "y", "theta"}, rows.size());
  for (const Pose& row : rows) columns.add(row.agent, row.at, row.x, row.y, row.theta);
  return columns.text();
}

std::string theirs(const std::vector<Frame>& rows) {
  TheirColumns columns(
      {"transmitter", "number", "at", "class", "receiver", "bits", "airtime", "nav", "ends"},
      rows.size());
  for (const Frame& row : rows) {
    ordered_json::array_t ends;
    ends.reserve(row.ends.size());
    for (const End& end : row.ends) {
      ends.push_back(ordered_json::array({end.agent, end.at, end.verdict, end.rssi, end.sinr}));
    }
    columns.add(row.transmitter, row.number, row.at, row.kind, row.receiver, row.bits, row.airtime,
                row.nav ? ordered_json(*row.nav) : ordered_json(), std::move(ends));
  }
  return columns.text();
}

/// User time of one text [ms], by turns, so that a busy machine slows both alike.
template <class Rows>
bool compare(const char* name, const std::vector<Rows>& rows, int rounds) {
  double our_time = 0, their_time = 0;
  for (int i = 0; i < rounds; ++i) {
    const double start = user_seconds();
    const std::string our_text = ours(rows);
    const double middle = user_seconds();
    const std::string their_text = theirs(rows);
    their_time += user_seconds() - middle;
    our_time += middle - start;
    if (i == 0 && ordered_json::parse(our_text) != ordered_json::parse(their_text)) return false;
  }
  fmt::print("{0}_ours_ms: {1:.2f}\n{0}_nlohmann_ms: {2:.2f}\n{0}_ratio: {3:.2f}\n", name,
             1e3 * our_time / rounds, 1e3 * their_time / rounds, their_time / our_time);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 20;
  std::mt19937_64 random(1);
  const bool is_equal =
      compare("poses", wander(random), rounds) && compare("frames", talk(random), rounds);
  if (!is_equal) fmt::print(stderr, "error: the texts have not the same values\n");
  return is_equal ? 0 : 1;
}
