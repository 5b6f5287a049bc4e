#include "sim/scenario/run_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>

#include "sim/scenario/fields.h"
#include "sim/scenario/observables_section.h"

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
constexpr std::array kDetails = {Option<record::Detail>{"none", record::Detail::kNone},
                                 Option<record::Detail>{"counts", record::Detail::kCounts},
                                 Option<record::Detail>{"all", record::Detail::kAll}};

/// What a file that says nothing gets: a controller 10 ms away.
constexpr hal::Duration kDefaultLatency = 10ms;

template <class Io>
void run_keys(Io& io, Scenario& scenario) {
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
                        "dead; none: it may take for ever, as under a debugger.",
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

constexpr std::array kFrameDetails = {Option<record::Detail>{"none", record::Detail::kNone},
                                      Option<record::Detail>{"counts", record::Detail::kCounts},
                                      Option<record::Detail>{"sample", record::Detail::kSample},
                                      Option<record::Detail>{"all", record::Detail::kAll}};
constexpr std::array kRouteDetails = {Option<record::Detail>{"none", record::Detail::kNone},
                                      Option<record::Detail>{"all", record::Detail::kAll}};
constexpr std::array kReadingDetails = {Option<record::Detail>{"none", record::Detail::kNone},
                                        Option<record::Detail>{"ranges", record::Detail::kSample},
                                        Option<record::Detail>{"all", record::Detail::kAll}};

template <class Io>
void record_keys(Io& io, RecordOptions& c) {
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

bool is_capture_name(const std::string& name) {
  const bool allowed = std::ranges::all_of(name, [](char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return letter || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
  });
  return allowed && name.size() > kCaptureEnding.size() && name.ends_with(kCaptureEnding) &&
         name.front() != '.';
}

void read_air(Mapping& in, Scenario& scenario) {
  const std::string file = in.text(
      {"air",
       "File in the results' folder for the frames as they are on the air (radiotap and IEEE "
       "802.11 in pcapng, for Wireshark); none: no such file.",
       "air.pcapng"},
      std::string(kNoCapture));
  const std::string station =
      in.text({"air_heard_by",
               "With `air`: the agent that sends and receives these frames; all: an ear "
               "that hears whatever is sent.",
               "all"},
              std::string(kEar));
  if (file == kNoCapture) {
    if (in.has("air_heard_by") && station != kEar) {
      in.mistake("air_heard_by", "needs `air`, the file for what is heard");
    }
    return;
  }
  scenario.record.air = file;
  if (!is_capture_name(file)) {
    in.mistake("air", fmt::format("'{}' must be a name of letters, digits, '_', '-' and '.' that "
                                  "ends in {}, without a folder: it goes to the results",
                                  file, kCaptureEnding));
  }
  const auto& agents = scenario.simulation.agents;
  const auto agent = std::ranges::find(agents, station, &agents::AgentConfig::name);
  if (agent != agents.end()) {
    scenario.record.air_heard_by = agent->id;
  } else if (station != kEar) {
    in.mistake("air_heard_by", fmt::format("unknown agent '{}'", station));
  }
}

void write_air(Writer& out, const Scenario& scenario) {
  const RecordOptions& record = scenario.record;
  out.text("air", record.air.empty() ? kNoCapture : std::string_view(record.air));
  std::string_view heard_by = kEar;
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    if (agent.id == record.air_heard_by) heard_by = agent.name;
  }
  out.text("air_heard_by", heard_by);
}

}  // namespace

void read_run(Mapping& in, Scenario& scenario) {
  scenario.simulation.controller_latency = kDefaultLatency;
  FieldReader reader(in);
  run_keys(reader, scenario);
  if (scenario.simulation.command_timeout < scenario.simulation.control_period) {
    in.mistake("command_timeout",
               "must not be shorter than control_period: the wheels would stop between commands");
  }
  scenario.simulation.world.seed = scenario.simulation.seed;
}

void read_record(Mapping in, Scenario& scenario) {
  const bool many = scenario.simulation.agents.size() > kAgentsOfListedMessages;
  scenario.record.messages = many ? record::Detail::kCounts : record::Detail::kAll;
  scenario.record.frames = many ? record::Detail::kCounts : record::Detail::kSample;
  scenario.record.routes = many ? record::Detail::kNone : record::Detail::kAll;
  scenario.record.readings = many ? record::Detail::kNone : record::Detail::kSample;
  scenario.record.pose_period = many ? 1s : 100ms;
  FieldReader reader(in);
  record_keys(reader, scenario.record);
  read_air(in, scenario);
  read_observables(in, scenario);
  in.finish();
}

void write_run(Writer& out, const Scenario& scenario) {
  Scenario copy = scenario;
  FieldWriter writer(out);
  run_keys(writer, copy);
  out.open("record");
  record_keys(writer, copy.record);
  write_air(out, scenario);
  write_observables(out, scenario);
  out.close();
}

}  // namespace sim::scenario
