#include "hal/files/recording/collector.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>

namespace hal::files::recording {
namespace {

using Qos = TopicQos;

void join(std::optional<Qos>& joined, const Qos& other) {
  if (!joined) {
    joined = other;
    return;
  }
  joined->reliability = std::max(joined->reliability, other.reliability);
  joined->durability = std::max(joined->durability, other.durability);
}

}  // namespace

std::string dds_name(std::string_view topic) {
  if (topic.starts_with("rt/")) return std::string(topic);
  return fmt::format("rt{}{}", topic.starts_with('/') ? "" : "/", topic);
}

std::size_t Collector::topic(std::string_view name, std::string_view type,
                             const std::optional<OfferedQos>& offered) {
  auto found = numbers_.find(name);
  if (found == numbers_.end()) {
    found = numbers_.emplace(name, topics_.size()).first;
    topics_.push_back({{.name = std::string(name), .type = {}, .qos = {}, .samples = {}}, {}});
  }
  RecordedTopic& told = topics_[found->second].told;
  if (told.type.empty()) told.type = type;
  if (offered) {
    if (!told.qos && !offered->tells_depth) ++without_depth_;
    join(told.qos, offered->qos);
  }
  return found->second;
}

void Collector::participants(std::size_t topic, std::optional<std::uint32_t> writer,
                             std::optional<std::uint32_t> reader) {
  RecordedTopic& told = topics_[topic].told;
  if (!told.writer) told.writer = writer;
  if (!told.reader) told.reader = reader;
}

void Collector::count() {
  if (++samples_ > kMostSamples)
    throw std::runtime_error(fmt::format("there are more than {} samples", kMostSamples));
}

void Collector::add(std::size_t topic, std::int64_t at, std::uint32_t bytes) {
  count();
  topics_[topic].instants.push_back({at, bytes});
}

void Collector::add_datagram(std::uint16_t port, std::int64_t at, std::uint32_t bytes) {
  count();
  flows_[port].push_back({at, bytes});
}

Recording Collector::finish() {
  std::int64_t first = std::numeric_limits<std::int64_t>::max(), last = 0;
  const auto in_order = [&](std::vector<Instant>& instants) {
    std::ranges::stable_sort(instants, {}, &Instant::at);
    if (instants.empty()) return;
    first = std::min(first, instants.front().at);
    last = std::max(last, instants.back().at);
  };
  for (Topic& topic : topics_) in_order(topic.instants);
  for (auto& [port, instants] : flows_) in_order(instants);
  const auto to_samples = [first](const std::vector<Instant>& instants) {
    std::vector<RecordedSample> samples;
    samples.reserve(instants.size());
    for (const Instant& one : instants) samples.push_back({Duration(one.at - first), one.bytes});
    return samples;
  };
  Recording recording;
  if (samples_ > 0) recording.length = Duration(last - first);
  for (Topic& topic : topics_) {
    topic.told.samples = to_samples(topic.instants);
    recording.topics.push_back(std::move(topic.told));
  }
  for (const auto& [port, instants] : flows_)
    recording.flows.push_back({port, to_samples(instants)});
  recording.notes = std::move(notes_);
  constexpr Duration kLong = std::chrono::hours(24 * 7);
  if (recording.length > kLong) {
    recording.notes.push_back(
        fmt::format("from the first sample to the last are {} days: its time stamps may be of "
                    "different clocks",
                    std::chrono::duration_cast<std::chrono::hours>(recording.length).count() / 24));
  }
  if (without_depth_ > 0) {
    recording.notes.push_back(fmt::format(
        "{} topic{}: the depth of the history is not recorded, for DDS does not announce it; {} is "
        "ROS 2's default",
        without_depth_, without_depth_ == 1 ? "" : "s", *TopicQos{}.depth));
  }
  return recording;
}

}  // namespace hal::files::recording
