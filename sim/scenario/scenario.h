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

namespace sim::scenario {

using namespace std::chrono_literals;

/// Agents that were declared together: one key under `agents:`.
struct Group {
  std::string name;
  std::vector<hal::AgentId> agents;   ///< In order of declaration, at least one.
  std::vector<std::string> places{};  ///< "file:line:column" of each one's pose, or of their grid.
  std::string program;                ///< Controller; empty: none.
  std::string program_place;          ///< "file:line:column" of `program`, for error messages.
  int processes = 1;                  ///< Controller processes that share the agents.
  std::vector<Program> programs{};    ///< Inside each of the agents.
  bool inside = false;                ///< Each of them inside its agent's network.
};

/// The run must end with this result.
struct ExpectedResult {
  std::string result;
};

/// The true distance between two agents at the end of the run must be below a limit.
struct ExpectedDistance {
  std::string whose;                ///< Name of the first one or, with `entered`, a pattern.
  std::vector<hal::AgentId> which;  ///< The agents it names: one, or with `entered` at least one.
  hal::AgentId to;
  hal::Metres below;
  /// Not empty: of these agents the one whose controller was the last to enter this state, e.g.
  /// whichever robot the task fell to.
  std::string entered = {};
};

/// A condition must hold at the end, or must have held at some time of the run.
struct ExpectedCondition {
  std::size_t asked = 0;  ///< Index in SimulationConfig::asked.
  bool at_some_time = false;
};

/// A state of agents' controllers that the scenario waits for or asks about.
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

/// What goes into the results.
struct RecordOptions {
  Detail frames = Detail::kCounts;
  Detail messages = Detail::kAll;
  Detail samples = Detail::kCounts;
  Detail routes = Detail::kNone;
  Detail readings = Detail::kNone;
  hal::Duration pose_period = 1s;
  std::string air{};                           ///< File of the captured frames; empty: none.
  std::optional<hal::AgentId> air_heard_by{};  ///< None: by an ear that hears all.
  std::vector<ObservableRequest> observables{};
  std::vector<std::string> observable_places{};  ///< "file:line:column" of each one's name.
  /// Units of what controllers record, by controller and name, as far as they declare it.
  std::map<std::pair<std::string, std::string>, std::string> recorded_units{};
  std::vector<Countable> declared{};  ///< States and records that controllers declare.
};

/// Whose figures a report shows beside those of the runs.
enum class Published : std::uint8_t { kNothing, kLabella2009 };

/// Above so many agents messages are counted and not listed, and what only a view needs is not
/// recorded, unless the file asks for it.
inline constexpr std::size_t kAgentsOfListedMessages = 100;

/// A scenario file with everything that it includes and the overrides of the command line: checked,
/// in SI units, defaults filled in.
struct Scenario {
  std::string name;  ///< `name:`, or the file's without extension.
  agents::SimulationConfig simulation;
  std::vector<Group> groups;  ///< In order of declaration.
  std::vector<Expectation> expectations;
  std::optional<hal::Duration> reply_timeout = 10s;  ///< None: wait for ever.
  hal::Duration wait = 30s;                          ///< For the next controller, before the start.
  RecordOptions record;
  std::vector<PlotRequest> report;  ///< What the report shows.
  Published compare = Published::kNothing;
  std::vector<AwaitedState> awaited;  ///< For who knows which states controllers enter.
  std::vector<std::string> warnings;  ///< What is allowed and hardly meant, a line each.
};

/// The keys of a scenario file. A scenario that is read needs a name already, for a file without.
void keys_of(hal::files::description::Fields& io, Scenario& scenario);

/// Reads a scenario from the top level of its file; notes mistakes there.
Scenario read_scenario(hal::files::config::Mapping in, const std::filesystem::path& file);

/// Reads a scenario.
/// @param overrides  "dotted.path=value" in the file's value syntax; they win over the file, later
///   ones over earlier ones. A mapping on the right replaces the file's. `include` paths are
///   relative to the scenario's folder or, failing that, to the working directory.
/// @throws hal::files::config::ConfigErrors with every mistake in all files or, if there is none,
/// with the
///   bodies that overlap at the start.
Scenario load_scenario(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {});

}  // namespace sim::scenario
