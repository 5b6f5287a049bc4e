#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/rtps/endpoint.h"
#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace sim::air {

/// Index into Endpoints::all(); 0: none, or more than can be kept.
using EndpointIndex = std::uint32_t;

/// A DDS writer or reader, as known from its GUID and from SEDP.
struct Endpoint {
  hal::rtps::Guid guid;
  /// Agent whose programs own it; nullopt: they have not sent anything yet.
  std::optional<hal::AgentId> agent;
  std::uint32_t topic = 0;             ///< Index of the topic's name; 0: not announced yet.
  std::string type{};                  ///< Name of the type; empty: not announced yet.
  std::optional<hal::Time> told_at{};  ///< When SEDP first announced it.
  bool is_reliable = false;
  std::uint32_t durability = 0;  ///< As in hal::rtps::DiscoveredEndpoint.
  std::vector<std::string> partitions{};
  bool is_gone = false;               ///< It was disposed of.
  std::set<hal::AgentId> known_at{};  ///< Agents that received its SEDP announcement.
};

/// The endpoints observed on the air, their topics, and which of them exchange samples.
///
/// Invalid data can contain any number of GUIDs: endpoints beyond kMost, and names beyond
/// kMostTopics, are ignored. Names are truncated.
class Endpoints {
 public:
  static constexpr std::size_t kMost = 1U << 16U, kMostTopics = 1U << 12U;
  static constexpr std::size_t kLongestName = 256;  ///< Octets; the rest is cut off.
  /// Per endpoint; any further ones are ignored.
  static constexpr std::size_t kMostPartitions = 16;

  Endpoints();

  /// @return the index of this endpoint, which is added if it is new.
  EndpointIndex of(const hal::rtps::Guid& guid);
  /// Records at which agent a participant is: the original source of its datagrams.
  void place(const hal::rtps::GuidPrefix& participant, hal::AgentId agent);
  std::optional<hal::AgentId> agent_of(const hal::rtps::GuidPrefix& participant) const;

  /// Records an endpoint that SEDP announced.
  EndpointIndex learn(hal::Time at, const hal::rtps::DiscoveredEndpoint& told);
  void remove(const hal::rtps::Guid& guid);
  /// Records that a participant's SPDP announcement was received at an agent.
  void meet(const hal::rtps::GuidPrefix& participant, hal::AgentId agent);
  /// Records that the SEDP announcement of an endpoint, sent by writer `told_by`, was received at
  /// an agent. No effect if the participant of `told_by` is not known there.
  void reach(EndpointIndex endpoint, EndpointIndex told_by, hal::AgentId agent);

  /// Agents, other than the writer's own, with a reader to which it sends its samples: same topic
  /// and type, compatible reliability and durability, a common partition by name, and the
  /// announcement of the reader has been received at the writer's agent; for a pair that is not
  /// reliable, also the announcement of the writer at the reader's agent.
  std::vector<hal::AgentId> readers_of(EndpointIndex writer) const;

  /// Endpoints that SEDP announced, or whose agent became known, since the last call.
  std::vector<EndpointIndex> take_told() { return std::exchange(told_, {}); }

  /// @param told  called with each of these at once, too.
  void set_on_told(std::function<void(EndpointIndex)> told) { on_told_ = std::move(told); }

  const std::vector<Endpoint>& all() const { return all_; }           ///< Index 0 is unused.
  const std::vector<std::string>& topics() const { return topics_; }  ///< Index 0 is "".

 private:
  std::uint32_t topic_called(std::string_view name);
  void tell(EndpointIndex endpoint);

  std::vector<Endpoint> all_;
  std::vector<EndpointIndex> told_;
  std::function<void(EndpointIndex)> on_told_;
  std::map<hal::rtps::Guid, EndpointIndex> indices_;
  std::map<hal::rtps::GuidPrefix, hal::AgentId> participants_;
  std::map<hal::rtps::GuidPrefix, std::vector<EndpointIndex>> unplaced_;
  /// Which participants are known at which agents.
  std::set<std::pair<hal::rtps::GuidPrefix, hal::AgentId>> met_;
  std::vector<std::string> topics_;
  std::map<std::string, std::uint32_t, std::less<>> topic_numbers_;
  std::map<std::uint32_t, std::vector<EndpointIndex>> readers_;  ///< By topic.
};

}  // namespace sim::air
