#pragma once

#include <cstdint>
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

/// Number of an endpoint among Endpoints::all(); 0: none, or one too many.
using EndpointIndex = std::uint32_t;

/// A writer or reader of DDS, as known from its GUID and SEDP.
struct Endpoint {
  hal::rtps::Guid guid;
  std::optional<hal::AgentId> agent;   ///< Whose programs have it; none: they sent nothing yet.
  std::uint32_t topic = 0;             ///< Number of its name; 0: not told yet.
  std::string type{};                  ///< Empty: likewise.
  std::optional<hal::Time> told_at{};  ///< When SEDP first announced it.
  bool is_reliable = false;
  std::uint32_t durability = 0;  ///< As in hal::rtps::DiscoveredEndpoint.
  std::vector<std::string> partitions{};
  bool is_gone = false;               ///< Disposed.
  std::set<hal::AgentId> known_at{};  ///< Agents that received its announcement by SEDP.
};

/// The endpoints that were seen on the air, their topics, and which of them exchange samples.
///
/// Invalid data can contain any number of GUIDs: endpoints beyond kMost, and names beyond
/// kMostTopics, are ignored. Names are truncated.
class Endpoints {
 public:
  static constexpr std::size_t kMost = 1U << 16U, kMostTopics = 1U << 12U;
  static constexpr std::size_t kLongestName = 256;    ///< Octets: the rest of it is not kept.
  static constexpr std::size_t kMostPartitions = 16;  ///< Of an endpoint: of more the first.

  Endpoints();

  /// @return the number of this one; new if it has not been seen.
  EndpointIndex of(const hal::rtps::Guid& guid);
  /// What was sent from there, and not passed on, has this source.
  void place(const hal::rtps::GuidPrefix& participant, hal::AgentId agent);
  std::optional<hal::AgentId> agent_of(const hal::rtps::GuidPrefix& participant) const;

  /// SEDP told of one.
  EndpointIndex learn(hal::Time at, const hal::rtps::DiscoveredEndpoint& told);
  void remove(const hal::rtps::Guid& guid);
  /// SPDP's word of a participant arrived there.
  void meet(const hal::rtps::GuidPrefix& participant, hal::AgentId agent);
  /// What a SEDP writer told of an endpoint arrived there. Of a participant that is not known there
  /// nobody listens to it.
  void reach(EndpointIndex endpoint, EndpointIndex told_by, hal::AgentId agent);

  /// Agents other than the writer's with a reader to which it sends its samples: same topic and
  /// type, compatible reliability and durability, a common partition by name, and the announcement
  /// of the reader has arrived at the writer's agent; for a pair that is not reliable, also that of
  /// the writer at the reader's.
  std::vector<hal::AgentId> readers_of(EndpointIndex writer) const;

  /// Those that SEDP told of since the last call, or whose agent became known.
  std::vector<EndpointIndex> take_told() { return std::exchange(told_, {}); }

  const std::vector<Endpoint>& all() const { return all_; }           ///< From 1 on.
  const std::vector<std::string>& topics() const { return topics_; }  ///< From 1 on; 0 is "".

 private:
  std::uint32_t topic_called(std::string_view name);

  std::vector<Endpoint> all_;
  std::vector<EndpointIndex> told_;
  std::map<hal::rtps::Guid, EndpointIndex> indices_;
  std::map<hal::rtps::GuidPrefix, hal::AgentId> participants_;
  std::map<hal::rtps::GuidPrefix, std::vector<EndpointIndex>> unplaced_;
  std::set<std::pair<hal::rtps::GuidPrefix, hal::AgentId>> met_;  ///< Where they are known.
  std::vector<std::string> topics_;
  std::map<std::string, std::uint32_t, std::less<>> topic_numbers_;
  std::map<std::uint32_t, std::vector<EndpointIndex>> readers_;  ///< By topic.
};

}  // namespace sim::air
