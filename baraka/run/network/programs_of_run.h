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

/// The door by which the end of a program ends the run.
inline constexpr const char* kProgramsDoor = "programs";

/// Lets programs end the run, or a record of them in a repetition. Without programs it does
/// nothing. @param simulation  outlives its run.
void open_programs_door(const sim::scenario::Scenario& scenario,
                        sim::agents::Simulation& simulation);

/// The programs of a scenario: each is started when it is due, and its end is noted and does to the
/// run what the scenario says. One thread.
class ProgramsOfRun {
 public:
  /// A program that is due.
  struct Start {
    const sim::scenario::PlannedProgram& program;
    std::filesystem::path folder;  ///< Of the results, as it is called now.
  };
  /// Starts one. @return its number among its agent's. @throws std::runtime_error
  using Starter = std::function<std::uint32_t(const Start&)>;
  /// Tells the run that it has to end: what goes through kProgramsDoor.
  using Ender = std::function<void(std::vector<std::uint8_t>)>;

  /// @param scenario  outlives it.
  ProgramsOfRun(const sim::scenario::Scenario& scenario, Starter start, Ender end);

  /// When the next is due, simulated time.
  std::optional<hal::Time> next() const;

  /// Starts one that is due: it takes a millisecond or so of wall time, in which no frame moves.
  /// @throws std::runtime_error  one cannot be started: "file:line:column: programs: 'name' …".
  void start_next(hal::Time now, const std::filesystem::path& results);

  /// A program has ended. @param status  as of waitpid().
  void on_end(hal::Time now, hal::AgentId agent, std::uint32_t number, int status);

  /// All that were started, with those that still run.
  std::vector<results::record::ProgramRow> rows() const;

 private:
  struct Started {
    const sim::scenario::PlannedProgram* planned;
    std::uint32_t number;
    results::record::ProgramRow row;
  };

  std::vector<sim::scenario::PlannedProgram> planned_;  ///< By start.
  std::size_t next_ = 0;
  std::vector<Started> started_;
  Starter start_;
  Ender end_;
};

}  // namespace baraka::run::network
