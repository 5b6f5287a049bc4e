#include "hal/files/recording/reassembly.h"

#include <algorithm>

namespace hal::files::recording {

std::optional<WholeDatagram> Reassembly::add(std::int64_t at, const rtps::IpPacket& packet) {
  if (!packet.is_fragment()) return WholeDatagram{at, packet.key.source, packet.payload};
  constexpr std::size_t kMostOctets = 65535;
  if (packet.payload.empty() || packet.offset + packet.payload.size() > kMostOctets)
    return std::nullopt;
  const auto [found, is_new] = unfinished_.try_emplace(packet.key);
  Parts& parts = found->second;
  if (is_new) {
    parts.at = at;
    order_.push_back(packet.key);
  }
  parts.pieces.try_emplace(packet.offset, packet.payload.begin(), packet.payload.end());
  if (!packet.more) parts.size = static_cast<std::uint32_t>(packet.offset + packet.payload.size());
  if (complete(parts)) {
    const std::int64_t first = parts.at;
    unfinished_.erase(found);
    return WholeDatagram{first, packet.key.source, whole_};
  }
  if (order_.size() > kMost) {
    given_up_ += unfinished_.erase(order_.front());
    order_.pop_front();
  }
  return std::nullopt;
}

bool Reassembly::complete(const Parts& parts) {
  if (!parts.size) return false;
  std::size_t end = 0;
  for (const auto& [offset, octets] : parts.pieces) {
    if (offset > end) return false;
    end = std::max(end, offset + octets.size());
  }
  if (end < *parts.size) return false;
  whole_.assign(*parts.size, std::byte{0});
  for (const auto& [offset, octets] : parts.pieces) {
    const std::size_t count =
        std::min<std::size_t>(octets.size(), *parts.size - std::min(*parts.size, offset));
    std::copy_n(octets.begin(), count, whole_.begin() + offset);
  }
  return true;
}

}  // namespace hal::files::recording
