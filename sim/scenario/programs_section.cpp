#include "sim/scenario/programs_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "hal/files/description/names.h"
#include "sim/scenario/plan.h"
#include "sim/scenario/result_file.h"

namespace sim::scenario {
namespace {

constexpr std::array kEnds = {Option<OnExit>{"ignore", OnExit::kIgnore},
                              Option<OnExit>{"fail", OnExit::kFail},
                              Option<OnExit>{"end", OnExit::kEnd}};
constexpr Range kStart{0, hal::files::config::kLongestDuration};  // s
constexpr std::string_view kLogEnding = ".log";

void environment_key(Fields& io, Program& c) {
  const Key key{"environment",
                "Environment variables besides those of `baraka run`; {agent}, {address}, {number} "
                "and {results} stand for the same as in `command`.",
                "{CYCLONEDDS_URI: file:///etc/cyclone.xml}"};
  io.own(
      key, {.kind = hal::files::config::Form::Kind::kMapping},
      [&](Mapping& in) {
        Mapping variables = in.mapping(key);
        for (const hal::files::config::PlainValue& given : variables.plain_values()) {
          if (given.is_list) variables.mistake(given.key, "a variable has one value, not a list");
          if (given.key.find('=') != std::string::npos)
            variables.mistake(given.key, "has a '=' in its name");
          c.environment.emplace_back(given.key, given.text);
        }
      },
      [&](Writer& out) {
        out.open(key.name);
        for (const auto& [name, value] : c.environment) out.text(name, value);
        out.close();
      });
}

void shown_key(Fields& io, Program& c) {
  io.written_if(!c.shown.empty(), [&](Fields& written) {
    written.texts({"shown",
                   "Files and folders below /tmp, /run and /dev/shm of this computer that the "
                   "program needs: each agent has its own of these three, empty at first. Absolute "
                   "paths; {agent} and so on stand for the same as in `command`.",
                   "[/tmp/.X11-unix]", "[]"},
                  c.shown);
  });
  for (const std::string& path : c.shown) {
    if (!path.starts_with('/') && !path.starts_with(kResultsWord))
      io.mistake("shown", fmt::format("'{}' must be an absolute path", path));
  }
}

void log_key(Fields& io, Program& c, const Group& group) {
  if (c.log.empty()) {
    c.log = fmt::format("{}.{}{}", kAgentWord, c.name.empty() ? "x" : c.name, kLogEnding);
  }
  io.text({"log",
           "File in the results folder for the program's output; must contain {agent} or {number} "
           "if the group has several agents.",
           "'{agent}.talker.log'", "'{agent}.NAME.log'"},
          c.log);
  // Only the placeholders that identify the agent are allowed in a log's name.
  check_result_file(io, "log", c.log, filled_in(c.log, {"x", "{}", "x", "{}"}), kLogEnding);
  const bool differs =
      c.log.find(kAgentWord) != std::string::npos || c.log.find(kNumberWord) != std::string::npos;
  if (!differs && group.agents.size() > 1) {
    io.mistake("log", fmt::format("'{}' must contain {} or {}: {} agents run the program", c.log,
                                  kAgentWord, kNumberWord, group.agents.size()));
  }
}

void check_name(Fields& io, const Program& program, const Group& group) {
  hal::files::description::check_name(io, program.name);
  if (std::ranges::count(group.programs, program.name, &Program::name) > 1) {
    io.mistake("name", fmt::format("another program of the group is called '{}'", program.name));
  }
}

void program_keys(Fields& io, Program& c, const Group& group) {
  if (io.reading() != nullptr) c.place = io.reading()->place();
  io.needed_text(
      {"name",
       "Name of the program in messages and results: letters, digits, '_' and '-' after a letter.",
       "talker"},
      c.name);
  check_name(io, c, group);
  io.texts({"command",
            "The program, searched for in PATH, and its arguments. {agent} stands for the agent's "
            "name, {address} for its IPv4 address, {number} for its number in the group from 0, "
            "{results} for the results folder.",
            "[ping, -c, 10, 10.77.0.2]", hal::files::config::kMustBeGiven},
           c.command);
  if (c.command.empty()) io.mistake("command", "no program: give it and its arguments");
  io.duration({"start", "Simulated time at which the program starts.", "2 s"}, kStart, c.start);
  environment_key(io, c);
  shown_key(io, c);
  io.choice({"on_exit",
             "Effect of the program's end on the run. ignore: none; fail: the run fails unless the "
             "exit status is 0; end: likewise, and with exit status 0 the run ends with the "
             "program's name as its result.",
             "end"},
            kEnds, c.on_exit);
  log_key(io, c, group);
}

}  // namespace

void programs_keys(Fields& io, Group& group) {
  io.list_if_any<Program>(
      {"programs", "Programs that run inside each agent of the group and use its `network`.",
       "[{name: pinger, command: [ping, -c, 10, 10.77.0.2]}]"},
      group.programs, [&](Fields& one, Program& program) { program_keys(one, program, group); });
}

void check_logs(Mapping& in, const Scenario& scenario) {
  std::map<std::string, std::string> taken{{"run.log", "the run"}};
  for (const ProcessPlan& plan : plan_processes(scenario)) {
    taken.emplace(plan.process + ".log", "controller process " + plan.process);
  }
  Mapping agents = in.within("agents");
  for (const PlannedProgram& planned : plan_programs(scenario)) {
    const auto [other, is_new] = taken.emplace(
        planned.log, fmt::format("{} of {}", planned.program->name, planned.agent_name));
    if (is_new) continue;
    Mapping group = agents.within(planned.group->name);
    if (planned.program->is_shipped) {
      group.mistake("topics",
                    fmt::format("their log '{}' is that of {}, too", planned.log, other->second));
      continue;
    }
    const auto number = static_cast<std::size_t>(planned.program - planned.group->programs.data());
    group.items("programs")[number].mistake(
        "log", fmt::format("'{}' is that of {}, too", planned.log, other->second));
  }
}

}  // namespace sim::scenario
