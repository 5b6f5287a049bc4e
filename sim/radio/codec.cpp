#include "sim/radio/codec.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "hal/types/check.h"

namespace sim::radio {
namespace {

// Type and subtype with protocol version 0 (IEEE Std 802.11-2016, table 9-1): first byte of Frame
// Control, indexed by FrameType.
constexpr std::array<std::uint8_t, 4> kFrameControl{0x08, 0xb4, 0xc4, 0xd4};
constexpr std::uint8_t kRetryFlag = 0x08;
constexpr std::array<std::uint8_t, 6> kSnap{0xaa, 0xaa, 0x03, 0, 0, 0};

constexpr std::size_t kAddress = 6;
constexpr std::size_t kFcs = 4;
constexpr std::size_t kCtsOrAck = 10 + kFcs;
constexpr std::size_t kRts = 16 + kFcs;
constexpr std::size_t kDataHeader = 24;
constexpr std::size_t kDataMinimum = kDataHeader + kSnap.size() + 2 + kFcs;

using View = std::span<const std::uint8_t>;

void put_address(hal::Bytes& out, hal::AgentId agent) {
  if (agent == hal::kEveryone) {
    out.insert(out.end(), kAddress, 0xff);
    return;
  }
  const auto high = static_cast<std::uint8_t>(agent.value >> 8);
  const auto low = static_cast<std::uint8_t>(agent.value & 0xff);
  out.insert(out.end(), {0x02, 0, 0, 0, high, low});
}

std::optional<hal::AgentId> get_address(View bytes) {
  const auto is_ff = [](std::uint8_t byte) { return byte == 0xff; };
  if (std::all_of(bytes.begin(), bytes.begin() + kAddress, is_ff)) return hal::kEveryone;
  constexpr std::array<std::uint8_t, 4> kPrefix{0x02, 0, 0, 0};
  if (!std::equal(kPrefix.begin(), kPrefix.end(), bytes.begin())) return std::nullopt;
  return hal::AgentId{static_cast<std::uint16_t>(bytes[4] << 8 | bytes[5])};
}

void put_little_endian(hal::Bytes& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::uint32_t get_little_endian(View bytes, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  return value;
}

void put_body(hal::Bytes& out, const Frame& frame) {
  put_address(out, hal::AgentId{0});                                           // BSSID
  put_little_endian(out, static_cast<std::uint64_t>(frame.sequence) << 4, 2);  // fragment 0
  out.insert(out.end(), kSnap.begin(), kSnap.end());
  out.push_back(static_cast<std::uint8_t>(frame.ethertype >> 8));
  out.push_back(static_cast<std::uint8_t>(frame.ethertype & 0xff));
  out.insert(out.end(), frame.payload->begin(), frame.payload->end());
}

bool has_length_of(FrameType type, std::size_t length) {
  if (type == FrameType::kRts) return length == kRts;
  if (type == FrameType::kData) return length >= kDataMinimum;
  return length == kCtsOrAck;
}

std::optional<FrameType> type_of(std::uint8_t frame_control) {
  const auto found = std::find(kFrameControl.begin(), kFrameControl.end(), frame_control);
  if (found == kFrameControl.end()) return std::nullopt;
  return static_cast<FrameType>(found - kFrameControl.begin());
}

tl::unexpected<hal::Error> wrong(std::string what) {
  return hal::fail(hal::Errc::kProtocol, "802.11 frame: " + std::move(what));
}

/// Behind the addresses of a data frame.
bool get_body(View mpdu, Frame& frame) {
  frame.sequence = static_cast<std::uint16_t>(get_little_endian(mpdu.subspan(22), 2) >> 4);
  const View llc = mpdu.subspan(kDataHeader);
  if (!std::equal(kSnap.begin(), kSnap.end(), llc.begin())) return false;
  frame.ethertype = static_cast<Ethertype>(llc[6] << 8 | llc[7]);
  frame.payload = std::make_shared<const hal::Bytes>(llc.begin() + kSnap.size() + 2,
                                                     llc.end() - static_cast<int>(kFcs));
  return true;
}

}  // namespace

std::uint32_t frame_check_sequence(View bytes) {
  constexpr std::uint32_t kPolynomial = 0xedb88320;  // bit-reversed
  std::uint32_t crc = 0xffffffff;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? kPolynomial : 0);
  }
  return ~crc;
}

hal::Bytes encode(const Frame& frame) {
  BARAKA_CHECK(frame.type != FrameType::kData || frame.payload != nullptr);
  hal::Bytes out{kFrameControl[static_cast<std::size_t>(frame.type)],
                 frame.retry ? kRetryFlag : std::uint8_t{0}};
  const auto duration = std::chrono::ceil<std::chrono::microseconds>(frame.duration);
  put_little_endian(out, static_cast<std::uint64_t>(duration.count()), 2);
  put_address(out, frame.receiver);
  if (frame.type == FrameType::kData || frame.type == FrameType::kRts) {
    put_address(out, frame.transmitter);
  }
  if (frame.type == FrameType::kData) put_body(out, frame);
  put_little_endian(out, frame_check_sequence(out), kFcs);
  return out;
}

hal::Result<Frame> decode(View mpdu) {
  if (mpdu.size() < kCtsOrAck) return wrong(std::to_string(mpdu.size()) + " bytes, at least 14");
  const View checked = mpdu.first(mpdu.size() - kFcs);
  if (frame_check_sequence(checked) != get_little_endian(mpdu.last(kFcs), kFcs)) {
    return wrong("FCS does not match");
  }
  const auto type = type_of(mpdu[0]);
  if (!type) return wrong("type " + std::to_string(mpdu[0]) + " is not data, RTS, CTS or ACK");
  if (!has_length_of(*type, mpdu.size())) {
    return wrong(std::to_string(mpdu.size()) + " bytes do not fit its type");
  }
  Frame frame;
  frame.type = *type;
  frame.retry = (mpdu[1] & kRetryFlag) != 0;
  frame.duration = std::chrono::microseconds{get_little_endian(mpdu.subspan(2), 2)};
  frame.air_length = 8 * static_cast<std::uint32_t>(mpdu.size());
  const bool has_transmitter = *type == FrameType::kData || *type == FrameType::kRts;
  const auto receiver = get_address(mpdu.subspan(4));
  const auto transmitter = has_transmitter ? get_address(mpdu.subspan(10)) : hal::AgentId{0};
  if (!receiver || !transmitter) return wrong("an address is not 02:00:00:00:hh:ll");
  frame.receiver = *receiver;
  frame.transmitter = *transmitter;
  if (*type == FrameType::kData && !get_body(mpdu, frame)) return wrong("no LLC/SNAP header");
  return frame;
}

}  // namespace sim::radio
