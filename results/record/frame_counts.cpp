#include "results/record/frame_counts.h"

#include <array>

#include "sim/radio/frame_class.h"

namespace results::record {
namespace {

/// What is counted of a reception, as one number.
constexpr int kAddressedBit = 4;
constexpr int kClassShift = 5;
/// In place of a verdict: the payload went up.
constexpr std::uint8_t kWentUp = (1 << kAddressedBit) - 1;
static_assert(hal::kVerdictCount <= kWentUp);
static_assert(sim::radio::kFrameClasses << kClassShift <= 1 << PairCounts::kKindBits);

std::uint8_t kind_of(const sim::radio::Frame& frame) {
  return static_cast<std::uint8_t>(sim::radio::frame_class(frame));
}

std::string_view class_in(std::uint8_t kind) {
  return sim::radio::name(static_cast<sim::radio::FrameClass>(kind));
}

std::string_view verdict_in(std::uint8_t kind) {
  return hal::name(static_cast<hal::Verdict>(kind % (1 << kAddressedBit)));
}

}  // namespace

FrameCounts::FrameCounts(Database& database)
    : put_sent_(database, "REPLACE INTO frames_sent VALUES (?, ?, ?, ?)"),
      put_reception_(database, "REPLACE INTO receptions VALUES (?, ?, ?, ?, ?, ?)"),
      put_faint_(database, "REPLACE INTO faint VALUES (?, ?)"),
      put_packet_(database, "REPLACE INTO packets VALUES (?, ?, ?, ?)"),
      put_request_(database, "REPLACE INTO requests VALUES (?, ?, ?, ?)") {}

void FrameCounts::on_frame_start(const sim::radio::Frame& frame) {
  sent_.add(frame.transmitter, frame.receiver, kind_of(frame));
  if (!frame.retry) return;
  const std::size_t transmitter = frame.transmitter.value;
  if (transmitter >= retries_.size()) retries_.resize(transmitter + 1);
  ++retries_[transmitter];
}

void FrameCounts::on_reception(const sim::radio::Frame& frame, hal::AgentId receiver,
                               hal::Verdict verdict) {
  const bool addressed = frame.is_broadcast() || frame.receiver == receiver;
  const int kind = (kind_of(frame) << kClassShift) | (addressed ? 1 << kAddressedBit : 0) |
                   static_cast<int>(verdict);
  receptions_.add(frame.transmitter, receiver, static_cast<std::uint8_t>(kind));
}

void FrameCounts::on_faint(const sim::radio::Frame& frame, std::uint32_t radios) {
  const std::size_t transmitter = frame.transmitter.value;
  if (transmitter >= faint_.size()) faint_.resize(transmitter + 1);
  faint_[transmitter] += radios;
}

void FrameCounts::on_delivered(const sim::radio::Frame& frame, hal::AgentId receiver) {
  const int kind = (kind_of(frame) << kClassShift) | kWentUp;
  receptions_.add(frame.transmitter, receiver, static_cast<std::uint8_t>(kind));
}

void FrameCounts::on_request_end(hal::AgentId sender, hal::AgentId destination,
                                 hal::Verdict verdict) {
  requests_.add(sender, destination, static_cast<std::uint8_t>(verdict));
}

std::uint64_t FrameCounts::counted() const {
  return sent_.added() + receptions_.added() + requests_.added();
}

std::uint64_t FrameCounts::rows() const {
  return sent_.changed() + receptions_.changed() + requests_.changed();
}

void FrameCounts::write() {
  sent_.write_changes([this](auto sender, auto receiver, std::uint8_t kind, std::uint64_t count) {
    put_sent_.run(sender.value, receiver.value, class_in(kind), count);
  });
  receptions_.write_changes_by_second(
      [this](auto sender, auto receiver, std::uint8_t kind, std::uint64_t count) {
        const auto frame_class = class_in(static_cast<std::uint8_t>(kind >> kClassShift));
        if ((kind & kWentUp) == kWentUp) {
          put_packet_.run(receiver.value, sender.value, frame_class, count);
          return;
        }
        const bool addressed = (kind & (1 << kAddressedBit)) != 0;
        put_reception_.run(receiver.value, sender.value, frame_class, addressed, verdict_in(kind),
                           count);
      });
  for (std::size_t agent = 0; agent < faint_.size(); ++agent) {
    if (faint_[agent] > 0) put_faint_.run(agent, faint_[agent]);
  }
  requests_.write_changes(
      [this](auto sender, auto destination, std::uint8_t kind, std::uint64_t count) {
        const bool unknown = destination == hal::kEveryone &&
                             static_cast<hal::Verdict>(kind) == hal::Verdict::kDelivered;
        put_request_.run(sender.value, destination.value,
                         unknown ? "transmitted" : verdict_in(kind), count);
      });
}

}  // namespace results::record
