#include "sim/scenario/topics_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

#include "sim/scenario/agent_names.h"
#include "sim/scenario/given_file.h"
#include "sim/scenario/topic_parts.h"
#include "sim/scenario/topic_sizes.h"

namespace sim::scenario {
namespace {

constexpr std::array kVendors = {Option<DdsVendor>{"cyclonedds", DdsVendor::kCycloneDds},
                                 Option<DdsVendor>{"fastdds", DdsVendor::kFastDds}};
using Reliability = hal::TopicQos::Reliability;
using Durability = hal::TopicQos::Durability;
constexpr std::array kReliabilities = {
    Option<Reliability>{"reliable", Reliability::kReliable},
    Option<Reliability>{"best_effort", Reliability::kBestEffort}};
constexpr std::array kDurabilities = {
    Option<Durability>{"volatile", Durability::kVolatile},
    Option<Durability>{"transient_local", Durability::kTransientLocal}};

constexpr std::array kParticipants = {Option<Participants>{"agent", Participants::kAgent},
                                      Option<Participants>{"topic", Participants::kTopic}};
constexpr std::array kRecordedParticipants = {
    Option<Participants>{"recorded", Participants::kRecorded},
    Option<Participants>{"agent", Participants::kAgent},
    Option<Participants>{"topic", Participants::kTopic}};

/// OMG DDSI-RTPS 2.5, 9.6.2.3: ports are 7400 + 250 * domain + …, up to 65,535.
constexpr std::int64_t kLastDomain = 232;
constexpr std::uint32_t kMostHistory = 1'000'000;
constexpr const char* kAll = "all";
constexpr Range kDeadlines{1e-6, 1e6};                                // s
constexpr Range kTimeOfRun{0, hal::files::config::kLongestDuration};  // s

const Key kName{
    "name",
    "Name on DDS; {agent} stands for the writing agent's name. ROS 2's /scan is rt/scan "
    "there. With `from`: pattern of the names in the recording, by default all.",
    "rt/{agent}/scan"};
const Key kReliability{"reliability",
                       "RELIABILITY of writers and readers. With `from`: in place of the recorded "
                       "one, as the other policies.",
                       "best_effort", "reliable"};
const Key kDurability{"durability",
                      "DURABILITY: with transient_local, readers that come late get the samples in "
                      "the writer's history.",
                      "transient_local", "volatile"};
const Key kHistory{"history",
                   "HISTORY of writers and readers: the number of samples that are kept "
                   "(KEEP_LAST), or `all` (KEEP_ALL), with which writes may block and be refused.",
                   "5", "10"};
const Key kParticipantsKey{
    "participants",
    "Participants of DDS that write, and at each reader read, the topics, each a process of its "
    "own: one for all of the agent, or one for each topic. With `from` also as recorded, which is "
    "the default and needs a pcap or pcapng; other recordings do not tell, and have one.",
    "topic", "agent"};
const Key kDeadline{"deadline", "DEADLINE that writers offer and readers request.", "200 ms",
                    "none"};

void dds_keys(Fields& io, DdsKeys& c) {
  io.choice({"vendor", "DDS implementation of the agents' participants.", "fastdds"}, kVendors,
            c.vendor);
  file_key(io,
           {"profile",
            "The vendor's configuration, an XML file: of Cyclone DDS what CYCLONEDDS_URI names, of "
            "Fast DDS the default profiles. Relative to this file's folder, or to the shared one.",
            "dds/cyclone_spdp_500ms.xml", "none"},
           c.profile);
  io.count({"domain", "DDS domain.", "0"}, 0, kLastDomain, c.domain);
  io.duration({"start", "Simulated time at which the participants start.", "200 ms"}, kTimeOfRun,
              c.start);
  io.duration(
      {"begin",
       "Time from a participant's start until it begins to write; nobody waits for readers.",
       "1 s"},
      kTimeOfRun, c.begin);
}

std::string history_text(const std::optional<std::uint32_t>& depth) {
  return depth ? std::to_string(*depth) : kAll;
}

void take_history(Fields& io, const std::string& text, std::optional<std::uint32_t>& depth) {
  std::uint32_t given = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, given);
  if (text == kAll) {
    depth.reset();
  } else if (error == std::errc{} && rest == end && given >= 1 && given <= kMostHistory) {
    depth = given;
  } else {
    io.mistake("history", fmt::format("'{}' is neither a number of samples, 1 .. {}, nor {}", text,
                                      kMostHistory, kAll));
  }
}

void qos_keys(Fields& io, hal::TopicQos& c) {
  io.choice(kReliability, kReliabilities, c.reliability);
  io.spelled(kHistory, c.depth, history_text,
             [&](const std::string& text, std::optional<std::uint32_t>& depth) {
               take_history(io, text, depth);
             });
  io.choice(kDurability, kDurabilities, c.durability);
  io.given(kDeadline, kDeadlines, c.deadline);
}

void stated_keys(Fields& io, TopicItem& c) {
  io.needed_text(kName, c.name);
  size_key(io, c.sizes);
  rhythm_keys(io, c.rhythm);
  qos_keys(io, c.qos);
  io.choice(kParticipantsKey, kParticipants, c.participants);
}

void rename_key(Fields& io, RecordedTraffic& c) {
  const Key key{"rename",
                "With `from`: names on DDS by recorded names. The others get the agent's name as "
                "namespace: rt/scan becomes rt/{agent}/scan.",
                "{rt/tf: rt/tf}"};
  io.own(
      key, {.kind = Form::Kind::kMapping},
      [&](Mapping& in) {
        Mapping names = in.mapping(key);
        for (const hal::files::config::PlainValue& given : names.plain_values()) {
          if (given.is_list) names.mistake(given.key, "a topic has one new name, not a list");
          c.rename[given.key] = given.text;
        }
      },
      [&](Writer& out) {
        out.open(key.name);
        for (const auto& [name, to] : c.rename) out.text(name, to);
        out.close();
      });
}

void recorded_qos_keys(Fields& io, RecordedTraffic& c) {
  io.given_choice(kReliability, kReliabilities, c.reliability);
  io.given_choice(kDurability, kDurabilities, c.durability);
  std::string history = c.depth ? history_text(*c.depth) : "";
  if (io.given_text(kHistory, history)) take_history(io, history, c.depth.emplace());
  io.given(kDeadline, kDeadlines, c.deadline);
}

void recorded_keys(Fields& io, TopicItem& c) {
  file_key(
      io,
      {"from",
       "Recording whose topics are written, with their sizes, instants and QoS: MCAP, rosbag2, "
       "pcap or pcapng. Topics without QoS are reliable, volatile, keep last 10. An agent's "
       "topics begin up to 1 s after the others', drawn, and those of one participant keep their "
       "time to each other.",
       "lab.mcap"},
      c.recorded.from);
  if (io.reading() != nullptr) {
    c.name = "*";
    c.participants = Participants::kRecorded;
    c.recorded.spread = 10ms;
  }
  io.text(kName, c.name);
  rename_key(io, c.recorded);
  io.flag({"repeat", "With `from`: whether it begins again when it is over.", "true"},
          c.recorded.repeats);
  io.flag({"flows",
           "With `from`: whether the recording's UDP datagrams that are not RTPS are sent, too, to "
           "the same ports of the readers.",
           "true"},
          c.recorded.has_flows);
  recorded_qos_keys(io, c.recorded);
  io.choice(kParticipantsKey, kRecordedParticipants, c.participants);
  io.duration({"spread",
               "With `from`: each participant of an agent begins to play up to so much later, "
               "drawn. By default, what programs that start together have in lock-step; with 0 s "
               "the topics lie to each other in time as recorded, with 1 s as after another start.",
               "1 s"},
              {0, 1}, c.recorded.spread);
}

void topic_keys(Fields& io, TopicItem& c) {
  if (io.reading() != nullptr) c.place = io.reading()->place();
  const auto recorded = [&](Fields& one) { recorded_keys(one, c); };
  const auto stated = [&](Fields& one) { stated_keys(one, c); };
  if (!io.first_of({{"from", c.is_recorded(), recorded}, {"name", !c.is_recorded(), stated}}))
    stated(io);
  io.texts({"readers",
            "Names or patterns of the agents that read the topic; the writer itself never does.",
            "[NAME0]", hal::files::config::kMustBeGiven},
           c.readers);
}

/// The group of an agent.
const Group& group_of(const Scenario& scenario, hal::AgentId agent) {
  return *std::ranges::find_if(scenario.groups, [&](const Group& group) {
    return std::ranges::count(group.agents, agent) > 0;
  });
}

/// Warns of a reader in another DDS domain, which never hears of the writers.
void check_domain(Mapping& in, const Group& writers, const std::vector<hal::AgentId>& readers,
                  const Scenario& scenario) {
  for (const hal::AgentId reader : readers) {
    const std::uint32_t domain = group_of(scenario, reader).dds.domain;
    if (domain == writers.dds.domain) continue;
    in.warn("readers", fmt::format("{} is in DDS domain {}, and the writers are in {}",
                                   declared(reader, scenario).name, domain, writers.dds.domain));
    return;
  }
}

bool has_network(const Scenario& scenario, hal::AgentId agent) {
  return declared(agent, scenario).network.has_value();
}

void check_readers(Mapping& in, const TopicItem& item, const Group& group,
                   const Scenario& scenario) {
  if (item.readers.empty()) in.mistake("readers", "no agent reads the topic: give at least one");
  for (const std::string& name : item.readers) {
    const std::vector<hal::AgentId> agents = agents_meant(in, "readers", name, scenario);
    const bool is_there = std::ranges::any_of(
        agents, [&](hal::AgentId agent) { return has_network(scenario, agent); });
    if (!agents.empty() && !is_there)
      in.mistake("readers", fmt::format("'{}' has no network to read by", name));
    check_domain(in, group, agents, scenario);
  }
}

/// Notes topics that one agent of the group would write twice.
void check_names(std::vector<Mapping>& items, const Group& group) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string& name = group.topics[i].name;
    if (group.topics[i].is_recorded()) continue;
    if (!names.insert(name).second)
      items[i].mistake("name", fmt::format("the group writes '{}' already", name));
  }
}

Program player_of(const Group& group) {
  const bool is_cyclone = group.dds.vendor == DdsVendor::kCycloneDds;
  Program player{
      .name = "topics",
      .command = {is_cyclone ? "baraka-topics-cyclonedds" : "baraka-topics-fastdds",
                  fmt::format("{}/{}", kResultsWord, topic_plan_file(std::string(kAgentWord)))},
      .start = group.dds.start,
      .log = fmt::format("{}.topics.log", kAgentWord),
      .on_exit = OnExit::kFail,
      .is_shipped = true};
  if (!group.places.empty()) player.place = group.places.front();
  if (!group.topics.empty()) player.place = group.topics.front().place;
  if (group.dds.profile.empty()) return player;
  const std::string file = group.dds.profile.string();
  player.shown = {file};
  if (is_cyclone) {
    player.environment = {{"CYCLONEDDS_URI", "file://" + file}};
  } else {
    player.environment = {{"FASTRTPS_DEFAULT_PROFILES_FILE", file}};
  }
  return player;
}

}  // namespace

void topics_keys(Fields& io, Group& group) {
  io.inside({"dds",
             "How the participants of the group's agents are made, to write and to read "
             "`topics`: one for each agent, unless `participants` says otherwise."},
            [&](Fields& dds) { dds_keys(dds, group.dds); });
  io.list_if_any<TopicItem>(
      {"topics",
       "Topics that each agent of the group writes by DDS over its network, without programs of "
       "one's own.",
       "[{name: 'rt/{agent}/scan', size: 8 kB, rate: 10 Hz, readers: [NAME0]}]"},
      group.topics, [](Fields& one, TopicItem& item) { topic_keys(one, item); });
}

void find_topics(Mapping& in, Scenario& scenario) {
  Mapping agents = in.within("agents");
  for (const Group& group : scenario.groups) {
    if (group.topics.empty()) continue;
    std::vector<Mapping> items = agents.within(group.name).items("topics");
    if (items.size() != group.topics.size()) continue;  // a mistake that was noted before
    for (std::size_t i = 0; i < items.size(); ++i)
      check_readers(items[i], group.topics[i], group, scenario);
    check_names(items, group);
  }
  for (Group& group : scenario.groups) {
    const bool plays = std::ranges::any_of(
        group.agents, [&](hal::AgentId agent) { return has_topics(scenario, group, agent); });
    if (plays) group.player = player_of(group);
  }
}

}  // namespace sim::scenario
