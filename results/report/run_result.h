#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace results::report {

/// What the report needs of one run, as read from its file. Agents are addresses.
struct RunResult {
  struct Agent {
    int agent = 0;
    std::string name;
    bool is_robot = false;
    double x = 0, y = 0;  ///< m, at the start
  };
  struct Body {
    double path = 0;                  ///< m
    std::optional<double> clearance;  ///< m
    double x = 0, y = 0;              ///< m, last
    std::optional<std::uint64_t> wall_steps, object_steps;
  };
  /// A box seen from above: lengths in metres, angle in radians.
  struct Wall {
    std::string name;
    double x = 0, y = 0, yaw = 0;       ///< Middle; its own x axis.
    double length_x = 0, length_y = 0;  ///< Along its own axes.
  };
  /// Where a robot was.
  struct Place {
    double at = 0;        ///< s
    double x = 0, y = 0;  ///< m
  };
  /// A message to one agent that arrived.
  struct Delivery {
    double delay = 0;                  ///< s
    std::int64_t delay_ns = 0;         ///< The same, exact.
    std::optional<int> transmissions;  ///< On its way.
  };

  /// Messages to one agent that arrived after so many transmissions.
  struct Hops {
    std::uint64_t messages = 0;
    std::optional<std::int64_t> least_delay_ns;
  };

  /// Frames of a class at other radios, see the table verdict_sums.
  struct FrameVerdict {
    std::string kind;  ///< Class of the frame.
    bool addressed = false;
    std::string verdict;
    std::uint64_t count = 0;
  };
  /// Frames to one agent or to everyone at a radio that noticed some of their transmitter's.
  struct LinkVerdict {
    int from = 0, to = 0;
    std::string verdict;
    std::uint64_t count = 0;
  };

  /// A topic that programs on agents with a network exchanged samples of.
  struct AirTopic {
    std::string topic;  ///< Empty: not told of on the air.
    std::uint64_t samples = 0, delivered = 0, first_try = 0, repaired = 0;  ///< See air_topics.
    std::int64_t airtime_ns = 0;
    std::map<std::int64_t, std::uint64_t> latencies{};  ///< By lower edge of the bin [ns].
  };
  /// What the air was used for.
  struct AirKind {
    std::string purpose, kind;
    std::optional<int> port;
    std::uint64_t frames = 0, retries = 0, submessages = 0;  ///< The last with those in retries.
    std::uint64_t bits = 0;
    std::int64_t airtime_ns = 0;
  };
  struct AirSecond {
    std::int64_t second = 0;
    std::string purpose, kind;
    std::int64_t airtime_ns = 0;
  };

  /// What an access point had to pass on to an agent, or to everyone: relays and relay_queues.
  struct Relay {
    int access_point = 0, destination = 0;
    std::map<std::string, std::uint64_t> verdicts{};
    std::uint64_t queued = 0, most = 0;
    std::int64_t waited_ns = 0;
  };
  /// Values of one name of one agent: what its controller recorded, or an observable.
  struct Values {
    std::string agent, name, unit;  ///< Name of the agent; as reports know the value; "": no unit.
    std::uint64_t count = 0;
    std::optional<double> mean{}, least{}, most{}, last{};  ///< None: there was no value.
  };
  /// A state that an agent's controller named.
  struct State {
    std::string agent, state;
    std::uint64_t entries = 0;
    double first = 0;  ///< s
  };
  /// Samples that did not come; agent: as in sample_losses.
  struct SampleLossCount {
    std::string topic, verdict;
    int agent = 0;
    std::uint64_t count = 0;
  };

  std::string folder;
  std::map<std::string, std::string> values;    ///< The table run.
  std::map<std::string, std::string> settings;  ///< The table settings.
  std::vector<Agent> agents;
  std::map<int, Body> bodies;
  std::vector<Wall> walls;
  std::map<int, std::vector<Place>> tracks;  ///< Of the robots, by time.
  std::vector<std::pair<int, int>> links;
  std::vector<FrameVerdict> frame_verdicts;
  std::vector<LinkVerdict> link_verdicts;  ///< By link.
  std::map<int, std::uint64_t> packets;    ///< Frames that went up to the network layer, by agent.
  std::uint64_t messages = 0;              ///< To one agent.
  std::uint64_t delivered = 0;             ///< So many of them.
  std::map<int, Hops> hops;                ///< Of these, by transmissions; 0: not known.
  std::vector<Delivery> deliveries;        ///< Of these, too; empty if messages are not listed.
  std::uint64_t floods = 0, flood_deliveries = 0;  ///< Messages that routing floods.
  /// Messages to everyone in radio range: nobody relays them.
  std::uint64_t broadcasts = 0, broadcast_deliveries = 0;
  std::map<std::string, std::uint64_t> verdicts;  ///< Of messages to one agent.
  std::vector<std::int64_t> discoveries_ns;       ///< Those that found a route.
  std::uint64_t discoveries_failed = 0;
  std::map<std::string, std::uint64_t> routing_events;  ///< Over all agents.
  std::vector<AirTopic> air_topics;                     ///< By name.
  std::vector<AirKind> air_kinds;      ///< Most air time first; empty: nobody has a network.
  std::vector<AirSecond> air_seconds;  ///< By second.
  std::vector<Relay> relays;           ///< By access point and destination.
  std::vector<SampleLossCount> sample_losses;
  std::vector<Values> recorded;     ///< By name and agent.
  std::vector<Values> observables;  ///< What `record: {observables: …}` asked for, likewise.
  std::vector<State> states;        ///< By agent and the time of the first.
  std::optional<int> goal;          ///< The agent whose state ended the run.

  /// Value of the table run; "" if it is not there.
  std::string value(const std::string& key) const;
  /// 0 if it is not there.
  double number(const std::string& key) const;
  /// How it ended, for people: "unfinished" if it never said.
  std::string ending() const;
  /// Whether it counted messages, and whether it routes them.
  bool counts_messages() const { return !has_setting("record.messages", "none"); }
  bool has_routing() const { return !has_setting("routing", "none"); }
  bool has_setting(const std::string& key, const std::string& value) const;
  /// Whether each delivery is in `deliveries`.
  bool lists_deliveries() const { return deliveries.size() == delivered; }
  /// Whether the run came to an end of its own: its figures may be pooled with others'.
  bool is_complete() const;
};

/// Reads `run.sqlite` in a folder.
/// @throws std::runtime_error if it is missing, damaged or of another version.
RunResult read_run(const std::filesystem::path& folder);

/// The folders that hold a result: each one given, or else the ones in it, by name, short names
/// first; of those, not what was put aside: earlier results beside their successors, attempts that
/// did not start.
/// @throws std::runtime_error if one holds none.
std::vector<std::filesystem::path> find_results(const std::vector<std::filesystem::path>& folders);

}  // namespace results::report
