#include "sim/scenario/run_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>

#include "hal/files/description/names.h"
#include "sim/scenario/observables_section.h"
#include "sim/scenario/result_file.h"

namespace sim::scenario {
namespace {

using agents::ControlPhase;
using agents::LinkKind;
using agents::OnDeath;

constexpr std::array kPhases = {Option<ControlPhase>{"aligned", ControlPhase::kAligned},
                                Option<ControlPhase>{"uniform", ControlPhase::kUniform}};
constexpr std::array kDeaths = {Option<OnDeath>{"fail", OnDeath::kFail},
                                Option<OnDeath>{"silence", OnDeath::kSilence}};
constexpr std::array kLinks = {Option<LinkKind>{"mac", LinkKind::kMac},
                               Option<LinkKind>{"udp_like", LinkKind::kUdpLike}};
constexpr std::array kDetails = {Option<Detail>{"none", Detail::kNone},
                                 Option<Detail>{"counts", Detail::kCounts},
                                 Option<Detail>{"all", Detail::kAll}};

/// Default controller latency.
constexpr hal::Duration kDefaultLatency = 10ms;

/// The name is also that of the folder of results.
void head_keys(Fields& io, Scenario& scenario) {
  hal::files::description::needed_version_key(io);
  io.text(
      {"name", "Of the scenario and of the folder of its results: letters, digits, '_' and '-'.",
       "two_motes", "the file's without its ending"},
      scenario.name);
  if (!hal::files::description::are_name_characters(scenario.name))
    io.mistake("name", fmt::format("'{}' must be letters, digits, '_' and '-'", scenario.name));
}

void simulation_keys(Fields& io, Scenario& scenario) {
  agents::SimulationConfig& c = scenario.simulation;
  io.count({"seed", "Of all random streams: equal files and seeds give equal runs.", "1"}, 0,
           std::numeric_limits<std::int64_t>::max(), c.seed);
  io.duration({"controller_latency", "An action takes effect this long after the event it answers.",
               "10 ms"},
              {0, 10}, c.controller_latency);
  io.choice(
      {"control_phase",
       "Whether all control cycles start together, or each agent's at a phase drawn for it. If "
       "they start together, robots that hear a call answer it at the same instant and their "
       "frames collide: those of many_robots drive half as far again (docs/sensitivity.md).",
       "uniform"},
      kPhases, c.control_phase);
  io.duration({"control_period", "Between two calls of a controller's step().", "100 ms"},
              {1e-3, 10}, c.control_period);
  io.duration({"command_timeout",
               "Without a command for so long an agent stops driving: in real time, or with "
               "`on_death: silence`.",
               "500 ms"},
              {1e-3, 3600}, c.command_timeout);
  io.duration(
      {"lateness_limit",
       "Of agents with a `network`: a frame that is later than this, in simulated time, "
       "between a program and the air counts as late. If, of at least 100 frames, more than one "
       "in a hundred are (95 % confidence), the result says that this computer was too slow; of "
       "fewer it says how many, if more than half are.",
       "1 ms"},
      {1e-6, 10}, c.lateness_limit);
  io.choice(
      {"on_death", "A controller that dies or does not answer fails the run, or only falls silent.",
       "fail"},
      kDeaths, c.on_death);
  io.optional_duration({"reply_timeout",
                        "A controller that takes longer to answer, by the wall clock, counts as "
                        "dead; none: it may take for ever, as under a debugger. Of one inside its "
                        "agent, in lock-step: also one that waits longer by simulated time.",
                        "10 s"},
                       1e-3, scenario.reply_timeout);
  io.duration({"wait", "How long to wait, by the wall clock, for the controllers before the start.",
               "30 s"},
              {0, 3600}, scenario.wait);
  io.choice({"link",
             "What routing learns of its frames: all that the MAC knows, or as little as a UDP "
             "socket tells.",
             "mac"},
            kLinks, c.link);
}

constexpr std::array kFrameDetails = {
    Option<Detail>{"none", Detail::kNone}, Option<Detail>{"counts", Detail::kCounts},
    Option<Detail>{"sample", Detail::kSample}, Option<Detail>{"all", Detail::kAll}};
constexpr std::array kRouteDetails = {Option<Detail>{"none", Detail::kNone},
                                      Option<Detail>{"all", Detail::kAll}};
constexpr std::array kReadingDetails = {Option<Detail>{"none", Detail::kNone},
                                        Option<Detail>{"ranges", Detail::kSample},
                                        Option<Detail>{"all", Detail::kAll}};

void detail_keys(Fields& io, RecordOptions& c) {
  io.choice({"frames",
             "Frames in the results: not at all, counted, or rows as well: for the first ones of "
             "each simulated second, up to 5000 rows with those of how they ended, or for each.",
             "all", "sample; counts above 100 agents"},
            kFrameDetails, c.frames);
  io.choice({"messages",
             "Messages and deliveries in the results: not at all, counted, or a row for each, as "
             "quartiles of their delays need.",
             "counts", "all; counts above 100 agents"},
            kDetails, c.messages);
  io.choice(
      {"samples",
       "Samples of DDS that programs on agents with a network sent each other: not at all, "
       "counted by writer and receiver with a histogram of latencies, or also a row for each.",
       "all"},
      kDetails, c.samples);
  io.choice({"routes",
             "Changes of agents' routing tables and of the lengths of their queues in the results: "
             "not at all, or each, for `baraka view`.",
             "none", "all; none above 100 agents"},
            kRouteDetails, c.routes);
  io.choice({"readings",
             "What sensors say in the results, where it changes, at most once per pose_period: not "
             "at all, ranges and bumpers of up to 32 values, or all channels.",
             "all", "ranges; none above 100 agents"},
            kReadingDetails, c.readings);
  io.duration(
      {"pose_period",
       "Between two rows of an agent's pose in the results; at most one row per control cycle.",
       "1 s", "100 ms; 1 s above 100 agents"},
      {1e-3, 3600}, c.pose_period);
}

constexpr std::string_view kNoCapture = "none";
constexpr std::string_view kEar = "all";
constexpr std::string_view kCaptureEnding = ".pcapng";

void air_key(Fields& io, std::string& air) {
  io.spelled(
      {"air",
       "File in the results' folder for the frames as they are on the air (radiotap and IEEE "
       "802.11 in pcapng, for Wireshark); none: no such file.",
       "air.pcapng"},
      air, [](const std::string& file) { return file.empty() ? std::string(kNoCapture) : file; },
      [&](const std::string& text, std::string& file) {
        file = text;
        check_result_file(io, "air", file, file, kCaptureEnding);
      });
}

void air_heard_by_key(Fields& io, Scenario& scenario) {
  const auto& agents = scenario.simulation.agents;
  io.spelled(
      {"air_heard_by",
       "With `air`: the agent that sends and receives these frames; all: an ear that hears "
       "whatever is sent.",
       "all"},
      scenario.record.air_heard_by,
      [&](const std::optional<hal::AgentId>& id) {
        const auto agent = std::ranges::find(agents, id, &agents::AgentConfig::id);
        return agent == agents.end() ? std::string(kEar) : agent->name;
      },
      [&](const std::string& text, std::optional<hal::AgentId>& id) {
        const auto agent = std::ranges::find(agents, text, &agents::AgentConfig::name);
        if (agent != agents.end()) id = agent->id;
        if (scenario.record.air.empty()) {
          io.mistake("air_heard_by", "needs `air`, the file for what is heard");
        } else if (!id) {
          io.mistake("air_heard_by", fmt::format("unknown agent '{}'", text));
        }
      });
}

}  // namespace

void run_keys(Fields& io, Scenario& scenario) {
  agents::SimulationConfig& c = scenario.simulation;
  if (!io.is_writing()) c.controller_latency = kDefaultLatency;
  head_keys(io, scenario);
  simulation_keys(io, scenario);
  if (c.command_timeout < c.control_period) {
    io.mistake("command_timeout",
               "must not be shorter than control_period: the wheels would stop between commands");
  }
  c.world.seed = c.seed;
}

void record_keys(Fields& io, Scenario& scenario) {
  RecordOptions& c = scenario.record;
  if (io.reading() != nullptr) {
    const bool many = scenario.simulation.agents.size() > kAgentsOfListedMessages;
    c.messages = many ? Detail::kCounts : Detail::kAll;
    c.frames = many ? Detail::kCounts : Detail::kSample;
    c.routes = many ? Detail::kNone : Detail::kAll;
    c.readings = many ? Detail::kNone : Detail::kSample;
    c.pose_period = many ? 1s : 100ms;
  }
  io.inside({"record", "What goes into the results."}, [&](Fields& record) {
    detail_keys(record, c);
    air_key(record, c.air);
    air_heard_by_key(record, scenario);
    observables_keys(record, scenario);
  });
}

}  // namespace sim::scenario
