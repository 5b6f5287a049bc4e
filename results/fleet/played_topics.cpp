#include "results/fleet/played_topics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

namespace results::fleet {
namespace {

namespace fs = std::filesystem;

/// nullopt: there is no such file.
std::optional<nlohmann::json> json_in(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  std::ifstream in(file);
  try {
    return nlohmann::json::parse(in);
  } catch (const nlohmann::json::exception& e) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), e.what()));
  }
}

/// Samples due from `begin` to the end; nullopt: instants are drawn or recorded.
std::optional<std::uint64_t> due(const nlohmann::json& write, double seconds) {
  if (!write.contains("rhythm") || !write["rhythm"].contains("jitter_ns")) return std::nullopt;
  const double rate = write["rhythm"].at("rate").get<double>();
  // The phase of the first one is drawn; at least this many.
  return static_cast<std::uint64_t>(std::max(0.0, std::floor(rate * seconds - 1)));
}

PlayedTopics played(const std::string& agent, const nlohmann::json& plan, double end_s) {
  PlayedTopics topics{.agent = agent, .writes = {}, .reads = {}};
  const auto begin = hal::time_from_ns(plan.at("begin_ns").get<std::int64_t>());
  for (const auto& one : plan.at("writes")) {
    topics.writes[one.at("topic").get<std::string>()] = {
        .begin = begin, .written = 0, .due = due(one, end_s - hal::to_seconds(begin))};
  }
  for (const auto& one : plan.at("reads")) topics.reads.insert(one.at("topic").get<std::string>());
  return topics;
}

void add_journal(const nlohmann::json& journal, PlayedTopics& topics) {
  for (const auto& one : journal.at("written")) {
    const auto found = topics.writes.find(one.at("topic").get<std::string>());
    if (found != topics.writes.end())
      found->second.written = one.at("samples").get<std::uint64_t>();
  }
}

/// Calls `act` with what is in a file. @return whether there is such a file.
template <class Act>
bool with_json(const fs::path& file, const Act& act) {
  try {
    const auto json = json_in(file);
    if (json) act(*json);
    return json.has_value();
  } catch (const nlohmann::json::exception& e) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), e.what()));
  }
}

}  // namespace

std::vector<PlayedTopics> read_players(const fs::path& folder, const AgentNames& names,
                                       double end_s) {
  std::vector<PlayedTopics> players;
  for (const auto& named : names) {
    const std::string& agent = named.second;
    PlayedTopics topics;
    const bool is_there =
        with_json(folder / (agent + ".topics.plan.json"),
                  [&](const nlohmann::json& plan) { topics = played(agent, plan, end_s); });
    if (!is_there) continue;
    with_json(folder / (agent + ".topics.json"),
              [&](const nlohmann::json& journal) { add_journal(journal, topics); });
    players.push_back(std::move(topics));
  }
  return players;
}

}  // namespace results::fleet
