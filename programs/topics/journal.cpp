#include "programs/topics/journal.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace programs::topics {

using nlohmann::json;

namespace {

/// A row of the journal with its counts.
template <class Count>
json with(json row, const Count& count) {
  row["samples"] = count.samples;
  if constexpr (requires { count.refused; }) {
    row["refused"] = count.refused;
    row["latest_ns"] = count.latest_ns;
  } else {
    row["first_ns"] = count.first_ns;
    row["last_ns"] = count.last_ns;
  }
  return row;
}

}  // namespace

Journal::Journal(std::string participant) : participant_(std::move(participant)) {}

void Journal::wrote(const std::string& topic, bool was_accepted, std::int64_t late_ns) {
  const std::lock_guard lock(mutex_);
  if (is_closed_) return;
  Written& count = written_[topic];
  ++(was_accepted ? count.samples : count.refused);
  count.latest_ns = std::max(count.latest_ns, late_ns);
}

void Journal::sent(std::uint16_t port, bool was_accepted) {
  const std::lock_guard lock(mutex_);
  if (is_closed_) return;
  Written& count = sent_[port];
  ++(was_accepted ? count.samples : count.refused);
}

void Journal::received_datagram(std::uint16_t port, const std::string& sender, std::int64_t at_ns) {
  const std::lock_guard lock(mutex_);
  if (!is_closed_) datagrams_[{port, sender}].add(at_ns);
}

void Journal::received(const std::string& topic, const std::string& writer, std::int64_t at_ns) {
  const std::lock_guard lock(mutex_);
  if (!is_closed_) received_[{topic, writer}].add(at_ns);
}

void Journal::add_written(const std::string& topic) {
  const std::lock_guard lock(mutex_);
  written_.try_emplace(topic);
}

std::string Journal::close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  json out = {{"participant", participant_},
              {"written", json::array()},
              {"received", json::array()},
              {"datagrams_sent", json::array()},
              {"datagrams_received", json::array()}};
  for (const auto& [topic, count] : written_)
    out["written"].push_back(with(json{{"topic", topic}}, count));
  for (const auto& [from, count] : received_)
    out["received"].push_back(with(json{{"topic", from.first}, {"writer", from.second}}, count));
  for (const auto& [port, count] : sent_)
    out["datagrams_sent"].push_back(with(json{{"port", port}}, count));
  for (const auto& [from, count] : datagrams_)
    out["datagrams_received"].push_back(
        with(json{{"port", from.first}, {"sender", from.second}}, count));
  return out.dump(1) + "\n";
}

std::string joined(const std::vector<std::string>& journals) {
  json all = json::object();
  for (const std::string& text : journals) {
    if (text.empty()) continue;
    const json one = json::parse(text);
    for (const auto& [key, value] : one.items()) {
      json& into = all[key];
      if (!value.is_array() || into.is_null()) {
        into = value;
      } else {
        into.insert(into.end(), value.begin(), value.end());
      }
    }
  }
  return all.dump(1) + "\n";
}

}  // namespace programs::topics
