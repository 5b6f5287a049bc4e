#include "sim/radio/mac/frame_lengths.h"

namespace sim::radio {
namespace {

constexpr std::uint32_t kRtsBits = 160;
constexpr std::uint32_t kCtsOrAckBits = 112;
constexpr std::uint32_t kBlockAckRequestBits = 192;
constexpr std::uint32_t kBlockAckBytes = 24;                // without its bitmap
constexpr std::uint32_t kDataOverheadBytes = 24 + 8 + 4;    // MAC header, LLC/SNAP, FCS
constexpr std::uint32_t kManagementOverheadBytes = 24 + 4;  // MAC header, FCS

}  // namespace

std::uint32_t block_ack_bits(std::uint32_t length) { return 8 * kBlockAckBytes + length; }

std::uint32_t mpdu_bits(const LengthsConfig& lengths, FrameType type, std::size_t payload) {
  if (type == FrameType::kRts) return kRtsBits;
  if (type == FrameType::kBlockAckRequest) return kBlockAckRequestBits;
  if (type == FrameType::kBlockAck) return block_ack_bits(kShortBitmap);
  if (is_control(type)) return kCtsOrAckBits;
  if (is_management(type)) {
    return 8 * (static_cast<std::uint32_t>(payload) + kManagementOverheadBytes);
  }
  if (lengths.lengths == Lengths::kFixed) {
    return lengths.header_bits + lengths.payload_bits;
  }
  return 8 * (static_cast<std::uint32_t>(payload) + kDataOverheadBytes);
}

}  // namespace sim::radio
