#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace results::report {

/// The data of one run that the report needs, read from its file. Agents are given by address.
struct RunResult {
  struct Agent {
    int agent = 0;
    std::string name;
    bool is_robot = false;
    double x = 0, y = 0;  ///< Place at the start, m
  };
  struct Body {
    double path = 0;                  ///< Distance travelled, m
    std::optional<double> clearance;  ///< m, see the table `bodies`
    double x = 0, y = 0;              ///< Last place, m
    std::optional<std::uint64_t> wall_steps, object_steps;
  };
  /// A box seen from above: lengths in metres, angle in radians.
  struct Wall {
    std::string name;
    double x = 0, y = 0, yaw = 0;       ///< Centre; direction of the box's own x axis.
    double length_x = 0, length_y = 0;  ///< Along the box's own axes.
  };
  /// A robot's place at one time.
  struct Place {
    double at = 0;        ///< s
    double x = 0, y = 0;  ///< m
  };
  /// A message to one agent that arrived.
  struct Delivery {
    double delay = 0;                  ///< s
    std::int64_t delay_ns = 0;         ///< The same in ns, exact.
    std::optional<int> transmissions;  ///< Number of transmissions on its way.
  };

  /// Messages to one agent that arrived after a given number of transmissions.
  struct Hops {
    std::uint64_t messages = 0;
    std::optional<std::int64_t> least_delay_ns;
  };

  /// Frames of a class at other radios, see the table `verdict_sums`.
  struct FrameVerdict {
    std::string kind;  ///< Class of the frame.
    bool addressed = false;
    std::string verdict;
    std::uint64_t count = 0;
  };
  /// Frames that a radio should have received, from a transmitter of which it noticed some frames.
  struct LinkVerdict {
    int from = 0, to = 0;
    std::string verdict;
    std::uint64_t count = 0;
  };

  /// A DDS topic of programs on agents with a network.
  struct AirTopic {
    std::string topic;  ///< Empty: SEDP did not announce it on the air.
    std::uint64_t samples = 0, delivered = 0, first_try = 0, repaired = 0;  ///< See `air_topics`.
    std::int64_t airtime_ns = 0;
    std::map<std::int64_t, std::uint64_t> latencies{};  ///< Samples by lower edge of the bin [ns].
  };
  /// Use of the air by one kind of frame or submessage.
  struct AirKind {
    std::string purpose, kind;
    std::optional<int> port;
    std::uint64_t frames = 0, retries = 0, submessages = 0;  ///< Submessages include repeated ones.
    std::uint64_t bits = 0;
    std::int64_t airtime_ns = 0;
  };
  struct AirSecond {
    std::int64_t second = 0;
    std::string purpose, kind;
    std::int64_t airtime_ns = 0;
  };

  /// Frames that an access point had to relay to an agent or to everyone, see the tables `relays`
  /// and `relay_queues`.
  struct Relay {
    int access_point = 0, destination = 0;
    std::map<std::string, std::uint64_t> verdicts{};
    std::uint64_t queued = 0, most = 0;
    std::int64_t waited_ns = 0;
  };
  /// A queue of an agent for one receiver and access category, see the tables `station_queues` and
  /// `station_queue_drops`.
  struct Queue {
    int agent = 0, receiver = 0;
    std::string category;
    std::uint64_t frames = 0, waiting = 0, most = 0, most_bytes = 0;
    std::int64_t waited_ns = 0;
    std::map<std::string, std::uint64_t> drops{};  ///< By verdict.
  };
  /// Summary of one named value of one agent: recorded by its controller, or an observable.
  struct Values {
    /// The agent's name; the value's name as in reports; its unit, "": none.
    std::string agent, name, unit;
    std::uint64_t count = 0;
    std::optional<double> mean{}, least{}, most{}, last{};  ///< None: there was no value.
  };
  /// A state that an agent's controller named.
  struct State {
    std::string agent, state;
    std::uint64_t entries = 0;
    double first = 0;  ///< s
  };
  /// Number of lost samples; for `agent` see the table `sample_losses`.
  struct SampleLossCount {
    std::string topic, verdict;
    int agent = 0;
    std::uint64_t count = 0;
  };

  std::string folder;
  std::map<std::string, std::string> values;    ///< The table `run`.
  std::map<std::string, std::string> settings;  ///< The table `settings`.
  std::vector<Agent> agents;
  std::map<int, Body> bodies;
  std::vector<Wall> walls;
  std::map<int, std::vector<Place>> tracks;  ///< Places of each robot, sorted by time.
  std::vector<std::pair<int, int>> links;
  std::vector<FrameVerdict> frame_verdicts;
  std::vector<LinkVerdict> link_verdicts;  ///< Sorted by link.
  std::map<int, std::uint64_t> packets;    ///< Frames passed to the network layer, by agent.
  std::uint64_t messages = 0;              ///< Messages to one agent.
  std::uint64_t delivered = 0;             ///< Number of those that were delivered.
  std::map<int, Hops> hops;  ///< The delivered ones by number of transmissions; 0: not known.
  std::vector<Delivery> deliveries;  ///< The delivered ones; empty if messages are not listed.
  std::uint64_t floods = 0, flood_deliveries = 0;  ///< Messages that routing floods.
  /// Messages to everyone in radio range, which nobody relays.
  std::uint64_t broadcasts = 0, broadcast_deliveries = 0;
  std::map<std::string, std::uint64_t> verdicts;  ///< Messages to one agent by verdict.
  std::vector<std::int64_t> discoveries_ns;       ///< Durations of searches that found a route.
  std::uint64_t discoveries_failed = 0;
  std::map<std::string, std::uint64_t> routing_events;  ///< Sums over all agents.
  std::vector<AirTopic> air_topics;                     ///< Sorted by name.
  std::vector<AirKind> air_kinds;      ///< Longest air time first; empty: no agent has a network.
  std::vector<AirSecond> air_seconds;  ///< Sorted by second.
  std::vector<Relay> relays;           ///< Sorted by access point and destination.
  std::vector<Queue> queues{};         ///< By agent, receiver and category.
  std::vector<SampleLossCount> sample_losses;
  std::vector<Values> recorded;     ///< By controllers; sorted by name and agent.
  std::vector<Values> observables;  ///< Of `record: {observables: …}`; sorted by name and agent.
  std::vector<State> states;        ///< Sorted by agent and time of the first entry.
  std::optional<int> goal;          ///< The agent whose state ended the run.

  /// Value of a key of the table `run`; "" if the key is not there.
  std::string value(const std::string& key) const;
  /// The same as a number; 0 if the key is not there.
  double number(const std::string& key) const;
  /// How the run ended, for display; "unfinished" if it did not record an end.
  std::string ending() const;
  /// Whether the run counted messages, and whether it routed them.
  bool counts_messages() const { return !has_setting("record.messages", "none"); }
  bool has_routing() const { return !has_setting("routing", "none"); }
  bool has_setting(const std::string& key, const std::string& value) const;
  /// Whether each delivery is in `deliveries`.
  bool lists_deliveries() const { return deliveries.size() == delivered; }
  /// Whether the run was neither interrupted nor did it fail, so that its figures may be pooled.
  bool is_complete() const;
};

/// Reads `run.sqlite` in a folder.
/// @throws std::runtime_error if it is missing, damaged or of another version.
RunResult read_run(const std::filesystem::path& folder);

/// The folders that hold a result: each given folder, or else the result folders inside it, shorter
/// names first, then by name. Of the latter, earlier results beside their successors and attempts
/// that did not start are left out.
/// @throws std::runtime_error if a given folder holds no result.
std::vector<std::filesystem::path> find_results(const std::vector<std::filesystem::path>& folders);

}  // namespace results::report
