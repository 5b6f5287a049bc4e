#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

#include "results/record/database.h"
#include "results/record/schema.h"
#include "sim/agents/simulation_config.h"

namespace results::record::test {

/// A folder of its own, gone with the object.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("baraka_record_" + std::to_string(::getpid()) + "_" + name)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path file() const { return path_ / "run.sqlite"; }

 private:
  std::filesystem::path path_;
};

/// First column of the first row, as text; "null" for a null, "none" without a row.
inline std::string ask(const std::filesystem::path& file, const std::string& sql) {
  Database database(file, Database::Mode::kRead);
  Statement query(database, sql);
  if (!query.next()) return "none";
  return query.is_null(0) ? "null" : query.text(0);
}

/// A result by hand: the tables, then `sql`.
inline void make_result(const std::filesystem::path& folder, const std::string& sql) {
  std::filesystem::create_directories(folder);
  Database database(folder / "run.sqlite", Database::Mode::kCreate);
  create_tables(database);
  database.execute(sql);
}

/// Two motes m0 (1) and m1 (2), and a robot r0 (3); m1 in state DONE ends the run. A wall.
inline sim::agents::SimulationConfig small_config() {
  sim::agents::SimulationConfig config;
  config.seed = 7;
  config.radio = sim::radio::MobilityFrameworkConfig{};
  const auto add = [&config](std::uint16_t id, const char* name, double x, auto body) {
    sim::agents::AgentConfig agent;
    agent.id = hal::AgentId{id};
    agent.name = name;
    agent.pose = {x, 0, 0};
    agent.body = std::move(body);
    agent.program = "program";
    config.agents.push_back(std::move(agent));
  };
  add(1, "m0", 0, hal::node::devices::MoteDescription{});
  add(2, "m1", 100, hal::node::devices::MoteDescription{});
  add(3, "r0", 50, hal::node::devices::RobotDescription{});
  config.walls = {{.name = "fence", .centre = {5, 6, 0.5}, .size = {2, 0.25, 1}, .yaw = 0.5}};
  config.ends = {{hal::AgentId{2}, "DONE", std::chrono::seconds{1}, "arrived"},
                 {std::nullopt, "", std::chrono::seconds{3600}, "timeout"}};
  return config;
}

}  // namespace results::record::test
