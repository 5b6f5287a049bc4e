#include "sim/core/fingerprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

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

Fingerprint::Cell& Fingerprint::at(Part part, hal::AgentId agent, hal::Time time) {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  std::vector<Current>& of_part = current_[static_cast<std::size_t>(part)];
  if (agent.value >= of_part.size()) of_part.resize(agent.value + 1u);
  Current& current = of_part[agent.value];
  const std::int64_t ns = hal::to_ns(time);
  const std::int64_t second = std::max(ns / kNanosecondsPerSecond, first_open_);
  if (current.second != second) {
    if (second - kLateness > first_open_) close_before(second - kLateness);
    current = {second, &open_[{second, part, agent}]};
  }
  current.cell->since_start_.add(ns);
  current.cell->within_second_.add(ns - second * kNanosecondsPerSecond);
  return *current.cell;
}

void Fingerprint::finish() {
  if (!open_.empty()) close_before(std::get<0>(open_.rbegin()->first) + 1);
}

void Fingerprint::close_before(std::int64_t second) {
  while (!open_.empty() && std::get<0>(open_.begin()->first) < second) {
    const std::int64_t next = std::get<0>(open_.begin()->first);
    if (next > first_open_) end_rows(first_open_);  // nothing happened in between
    first_open_ = next + 1;
    hand_over(next);
  }
  if (second > first_open_) end_rows(first_open_);
  first_open_ = second;
}

void Fingerprint::end_rows(std::int64_t second) {
  const auto ended = std::exchange(last_, {});
  for (const auto& [key, hash] : ended) sink_({second, key.first, key.second, std::nullopt});
}

void Fingerprint::hand_over(std::int64_t second) {
  std::vector<Row> rows;
  auto last = last_.begin();
  const auto end_row = [&] {
    rows.push_back({second, last->first.first, last->first.second, std::nullopt});
    last = last_.erase(last);
  };
  while (!open_.empty() && std::get<0>(open_.begin()->first) == second) {
    const auto cell = open_.extract(open_.begin());
    add(sums_, cell.key(), cell.mapped());
    const std::pair key{std::get<1>(cell.key()), std::get<2>(cell.key())};
    const std::uint64_t hash = cell.mapped().within_second_.value();
    while (last != last_.end() && last->first < key) end_row();
    const bool is_new = last == last_.end() || last->first != key;
    if (is_new) last = last_.emplace_hint(last, key, hash);
    if (is_new || last->second != hash) rows.push_back({second, key.first, key.second, hash});
    last->second = hash;
    ++last;
  }
  while (last != last_.end()) end_row();
  for (const Row& row : rows) sink_(row);
}

void Fingerprint::add(Sums& sums, const Key& key, const Cell& cell) {
  const auto& [second, part, agent] = key;
  Hash& sum = sums[static_cast<std::size_t>(part)];
  sum.add(second);
  sum.add(std::uint64_t{agent.value});
  sum.add(cell.since_start_.value());
}

std::array<std::uint64_t, kPartCount> Fingerprint::parts() const {
  Sums sums = sums_;
  for (const auto& [key, cell] : open_) add(sums, key, cell);
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
