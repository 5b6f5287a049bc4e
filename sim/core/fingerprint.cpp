#include "sim/core/fingerprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace sim {

std::string_view name(Part part) {
  constexpr std::string_view kNames[kPartCount] = {"air", "bodies", "exchange", "routing"};
  return kNames[static_cast<int>(part)];
}

void Hash::add(std::string_view text) { add_bytes(text.data(), text.size()); }

void Hash::add_bytes(const void* data, std::size_t size) {
  add(static_cast<std::uint64_t>(size));
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, std::min<std::size_t>(8, size - i));
    add(word);
  }
}

Hash& Fingerprint::at(Part part, hal::AgentId agent, hal::Time time) {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  std::vector<Current>& of_part = current_[static_cast<std::size_t>(part)];
  if (agent.value >= of_part.size()) of_part.resize(agent.value + 1u);
  Current& current = of_part[agent.value];
  const std::int64_t second = hal::to_ns(time) / kNanosecondsPerSecond;
  if (current.hash == nullptr || current.second != second) {
    current = {second, &hashes_[{second, part, agent}]};
  }
  current.hash->add(hal::to_ns(time));
  return *current.hash;
}

std::vector<Fingerprint::Row> Fingerprint::rows() const {
  std::vector<Row> rows;
  rows.reserve(hashes_.size());
  for (const auto& [key, hash] : hashes_) {
    rows.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), hash.value()});
  }
  return rows;
}

std::array<std::uint64_t, kPartCount> Fingerprint::parts() const {
  std::array<Hash, kPartCount> sums;
  for (const auto& [key, hash] : hashes_) {
    const auto& [second, part, agent] = key;
    Hash& sum = sums[static_cast<std::size_t>(part)];
    sum.add(second);
    sum.add(std::uint64_t{agent.value});
    sum.add(hash.value());
  }
  std::array<std::uint64_t, kPartCount> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = sums[i].value();
  return values;
}

std::uint64_t Fingerprint::total() const {
  Hash sum;
  for (const std::uint64_t part : parts()) sum.add(part);
  return sum.value();
}

std::string to_hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

}  // namespace sim
