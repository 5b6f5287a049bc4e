#include "baraka/run/network/programs_of_run.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "hal/types/log.h"

namespace baraka::run::network {
namespace {

using sim::scenario::OnExit;
using sim::scenario::PlannedProgram;

/// First octet of an arrival at the door; the rest is text.
constexpr std::uint8_t kEnds = 'e', kFails = 'f';

std::vector<std::uint8_t> message(std::uint8_t kind, const std::string& text) {
  std::vector<std::uint8_t> bytes{kind};
  bytes.insert(bytes.end(), text.begin(), text.end());
  return bytes;
}

/// Exit status as a shell reports it: 0..255, 128 + signal if a signal ended the program.
int shell_status(int status) {
  constexpr int kSignalled = 128;
  return WIFSIGNALED(status) ? kSignalled + WTERMSIG(status) : WEXITSTATUS(status);
}

std::string how(int status) {
  if (WIFSIGNALED(status)) return fmt::format("killed by signal {}", WTERMSIG(status));
  return fmt::format("exited with status {}", WEXITSTATUS(status));
}

}  // namespace

void open_programs_door(const sim::scenario::Scenario& scenario,
                        sim::agents::Simulation& simulation) {
  if (sim::scenario::plan_programs(scenario).empty()) return;
  simulation.outside().open(kProgramsDoor, [&simulation](std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) throw std::runtime_error("the end of a program has no octets");
    const std::string text(bytes.begin() + 1, bytes.end());
    bytes.front() == kEnds ? simulation.end(text) : simulation.fail(text);
  });
}

ProgramsOfRun::ProgramsOfRun(std::vector<sim::scenario::PlannedProgram> planned, Starter start,
                             Ender end)
    : planned_(std::move(planned)), start_(std::move(start)), end_(std::move(end)) {}

std::optional<hal::Time> ProgramsOfRun::next() const {
  if (next_ == planned_.size()) return std::nullopt;
  return planned_[next_].start;
}

std::optional<hal::AgentId> ProgramsOfRun::next_agent() const {
  if (next_ == planned_.size()) return std::nullopt;
  return planned_[next_].agent;
}

void ProgramsOfRun::start_next(hal::Time now, const std::filesystem::path& results) {
  if (!next() || *next() > now) return;
  const PlannedProgram& planned = planned_[next_++];
  try {
    const std::uint32_t number = start_({planned, results});
    started_.push_back({&planned,
                        number,
                        {.agent = planned.agent,
                         .agent_name = planned.agent_name,
                         .name = planned.program->name,
                         .started = now}});
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(fmt::format("{}: programs: '{}' of {}: {}", planned.program->place,
                                         planned.program->name, planned.agent_name, e.what()));
  }
  hal::log::info(now, planned.agent_name, "program {} started", planned.program->name);
}

void ProgramsOfRun::on_end(hal::Time now, hal::AgentId agent, std::uint32_t number, int status) {
  const auto ended = std::ranges::find_if(started_, [&](const Started& one) {
    return one.number == number && one.row.agent == agent && !one.row.ended;
  });
  if (ended == started_.end()) return;  // started by `baraka exec`
  ended->row.ended = now;
  ended->row.status = shell_status(status);
  const PlannedProgram& planned = *ended->planned;
  hal::log::info(now, planned.agent_name, "program {} {}", planned.program->name, how(status));
  const OnExit on_exit = planned.program->on_exit;
  if (on_exit == OnExit::kIgnore) return;
  if (ended->row.status != 0) {
    end_(message(kFails, fmt::format("program {} of {} {}; see {}", planned.program->name,
                                     planned.agent_name, how(status), planned.log)));
  } else if (on_exit == OnExit::kEnd) {
    end_(message(kEnds, planned.program->name));
  }
}

std::vector<results::record::ProgramRow> ProgramsOfRun::rows() const {
  std::vector<results::record::ProgramRow> rows;
  for (const Started& one : started_) rows.push_back(one.row);
  return rows;
}

}  // namespace baraka::run::network
