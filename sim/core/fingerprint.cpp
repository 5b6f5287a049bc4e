#include "sim/core/fingerprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "hal/types/enum_names.h"

namespace sim {

namespace {

constexpr std::string_view name_of(Part part) {
  switch (part) {
    case Part::kAir:
      return "air";
    case Part::kBodies:
      return "bodies";
    case Part::kExchange:
      return "exchange";
    case Part::kRouting:
      return "routing";
  }
  return {};
}
static_assert(hal::names_exactly<Part, kPartCount>([](Part p) { return name_of(p); }));

/// Calls visit(word) for each eight bytes; the last word is filled up with zeros.
template <class Visit>
void for_each_word(const void* data, std::size_t size, Visit visit) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t word = 0;
  for (; size >= sizeof word; size -= sizeof word, bytes += sizeof word) {
    std::memcpy(&word, bytes, sizeof word);
    visit(word);
  }
  if (size == 0) return;
  word = 0;
  std::memcpy(&word, bytes, size);
  visit(word);
}

}  // namespace

std::string_view name(Part part) { return name_of(part); }

void Hash::add_bytes(const void* data, std::size_t size) {
  add(static_cast<std::uint64_t>(size));
  for_each_word(data, size, [this](std::uint64_t word) { add(word); });
}

void Fingerprint::Cell::add_bytes(const void* data, std::size_t size) {
  add(static_cast<std::uint64_t>(size));
  for_each_word(data, size, [this](std::uint64_t word) { add(word); });
}

Fingerprint::Cell& Fingerprint::at(Part part, hal::AgentId agent, hal::Time time) {
  const std::int64_t ns = hal::to_ns(time);
  const bool is_recent = recent_ != nullptr && ns >= recent_begin_ && ns - recent_begin_ < kSecond;
  if (!is_recent) open_second_of(ns);
  std::vector<Cell>& cells = (*recent_)[static_cast<std::size_t>(part)];
  if (agent.value >= cells.size()) {
    cells.resize(std::max<std::size_t>(agent.value + 1u, largest_));
    largest_ = std::max(largest_, cells.size());
  }
  Cell& cell = cells[agent.value];
  cell.is_used_ = true;
  cell.since_start_.add(ns);
  cell.within_second_.add(ns - recent_begin_);
  return cell;
}

/// Makes the second to which an observation counts the recent one.
void Fingerprint::open_second_of(std::int64_t ns) {
  const std::int64_t second = std::max(ns / kSecond, first_open_);
  if (second - kLateness > first_open_) close_before(second - kLateness);
  const auto place = static_cast<std::size_t>(second - first_open_);
  if (place >= open_.size()) open_.resize(place + 1);
  recent_ = &open_[place];  // remains where it is until it is closed
  recent_begin_ = second * kSecond;
}

void Fingerprint::finish() {
  if (!open_.empty()) close_before(first_open_ + static_cast<std::int64_t>(open_.size()));
}

template <class Visit>
void Fingerprint::for_each(const Second& second, Visit visit) {
  for (std::size_t part = 0; part < second.size(); ++part) {
    for (std::size_t agent = 0; agent < second[part].size(); ++agent) {
      const Cell& cell = second[part][agent];
      if (!cell.is_used_) continue;
      visit(static_cast<Part>(part), hal::AgentId{static_cast<std::uint16_t>(agent)}, cell);
    }
  }
}

void Fingerprint::close_before(std::int64_t second) {
  recent_ = nullptr;
  for (; first_open_ < second && !open_.empty(); ++first_open_) {
    const Second closed = std::move(open_.front());
    open_.pop_front();
    hand_over(first_open_, closed);
  }
  if (first_open_ >= second) return;
  end_rows(first_open_);
  first_open_ = second;
}

/// Writes that nothing is observed from this second on.
void Fingerprint::end_rows(std::int64_t second) { hand_over(second, {}); }

void Fingerprint::hand_over(std::int64_t number, const Second& second) {
  add(sums_, number, second);
  for (std::size_t part = 0; part < kPartCount; ++part) {
    const std::vector<Cell>& cells = second[part];
    auto& last = last_[part];
    if (last.size() < cells.size()) last.resize(cells.size());
    for (std::size_t agent = 0; agent < last.size(); ++agent) {
      std::optional<std::uint64_t> hash;
      if (agent < cells.size() && cells[agent].is_used_) hash = cells[agent].within_second_.value();
      if (hash == last[agent]) continue;
      last[agent] = hash;
      sink_(
          {number, static_cast<Part>(part), hal::AgentId{static_cast<std::uint16_t>(agent)}, hash});
    }
  }
}

void Fingerprint::add(Sums& sums, std::int64_t second, const Second& observed) {
  for_each(observed, [&](Part part, hal::AgentId agent, const Cell& cell) {
    Hash& sum = sums[static_cast<std::size_t>(part)];
    sum.add(second);
    sum.add(std::uint64_t{agent.value});
    sum.add(cell.since_start_.value());
  });
}

std::array<std::uint64_t, kPartCount> Fingerprint::parts() const {
  Sums sums = sums_;
  std::int64_t second = first_open_;
  for (const Second& observed : open_) add(sums, second++, observed);
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
