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
  Current& current = current_[static_cast<std::size_t>(part)][agent.value];
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

std::uint64_t Fingerprint::part(Part part) const {
  Hash sum;
  for (const auto& [key, hash] : hashes_) {
    if (std::get<1>(key) != part) continue;
    sum.add(std::get<0>(key));
    sum.add(static_cast<std::uint64_t>(std::get<2>(key).value));
    sum.add(hash.value());
  }
  return sum.value();
}

std::uint64_t Fingerprint::total() const {
  Hash sum;
  for (int p = 0; p < kPartCount; ++p) sum.add(part(static_cast<Part>(p)));
  return sum.value();
}

std::string to_hex(std::uint64_t value) { return fmt::format("{:016x}", value); }

}  // namespace sim
