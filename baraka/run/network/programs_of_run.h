#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/time.h"
#include "results/record/interface_counts.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/plan.h"

namespace baraka::run::network {

/// The input of the simulation through which the end of a program ends the run.
inline constexpr const char* kProgramsDoor = "programs";

/// Lets programs, or in a repetition their record, end the run. Does nothing without programs.
/// @param simulation  must exist until the run is over.
void open_programs_door(const sim::scenario::Scenario& scenario,
                        sim::agents::Simulation& simulation);

/// The programs of a scenario: starts each when it is due, notes its end, and ends the run if the
/// scenario says so. One thread.
class ProgramsOfRun {
 public:
  /// A program to start now.
  struct Start {
    const sim::scenario::PlannedProgram& program;
    std::filesystem::path folder;  ///< Current path of the folder of results.
  };
  /// Starts a program. @return its number among the agent's programs. @throws std::runtime_error
  using Starter = std::function<std::uint32_t(const Start&)>;
  /// Tells the run to end. Its argument is the content of an arrival at kProgramsDoor.
  using Ender = std::function<void(std::vector<std::uint8_t>)>;

  /// @param planned  sorted by start; what it points into must outlive this object.
  ProgramsOfRun(std::vector<sim::scenario::PlannedProgram> planned, Starter start, Ender end);

  /// Simulated time at which the next program is due; none: all were started.
  std::optional<hal::Time> next() const;

  /// The agent of that program.
  std::optional<hal::AgentId> next_agent() const;

  /// Starts the next program. This takes about a millisecond of wall time, in which no frame moves.
  /// @throws std::runtime_error  it cannot be started: "file:line:column: programs: 'name' …".
  void start_next(hal::Time now, const std::filesystem::path& results);

  /// Notes that a program has ended. @param status  as returned by waitpid().
  void on_end(hal::Time now, hal::AgentId agent, std::uint32_t number, int status);

  /// All programs that were started, including those still running.
  std::vector<results::record::ProgramRow> rows() const;

 private:
  struct Started {
    const sim::scenario::PlannedProgram* planned;
    std::uint32_t number;
    results::record::ProgramRow row;
  };

  std::vector<sim::scenario::PlannedProgram> planned_;  ///< Sorted by start.
  std::size_t next_ = 0;
  std::vector<Started> started_;
  Starter start_;
  Ender end_;
};

}  // namespace baraka::run::network
