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
  io.text({"name", "Name of the scenario and of its results folder: letters, digits, '_' and '-'.",
           "two_motes", "the file's name without its ending"},
          scenario.name);
  hal::files::description::check_folder_name(io, scenario.name);
}

void simulation_keys(Fields& io, Scenario& scenario) {
  agents::SimulationConfig& c = scenario.simulation;
  io.count({"seed", "Seed of all random streams. Equal files and seeds give equal runs.", "1"}, 0,
           std::numeric_limits<std::int64_t>::max(), c.seed);
  io.duration({"controller_latency",
               "Time from an event to the effect of the controller's answer to it.", "10 ms"},
              {0, 10}, c.controller_latency);
  io.choice({"control_phase",
             "aligned: all agents have their control cycles at the same instants; uniform: each "
             "has a phase drawn at random. If aligned, robots that hear a call answer at the same "
             "instant and their frames collide: those of many_robots then drive half as far again "
             "(docs/sensitivity.md).",
             "uniform"},
            kPhases, c.control_phase);
  io.duration({"control_period", "Time between two calls of a controller's step().", "100 ms"},
              {1e-3, 10}, c.control_period);
  io.duration({"command_timeout",
               "Time without a command after which an agent stops driving; applies in real time "
               "and with `on_death: silence`.",
               "500 ms"},
              {1e-3, 3600}, c.command_timeout);
  io.duration(
      {"lateness_limit",
       "For agents with a `network`: a frame counts as late if it is delayed by more than this, in "
       "simulated time, between a program and the radio. If more than one in a hundred of at least "
       "100 frames are late (95 % confidence), the result says that this computer was too slow; "
       "with fewer frames it gives their number if more than half are late.",
       "1 ms"},
      {1e-6, 10}, c.lateness_limit);
  io.choice({"on_death",
             "What happens if a controller ends or does not answer. fail: the run fails; silence: "
             "the agent goes on without commands.",
             "fail"},
            kDeaths, c.on_death);
  io.optional_duration({"reply_timeout",
                        "Real time that a controller may take to answer before it counts as dead; "
                        "for one inside its agent, in lock-step, also the simulated time. none: no "
                        "limit, e.g. for a debugger.",
                        "10 s"},
                       1e-3, scenario.reply_timeout);
  io.duration({"wait", "Longest real time to wait for the controllers before the start.", "30 s"},
              {0, 3600}, scenario.wait);
  io.choice({"link",
             "What routing learns of the frames it sends. mac: the outcome of each frame, as the "
             "MAC reports it; udp_like: nothing, as with a UDP socket.",
             "mac"},
            kLinks, c.link);
}

constexpr std::array kSampledDetails = {
    Option<Detail>{"none", Detail::kNone}, Option<Detail>{"counts", Detail::kCounts},
    Option<Detail>{"sample", Detail::kSample}, Option<Detail>{"all", Detail::kAll}};
constexpr std::array kRouteDetails = {Option<Detail>{"none", Detail::kNone},
                                      Option<Detail>{"all", Detail::kAll}};
constexpr std::array kReadingDetails = {Option<Detail>{"none", Detail::kNone},
                                        Option<Detail>{"ranges", Detail::kSample},
                                        Option<Detail>{"all", Detail::kAll}};

void detail_keys(Fields& io, RecordOptions& c) {
  io.choice({"frames",
             "How radio frames are recorded. none: not at all; counts: counted; sample: also one "
             "row each, with rows of their receptions, for the first ones of each simulated "
             "second, up to 5000 rows; all: rows for every frame.",
             "all", "sample; counts with more than 100 agents"},
            kSampledDetails, c.frames);
  io.choice({"messages",
             "How messages and their deliveries are recorded. none: not at all; counts: counted; "
             "sample: a row for each to one agent, which quartiles of their delays need, and of "
             "those to everyone and to neighbours for the first ones of each simulated second, "
             "until they and their deliveries are 1000 rows, while the others are counted; all: a "
             "row for each.",
             "all", "sample; counts with more than 100 agents"},
            kSampledDetails, c.messages);
  io.choice({"samples",
             "How DDS samples that programs on agents with a `network` exchange are recorded. "
             "none: not at all; counts: counted by writer and reader, with a histogram of "
             "latencies; all: also a row for each.",
             "all"},
            kDetails, c.samples);
  io.choice({"routes",
             "Whether changes of routing tables and of queue lengths are recorded, as `baraka "
             "view` needs to show them.",
             "none", "all; none with more than 100 agents"},
            kRouteDetails, c.routes);
  io.choice(
      {"readings",
       "Which sensor readings are recorded, when they change and at most once per pose_period. "
       "ranges: those of range sensors and bumpers with up to 32 values; all: all channels.",
       "all", "ranges; none with more than 100 agents"},
      kReadingDetails, c.readings);
  io.choice({"inputs",
             "Whether inputs from outside are recorded, as `baraka run --repeat` needs: frames of "
             "programs, velocities from teleoperation. They take more space than all else where "
             "programs send much.",
             "none"},
            kRouteDetails, c.inputs);
  io.duration(
      {"pose_period", "Time between two recorded poses of an agent; at most one per control cycle.",
       "1 s", "100 ms; 1 s with more than 100 agents"},
      {1e-3, 3600}, c.pose_period);
}

constexpr std::string_view kNoCapture = "none";
constexpr std::string_view kEar = "all";
constexpr std::string_view kCaptureEnding = ".pcapng";

void air_key(Fields& io, std::string& air) {
  io.spelled(
      {"air",
       "File in the results folder for the frames on the air (radiotap and IEEE 802.11 in pcapng, "
       "for Wireshark); none: no such file.",
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
       "With `air`: the agent whose sent and received frames are written; all: every transmitted "
       "frame.",
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
    c.messages = many ? Detail::kCounts : Detail::kSample;
    c.frames = many ? Detail::kCounts : Detail::kSample;
    c.routes = many ? Detail::kNone : Detail::kAll;
    c.readings = many ? Detail::kNone : Detail::kSample;
    c.pose_period = many ? 1s : 100ms;
  }
  io.inside({"record", "What is written to the results."}, [&](Fields& record) {
    detail_keys(record, c);
    air_key(record, c.air);
    air_heard_by_key(record, scenario);
    observables_keys(record, scenario);
  });
}

}  // namespace sim::scenario
