#include "sim/radio/mac/codec.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "hal/types/check.h"
#include "sim/radio/mac/mac_address.h"

namespace sim::radio {
namespace {

constexpr std::uint8_t kToDsFlag = 0x01, kFromDsFlag = 0x02;
constexpr std::uint8_t kRetryFlag = 0x08;
constexpr std::array<std::uint8_t, 6> kSnap{0xaa, 0xaa, 0x03, 0, 0, 0};

constexpr std::size_t kFcs = 4;
constexpr std::size_t kCtsOrAck = 10 + kFcs;
constexpr std::size_t kRts = 16 + kFcs;
constexpr std::size_t kLongHeader = 24;  // data and management frames
constexpr std::size_t kDataMinimum = kLongHeader + kSnap.size() + 2 + kFcs;

using View = std::span<const std::uint8_t>;

/// Type and subtype with protocol version 0 (IEEE Std 802.11-2016, table 9-1): first byte of Frame
/// Control.
std::uint8_t frame_control_of(FrameType type) {
  switch (type) {
    case FrameType::kData:
      return 0x08;
    case FrameType::kRts:
      return 0xb4;
    case FrameType::kCts:
      return 0xc4;
    case FrameType::kAck:
      return 0xd4;
    case FrameType::kBeacon:
      return 0x80;
    case FrameType::kAuthentication:
      return 0xb0;
    case FrameType::kDeauthentication:
      return 0xc0;
    case FrameType::kAssociationRequest:
      return 0x00;
    case FrameType::kAssociationResponse:
      return 0x10;
    case FrameType::kReassociationRequest:
      return 0x20;
    case FrameType::kReassociationResponse:
      return 0x30;
    case FrameType::kDisassociation:
      return 0xa0;
  }
  BARAKA_CHECK(false);
}

std::uint8_t flags_of(const Frame& frame) {
  const int ds = frame.ds == Ds::kTo ? kToDsFlag : frame.ds == Ds::kFrom ? kFromDsFlag : 0;
  return static_cast<std::uint8_t>(ds | (frame.retry ? kRetryFlag : 0));
}

std::optional<Ds> ds_of(std::uint8_t flags) {
  switch (flags & (kToDsFlag | kFromDsFlag)) {
    case 0:
      return Ds::kNone;
    case kToDsFlag:
      return Ds::kTo;
    case kFromDsFlag:
      return Ds::kFrom;
    default:
      return std::nullopt;  // mesh: four addresses
  }
}

/// @param to  destination that the address field names.
void put_destination(hal::Bytes& out, hal::AgentId to, const Frame& frame) {
  if (to == hal::kEveryone && frame.group != 0) return put_group(out, frame.group);
  put_address(out, to);
}

/// The agent, or kEveryone after the group was stored in the frame; nullopt for any other address.
std::optional<hal::AgentId> get_destination(View bytes, Frame& frame) {
  if (const auto agent = get_address(bytes); agent || !is_group(bytes)) return agent;
  frame.group = get_group(bytes);
  return hal::kEveryone;
}

/// Appends the fields after the second address.
void put_rest(hal::Bytes& out, const Frame& frame) {
  put_destination(out, frame.address3, frame);
  put_little_endian(out, static_cast<std::uint64_t>(frame.sequence) << 4, 2);  // fragment 0
  if (frame.type == FrameType::kData) {
    out.insert(out.end(), kSnap.begin(), kSnap.end());
    out.push_back(static_cast<std::uint8_t>(frame.ethertype >> 8));
    out.push_back(static_cast<std::uint8_t>(frame.ethertype & 0xff));
  }
  out.insert(out.end(), frame.payload->begin(), frame.payload->end());
}

bool has_length_of(FrameType type, std::size_t length) {
  if (type == FrameType::kRts) return length == kRts;
  if (type == FrameType::kData) return length >= kDataMinimum;
  if (is_management(type)) return length >= kLongHeader + kFcs;
  return length == kCtsOrAck;
}

std::optional<FrameType> type_of(std::uint8_t frame_control) {
  for (int i = 0; i < kFrameTypes; ++i) {
    const auto type = static_cast<FrameType>(i);
    if (frame_control_of(type) == frame_control) return type;
  }
  return std::nullopt;
}

tl::unexpected<hal::Error> wrong(std::string what) {
  return hal::fail(hal::Errc::kProtocol, "802.11 frame: " + std::move(what));
}

/// Reads the fields after the second address. @return what is wrong; empty if nothing is.
std::string get_rest(View mpdu, Frame& frame) {
  const auto address3 = frame.ds == Ds::kTo ? get_destination(mpdu.subspan(16), frame)
                                            : get_address(mpdu.subspan(16));
  if (!address3) return "an address is not 02:00:00:00:hh:ll";
  frame.address3 = *address3;
  frame.sequence = static_cast<std::uint16_t>(get_little_endian(mpdu.subspan(22), 2) >> 4);
  View body = mpdu.subspan(kLongHeader, mpdu.size() - kLongHeader - kFcs);
  if (frame.type == FrameType::kData) {
    if (!std::equal(kSnap.begin(), kSnap.end(), body.begin())) return "no LLC/SNAP header";
    frame.ethertype = static_cast<Ethertype>(body[6] << 8 | body[7]);
    body = body.subspan(kSnap.size() + 2);
  }
  frame.payload = std::make_shared<const hal::Bytes>(body.begin(), body.end());
  return {};
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
  BARAKA_CHECK(is_control(frame.type) || frame.payload != nullptr);
  hal::Bytes out{frame_control_of(frame.type), flags_of(frame)};
  const auto duration = std::chrono::ceil<std::chrono::microseconds>(frame.duration);
  put_little_endian(out, static_cast<std::uint64_t>(duration.count()), 2);
  put_destination(out, frame.receiver, frame);
  if (frame.type != FrameType::kCts && frame.type != FrameType::kAck) {
    put_address(out, frame.transmitter);
  }
  if (!is_control(frame.type)) put_rest(out, frame);
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
  if (!type) {
    return wrong("type " + std::to_string(mpdu[0]) +
                 " is not data, RTS, CTS, ACK, or management of a BSS");
  }
  if (!has_length_of(*type, mpdu.size())) {
    return wrong(std::to_string(mpdu.size()) + " bytes do not fit its type");
  }
  const auto ds = ds_of(mpdu[1]);
  if (!ds || (*ds != Ds::kNone && *type != FrameType::kData))
    return wrong("DS bits of no such frame");
  Frame frame;
  frame.type = *type;
  frame.ds = *ds;
  frame.retry = (mpdu[1] & kRetryFlag) != 0;
  frame.duration =
      std::chrono::microseconds{static_cast<std::int64_t>(get_little_endian(mpdu.subspan(2), 2))};
  frame.air_length = 8 * static_cast<std::uint32_t>(mpdu.size());
  const bool has_transmitter = *type != FrameType::kCts && *type != FrameType::kAck;
  const auto receiver = *type == FrameType::kData ? get_destination(mpdu.subspan(4), frame)
                                                  : get_address(mpdu.subspan(4));
  const auto transmitter = has_transmitter ? get_address(mpdu.subspan(10)) : hal::AgentId{0};
  if (!receiver || !transmitter) return wrong("an address is not 02:00:00:00:hh:ll");
  frame.receiver = *receiver;
  frame.transmitter = *transmitter;
  if (is_control(*type)) return frame;
  if (std::string problem = get_rest(mpdu, frame); !problem.empty())
    return wrong(std::move(problem));
  return frame;
}

}  // namespace sim::radio
