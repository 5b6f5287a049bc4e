#include "results/fleet/played_topics.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

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

PlayedTopics played(const std::string& agent, const nlohmann::json& plan,
                    const nlohmann::json& journal, double end_s) {
  PlayedTopics topics{.agent = agent, .writes = {}, .reads = {}};
  const double seconds = end_s - 1e-9 * plan.at("begin_ns").get<double>();
  for (const auto& one : plan.at("writes")) topics.writes[one.at("topic").get<std::string>()] = 0;
  for (const auto& one : plan.at("reads")) topics.reads.insert(one.at("topic").get<std::string>());
  for (const auto& one : journal.at("written")) {
    const double written = one.at("samples").get<double>();
    topics.writes[one.at("topic").get<std::string>()] = seconds > 0 ? written / seconds : 0;
  }
  return topics;
}

}  // namespace

std::vector<PlayedTopics> read_players(const fs::path& folder, const AgentNames& names,
                                       double end_s) {
  std::vector<PlayedTopics> players;
  for (const auto& [address, agent] : names) {
    const fs::path file = folder / (agent + ".topics.plan.json");
    const auto plan = json_in(file);
    if (!plan) continue;
    const auto journal = json_in(folder / (agent + ".topics.json"));
    try {
      players.push_back(
          played(agent, *plan, journal.value_or(nlohmann::json{{"written", {}}}), end_s));
    } catch (const nlohmann::json::exception& e) {
      throw std::runtime_error(fmt::format("{}: {}", file.string(), e.what()));
    }
  }
  return players;
}

}  // namespace results::fleet
