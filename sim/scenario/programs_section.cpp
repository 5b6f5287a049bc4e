#include "sim/scenario/programs_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "hal/description/names.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/plan.h"

namespace sim::scenario {
namespace {

constexpr std::array kEnds = {Option<OnExit>{"ignore", OnExit::kIgnore},
                              Option<OnExit>{"fail", OnExit::kFail},
                              Option<OnExit>{"end", OnExit::kEnd}};
const Key kOnExit{"on_exit",
                  "What its end does to the run: nothing; `fail`: the run fails unless it ended "
                  "with status 0; `end`: the same, and with status 0 the run ends with the "
                  "program's name as its result.",
                  "end"};
constexpr Range kStart{0, hal::config::kLongestDuration};  // s
constexpr std::string_view kLogEnding = ".log";

bool is_log_name(std::string name) {
  for (const std::string_view word : {kAgentWord, kNumberWord}) {
    const std::size_t at = name.find(word);
    if (at != std::string::npos) name.replace(at, word.size(), "x");
  }
  const bool allowed = std::ranges::all_of(name, [](char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return letter || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
  });
  return allowed && name.size() > kLogEnding.size() && name.ends_with(kLogEnding) &&
         name.front() != '.';
}

std::vector<std::pair<std::string, std::string>> read_environment(Mapping in) {
  std::vector<std::pair<std::string, std::string>> environment;
  for (const hal::config::PlainValue& given : in.plain_values()) {
    if (given.is_list) in.mistake(given.key, "a variable has one value, not a list");
    if (given.key.find('=') != std::string::npos) in.mistake(given.key, "has a '=' in its name");
    environment.emplace_back(given.key, given.text);
  }
  return environment;
}

void read_log(Mapping& in, const Group& group, Program& program) {
  const std::string otherwise =
      fmt::format("{}.{}{}", kAgentWord, program.name.empty() ? "x" : program.name, kLogEnding);
  program.log = in.text({"log",
                         "File in the results' folder for what the program says; with {agent} or "
                         "{number} where the group has several agents.",
                         "'{agent}.talker.log'", "'{agent}.NAME.log'"},
                        otherwise);
  if (!is_log_name(program.log)) {
    in.mistake("log", fmt::format("'{}' must be a name of letters, digits, '_', '-' and '.' that "
                                  "ends in {}, without a folder: it goes to the results",
                                  program.log, kLogEnding));
  }
  const bool differs = program.log.find(kAgentWord) != std::string::npos ||
                       program.log.find(kNumberWord) != std::string::npos;
  if (!differs && group.agents.size() > 1) {
    in.mistake("log", fmt::format("'{}' must contain {} or {}: {} agents run the program",
                                  program.log, kAgentWord, kNumberWord, group.agents.size()));
  }
}

std::vector<std::string> read_shown(Mapping& in) {
  std::vector<std::string> shown;
  for (hal::config::Scalar& path :
       in.texts({"shown",
                 "Files and folders of this computer's /tmp, /run and /dev/shm that the program "
                 "needs: each agent has its own of these three, empty at first. Absolute; with the "
                 "same words.",
                 "[/tmp/.X11-unix]", "[]"})) {
    if (!path.text.starts_with('/') && !path.text.starts_with(kResultsWord)) {
      in.mistake("shown", fmt::format("'{}' must be an absolute path", path.text));
    }
    shown.push_back(std::move(path.text));
  }
  return shown;
}

Program read_program(Mapping& in, const Group& group) {
  Program program;
  program.place = in.place();
  program.name = in.text({"name",
                          "Of the program, for messages and results: letters, digits, '_' and '-' "
                          "after a letter.",
                          "talker"});
  if (!hal::description::may_be_named(program.name)) {
    in.mistake("name", fmt::format("'{}' must be letters, digits, '_' and '-' after a letter",
                                   program.name));
  }
  for (hal::config::Scalar& word :
       in.texts({"command",
                 "The program, looked for in PATH, and its arguments. {agent} stands for the "
                 "agent's name, {address} for its IPv4 address, {number} for its number in the "
                 "group from 0, {results} for the folder of the results.",
                 "[ping, -c, 10, 10.77.0.2]", hal::config::kMustBeGiven})) {
    program.command.push_back(std::move(word.text));
  }
  if (program.command.empty()) in.mistake("command", "no program: give it and its arguments");
  program.start =
      in.duration({"start", "Simulated time at which it starts.", "2 s"}, kStart, hal::Duration{});
  program.environment = read_environment(in.mapping(
      {"environment", "Variables beside those that `baraka run` has; with the same words.",
       "{CYCLONEDDS_URI: file:///etc/cyclone.xml}"}));
  program.shown = read_shown(in);
  program.on_exit = in.choice(kOnExit, kEnds, OnExit::kIgnore);
  read_log(in, group, program);
  in.finish();
  return program;
}

}  // namespace

void read_programs(Mapping& in, Group& group) {
  std::set<std::string> names;
  for (Mapping& one : in.mappings(
           {"programs",
            "Programs that run inside each agent of the group, with sockets on its `network`.",
            "[{name: pinger, command: [ping, -c, 10, 10.77.0.2]}]"})) {
    group.programs.push_back(read_program(one, group));
    if (names.insert(group.programs.back().name).second) continue;
    one.mistake("name", fmt::format("another program of the group is called '{}'",
                                    group.programs.back().name));
  }
}

void write_programs(Writer& out, const Group& group) {
  if (group.programs.empty()) return;
  out.open_list("programs");
  for (const Program& program : group.programs) {
    out.open_item();
    out.text("name", program.name);
    out.texts("command", program.command);
    out.duration("start", program.start);
    out.open("environment");
    for (const auto& [name, value] : program.environment) out.text(name, value);
    out.close();
    if (!program.shown.empty()) out.texts("shown", program.shown);
    FieldWriter(out).choice(kOnExit, kEnds, program.on_exit);
    out.text("log", program.log);
    out.close();
  }
  out.close();
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
    const auto number = static_cast<std::size_t>(planned.program - planned.group->programs.data());
    agents.within(planned.group->name)
        .items("programs")[number]
        .mistake("log", fmt::format("'{}' is that of {}, too", planned.log, other->second));
  }
}

}  // namespace sim::scenario
