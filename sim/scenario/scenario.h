#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hal/files/config/mapping.h"
#include "hal/files/description/fields.h"
#include "hal/types/agent_id.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/agents/simulation_config.h"
#include "sim/scenario/countable.h"
#include "sim/scenario/detail.h"
#include "sim/scenario/observable.h"
#include "sim/scenario/plot_request.h"
#include "sim/scenario/program.h"
#include "sim/scenario/topic_traffic.h"
#include "sim/scenario/world_map.h"

namespace sim::scenario {

using namespace std::chrono_literals;

/// Agents that are declared together, by one key under `agents:`.
struct Group {
  std::string name;
  std::vector<hal::AgentId> agents;  ///< In order of declaration, at least one.
  /// "file:line:column" of the pose of each agent, or of their layout.
  std::vector<std::string> places{};
  std::string program;              ///< Controller; empty: none.
  std::string program_place;        ///< "file:line:column" of `program`, for error messages.
  int processes = 1;                ///< Controller processes that share the agents.
  std::vector<Program> programs{};  ///< Programs inside each agent.
  DdsKeys dds{};
  std::vector<TopicItem> topics{};  ///< Written by each agent.
  std::optional<Program> player{};  ///< Plays topics that its agents write or read.
  bool inside = false;              ///< Each controller runs inside its agent's network namespace.
  /// `routes` of its network, as in the file.
  std::vector<hal::node::routing::StaticRow> ip_routes{};
};

/// The run must end with this result.
struct ExpectedResult {
  std::string result;
};

/// The true distance between two agents at the end of the run must be below a limit.
struct ExpectedDistance {
  std::string whose;                ///< Name of the first agent or, with `entered`, a pattern.
  std::vector<hal::AgentId> which;  ///< The agents named: one, or with `entered` at least one.
  hal::AgentId to;
  hal::Metres below;
  /// If not empty: of these agents, the one whose controller was the last to enter this state, e.g.
  /// the robot that took over the task.
  std::string entered = {};
};

/// A condition must hold at the end of the run, or must have held at some time.
struct ExpectedCondition {
  std::size_t asked = 0;  ///< Index in SimulationConfig::asked.
  bool at_some_time = false;
};

/// A state of agents' controllers that the scenario uses in a condition, an end or an expectation.
struct AwaitedState {
  std::string place;  ///< "file:line:column".
  std::string key;    ///< "end.state"
  std::vector<hal::AgentId> agents;
  std::string state;
};

/// One entry of `expect:`.
struct Expectation {
  std::variant<ExpectedResult, ExpectedDistance, ExpectedCondition> condition;
  std::string place;  ///< "file:line:column".
};

/// What is recorded in the results.
struct RecordOptions {
  Detail frames = Detail::kCounts;
  Detail messages = Detail::kAll;
  Detail samples = Detail::kCounts;
  Detail routes = Detail::kNone;
  Detail readings = Detail::kNone;
  Detail inputs = Detail::kAll;
  hal::Duration pose_period = 1s;
  std::string air{};  ///< Capture file for frames; empty: none.
  /// Agent whose sent and received frames are captured; nullopt: all frames.
  std::optional<hal::AgentId> air_heard_by{};
  std::vector<ObservableRequest> observables{};
  std::vector<std::string> observable_places{};  ///< "file:line:column" of each one's name.
  /// Units of values that controllers record, by controller and name, where declared.
  std::map<std::pair<std::string, std::string>, std::string> recorded_units{};
  std::vector<Countable> declared{};  ///< States and records that controllers declare.
};

/// Published results that a report shows beside those of the runs.
enum class Published : std::uint8_t { kNothing, kLabella2009 };

/// With more agents, messages are counted and not listed, and data that only a view needs is not
/// recorded, unless the file requests it.
inline constexpr std::size_t kAgentsOfListedMessages = 100;

/// A scenario file with all its includes and the overrides of the command line: checked, in SI
/// units, with defaults filled in.
struct Scenario {
  std::string name;  ///< `name:`, or the file's name without extension.
  agents::SimulationConfig simulation;
  std::vector<WorldMap> maps;  ///< Their boxes are the last of `simulation.walls`.
  std::vector<Group> groups;   ///< In order of declaration.
  /// "file:line:column" of each movable, for those that the scenario describes itself.
  std::vector<std::string> movable_places;
  std::vector<Expectation> expectations;
  std::optional<hal::Duration> reply_timeout = 10s;  ///< nullopt: no limit.
  hal::Duration wait = 30s;  ///< For the next controller to connect, before the start.
  RecordOptions record;
  std::vector<PlotRequest> report;  ///< Plots of the report.
  Published compare = Published::kNothing;
  std::vector<AwaitedState> awaited;  ///< For a check against the states that controllers declare.
  /// "file:line:column" of each topic of `priorities`, for a check against those of controllers.
  std::map<std::string, std::string> priority_places;
  /// One line for each value that is allowed but probably a mistake.
  std::vector<std::string> warnings;
};

/// The keys of a scenario file. When reading, the scenario must already have a name, for files
/// without `name`.
void keys_of(hal::files::description::Fields& io, Scenario& scenario);

/// Reads a scenario from the top level of its file; notes mistakes in `in`.
Scenario read_scenario(hal::files::config::Mapping in, const std::filesystem::path& file);

/// Reads a scenario.
/// @param overrides  "dotted.path=value" in the file's value syntax; they take precedence over the
///   file, and later ones over earlier ones. A mapping as value replaces the file's. `include`
///   paths are relative to the scenario's folder or, if not found there, to the working directory.
/// @throws hal::files::config::ConfigErrors  with every mistake in all files or, if there are none,
///   with the bodies that overlap at the start.
Scenario load_scenario(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});

}  // namespace sim::scenario
