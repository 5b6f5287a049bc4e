#include "hal/robot/radio/datagram.h"

#include <algorithm>
#include <array>

#include "hal/types/check.h"

namespace hal::robot::radio {
namespace {

constexpr std::array<std::uint8_t, 6> kStart{'B', 'R', 'K', 'A', 1, 0};
constexpr std::size_t kSender = kStart.size(), kLength = kSender + 2;
constexpr int kByte = 8;

void put(Bytes& bytes, std::size_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value >> kByte));
  bytes.push_back(static_cast<std::uint8_t>(value));
}

std::uint16_t get(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::uint16_t>((bytes[at] << kByte) | bytes[at + 1]);
}

}  // namespace

Bytes to_datagram(AgentId from, std::span<const std::uint8_t> frame) {
  BARAKA_CHECK(frame.size() <= kMaxFrame);
  Bytes bytes(kStart.begin(), kStart.end());
  bytes.reserve(kDatagramHeader + frame.size());
  put(bytes, from.value);
  put(bytes, frame.size());
  bytes.insert(bytes.end(), frame.begin(), frame.end());
  return bytes;
}

std::optional<ReceivedFrame> from_datagram(std::span<const std::uint8_t> datagram) {
  if (datagram.size() < kDatagramHeader || datagram.size() > kDatagramHeader + kMaxFrame) return {};
  if (!std::equal(kStart.begin(), kStart.end(), datagram.begin())) return {};
  if (get(datagram, kLength) != datagram.size() - kDatagramHeader) return {};
  const AgentId from{get(datagram, kSender)};
  if (from == AgentId{} || is_broadcast(from)) return {};
  return ReceivedFrame{from, datagram.subspan(kDatagramHeader)};
}

}  // namespace hal::robot::radio
