#include "sim/air/endpoints.h"

#include <algorithm>
#include <utility>

namespace sim::air {
namespace {

using hal::rtps::DiscoveredEndpoint;
using hal::rtps::Guid;

constexpr std::uint32_t kReliable = 2;

std::vector<std::string> to_partitions(const DiscoveredEndpoint& told) {
  std::vector<std::string> names;
  hal::rtps::Cursor cursor(told.partitions, told.endianness);
  const std::size_t count = std::min<std::size_t>(cursor.u32(), Endpoints::kMostPartitions);
  for (std::size_t i = 0; i < count && !cursor.is_short(); ++i) {
    const std::uint32_t length = cursor.u32();
    const hal::rtps::Octets text = cursor.take(length);
    cursor.take(std::min<std::size_t>((4 - length % 4) % 4, cursor.left()));
    if (text.empty()) continue;
    const std::size_t size = std::min(text.size() - 1, Endpoints::kLongestName);
    names.emplace_back(reinterpret_cast<const char*>(text.data()), size);
  }
  return names;
}

bool share_a_partition(const Endpoint& a, const Endpoint& b) {
  if (a.partitions.empty() || b.partitions.empty()) return a.partitions == b.partitions;
  return std::ranges::any_of(a.partitions, [&b](const std::string& name) {
    return std::ranges::find(b.partitions, name) != b.partitions.end();
  });
}

bool match(const Endpoint& writer, const Endpoint& reader) {
  return !reader.is_gone && writer.type == reader.type &&
         (writer.is_reliable || !reader.is_reliable) && writer.durability >= reader.durability &&
         share_a_partition(writer, reader);
}

}  // namespace

Endpoints::Endpoints() : all_(1), topics_(1) {}

EndpointIndex Endpoints::of(const Guid& guid) {
  const auto found = indices_.find(guid);
  if (found != indices_.end()) return found->second;
  if (all_.size() >= kMost) return 0;
  const auto index = static_cast<EndpointIndex>(all_.size());
  indices_.emplace(guid, index);
  all_.push_back({.guid = guid, .agent = agent_of(guid.prefix)});
  if (!all_.back().agent) unplaced_[guid.prefix].push_back(index);
  return index;
}

void Endpoints::place(const hal::rtps::GuidPrefix& participant, hal::AgentId agent) {
  if (participants_.size() >= kMost || !participants_.emplace(participant, agent).second) return;
  const auto waiting = unplaced_.find(participant);
  if (waiting == unplaced_.end()) return;
  for (const EndpointIndex index : waiting->second) {
    all_[index].agent = agent;
    if (all_[index].topic != 0) tell(index);
  }
  unplaced_.erase(waiting);
}

std::optional<hal::AgentId> Endpoints::agent_of(const hal::rtps::GuidPrefix& participant) const {
  const auto found = participants_.find(participant);
  if (found == participants_.end()) return std::nullopt;
  return found->second;
}

void Endpoints::meet(const hal::rtps::GuidPrefix& participant, hal::AgentId agent) {
  if (met_.size() < kMost) met_.emplace(participant, agent);
}

void Endpoints::reach(EndpointIndex endpoint, EndpointIndex told_by, hal::AgentId agent) {
  if (met_.contains({all_[told_by].guid.prefix, agent})) all_[endpoint].known_at.insert(agent);
}

std::uint32_t Endpoints::topic_called(std::string_view name) {
  name = name.substr(0, kLongestName);
  const auto found = topic_numbers_.find(name);
  if (found != topic_numbers_.end()) return found->second;
  if (name.empty() || topics_.size() >= kMostTopics) return 0;
  const auto number = static_cast<std::uint32_t>(topics_.size());
  topics_.emplace_back(name);
  topic_numbers_.emplace(name, number);
  return number;
}

EndpointIndex Endpoints::learn(hal::Time at, const DiscoveredEndpoint& told) {
  const EndpointIndex index = of(told.guid);
  if (index == 0 || told.topic.empty()) return index;
  Endpoint& endpoint = all_[index];
  const bool is_new = endpoint.topic == 0;
  endpoint.topic = topic_called(told.topic);
  endpoint.type = told.type.substr(0, kLongestName);
  // Defaults: a writer is reliable, a reader is not (OMG DDS 1.4, 2.2.3).
  endpoint.is_reliable =
      told.reliability == kReliable || (told.reliability == 0 && told.guid.entity.is_writer());
  endpoint.durability = told.durability;
  endpoint.partitions = to_partitions(told);
  endpoint.is_gone = false;
  if (!endpoint.told_at) endpoint.told_at = at;
  if (is_new && endpoint.topic != 0 && told.guid.entity.is_reader())
    readers_[endpoint.topic].push_back(index);
  if (is_new) tell(index);
  return index;
}

void Endpoints::tell(EndpointIndex endpoint) {
  told_.push_back(endpoint);
  if (on_told_) on_told_(endpoint);
}

void Endpoints::remove(const Guid& guid) {
  const auto found = indices_.find(guid);
  if (found != indices_.end()) all_[found->second].is_gone = true;
}

std::vector<hal::AgentId> Endpoints::readers_of(EndpointIndex writer) const {
  std::vector<hal::AgentId> agents;
  const Endpoint& from = all_[writer];
  const auto readers = readers_.find(from.topic);
  if (from.topic == 0 || readers == readers_.end() || !from.agent) return agents;
  for (const EndpointIndex index : readers->second) {
    const Endpoint& reader = all_[index];
    const bool is_elsewhere = reader.agent && *reader.agent != *from.agent;
    if (!is_elsewhere || !match(from, reader)) continue;
    // Samples from before a reliable reader knew the writer are repaired once it does.
    const bool is_patient = from.is_reliable && reader.is_reliable;
    if (!reader.known_at.contains(*from.agent)) continue;
    if (!is_patient && !from.known_at.contains(*reader.agent)) continue;
    if (std::ranges::find(agents, *reader.agent) == agents.end()) agents.push_back(*reader.agent);
  }
  std::ranges::sort(agents);
  return agents;
}

}  // namespace sim::air
