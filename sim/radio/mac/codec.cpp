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
constexpr std::size_t kQosControl = 2;
constexpr std::uint8_t kQosData = 0x88;  // first byte of Frame Control
constexpr std::size_t kBlockAckRequestSize = 16 + 4 + kFcs;
constexpr std::size_t kBlockAckSize = kBlockAckRequestSize;  // without its bitmap
// Both have a control field of the compressed variant and a starting sequence control.
constexpr std::uint64_t kCompressed = 2 << 1;
constexpr int kTidShift = 12, kSequenceShift = 4;
constexpr std::uint8_t kTidMask = 0x0f, kAmsduFlag = 0x80;

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
    case FrameType::kBlockAckRequest:
      return 0x84;
    case FrameType::kBlockAck:
      return 0x94;
    case FrameType::kAction:
      return 0xd0;
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

void put_snap(hal::Bytes& out, Ethertype ethertype) {
  out.insert(out.end(), kSnap.begin(), kSnap.end());
  out.push_back(static_cast<std::uint8_t>(ethertype >> 8));
  out.push_back(static_cast<std::uint8_t>(ethertype & 0xff));
}

/// Appends the subframes of an A-MSDU (IEEE Std 802.11-2020, 9.3.2.2.2).
void put_amsdu(hal::Bytes& out, const std::vector<AmsduPart>& parts) {
  std::size_t size = 0;
  for (const AmsduPart& part : parts) {
    for (; size % 4 != 0; ++size) out.push_back(0);
    put_address(out, part.destination);
    put_address(out, part.source);
    const std::size_t length = kSnap.size() + 2 + part.payload->size();
    out.push_back(static_cast<std::uint8_t>(length >> 8));
    out.push_back(static_cast<std::uint8_t>(length & 0xff));
    put_snap(out, part.ethertype);
    out.insert(out.end(), part.payload->begin(), part.payload->end());
    size += 2 * kAddressSize + 2 + length;
  }
}

/// Appends the fields after the second address.
void put_rest(hal::Bytes& out, const Frame& frame) {
  put_destination(out, frame.address3, frame);
  put_little_endian(out, static_cast<std::uint64_t>(frame.sequence) << kSequenceShift, 2);
  if (frame.qos) {
    out.push_back(static_cast<std::uint8_t>(frame.priority | (frame.amsdu ? kAmsduFlag : 0)));
    out.push_back(0);
  }
  if (frame.amsdu) return put_amsdu(out, *frame.amsdu);
  if (frame.type == FrameType::kData) put_snap(out, frame.ethertype);
  out.insert(out.end(), frame.payload->begin(), frame.payload->end());
}

/// Appends what follows the addresses of a BlockAckReq or a BlockAck.
void put_block_ack(hal::Bytes& out, const BlockAckFields& fields) {
  const std::uint64_t tid = fields.tid;
  put_little_endian(out, kCompressed | tid << kTidShift, 2);
  // The number of a fragment is that of the variant: 4 stands for 256 bits (table 9-30a).
  const std::uint64_t variant = fields.length > kShortBitmap ? 4 : 0;
  put_little_endian(out, static_cast<std::uint64_t>(fields.start) << kSequenceShift | variant, 2);
  for (std::uint32_t bit = 0; bit < fields.length; bit += 8) {
    std::uint8_t byte = 0;
    for (std::uint32_t i = 0; i < 8; ++i) {
      byte = static_cast<std::uint8_t>(byte | (fields.received[bit + i] ? 1 << i : 0));
    }
    out.push_back(byte);
  }
}

bool has_length_of(FrameType type, std::size_t length) {
  if (type == FrameType::kRts) return length == kRts;
  if (type == FrameType::kBlockAckRequest) return length == kBlockAckRequestSize;
  if (type == FrameType::kBlockAck) {
    return length == kBlockAckSize + kShortBitmap / 8 ||
           length == kBlockAckSize + kLongestBitmap / 8;
  }
  if (type == FrameType::kData) return length >= kDataMinimum;
  if (is_management(type)) return length >= kLongHeader + kFcs;
  return length == kCtsOrAck;
}

std::optional<FrameType> type_of(std::uint8_t frame_control) {
  if (frame_control == kQosData) return FrameType::kData;
  for (int i = 0; i < kFrameTypes; ++i) {
    const auto type = static_cast<FrameType>(i);
    if (frame_control_of(type) == frame_control) return type;
  }
  return std::nullopt;
}

tl::unexpected<hal::Error> wrong(std::string what) {
  return hal::fail(hal::Errc::kProtocol, "802.11 frame: " + std::move(what));
}

/// Reads what follows the addresses of a BlockAckReq or a BlockAck.
std::shared_ptr<const BlockAckFields> get_block_ack(View mpdu) {
  constexpr std::size_t kAddresses = 16;
  auto fields = std::make_shared<BlockAckFields>();
  fields->tid = static_cast<std::uint8_t>(mpdu[kAddresses + 1] >> (kTidShift - 8));
  fields->start =
      static_cast<std::uint16_t>(get_little_endian(mpdu.subspan(kAddresses + 2), 2) >> 4);
  const View bitmap = mpdu.subspan(kAddresses + 4, mpdu.size() - kBlockAckSize);
  fields->length = 8 * static_cast<std::uint32_t>(bitmap.size());
  for (std::size_t bit = 0; bit < fields->length; ++bit) {
    fields->received[bit] = (bitmap[bit / 8] >> bit % 8 & 1) != 0;
  }
  return fields;
}

Frame with_block_ack(Frame control, View mpdu) {
  if (control.type == FrameType::kBlockAckRequest || control.type == FrameType::kBlockAck) {
    control.block_ack = get_block_ack(mpdu);
  }
  return control;
}

/// Reads the fields after the second address. @return what is wrong; empty if nothing is.
std::string get_rest(View mpdu, Frame& frame) {
  const auto address3 = frame.ds == Ds::kTo ? get_destination(mpdu.subspan(16), frame)
                                            : get_address(mpdu.subspan(16));
  if (!address3) return "an address is not 02:00:00:00:hh:ll";
  frame.address3 = *address3;
  frame.sequence = static_cast<std::uint16_t>(get_little_endian(mpdu.subspan(22), 2) >> 4);
  std::size_t header = kLongHeader;
  if (frame.qos) {
    if (mpdu.size() < kDataMinimum + kQosControl) return "too short for QoS data";
    if ((mpdu[kLongHeader] & kAmsduFlag) != 0) return "an A-MSDU";
    frame.priority = mpdu[kLongHeader] & kTidMask;
    header += kQosControl;
  }
  View body = mpdu.subspan(header, mpdu.size() - header - kFcs);
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
  hal::Bytes out{frame.qos ? kQosData : frame_control_of(frame.type), flags_of(frame)};
  const auto duration = std::chrono::ceil<std::chrono::microseconds>(frame.duration);
  put_little_endian(out, static_cast<std::uint64_t>(duration.count()), 2);
  put_destination(out, frame.receiver, frame);
  if (frame.type != FrameType::kCts && frame.type != FrameType::kAck) {
    put_address(out, frame.transmitter);
  }
  if (!is_control(frame.type)) put_rest(out, frame);
  if (frame.block_ack) put_block_ack(out, *frame.block_ack);
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
                 " is not data, RTS, CTS, ACK, Block Ack, or management of a BSS");
  }
  if (!has_length_of(*type, mpdu.size())) {
    return wrong(std::to_string(mpdu.size()) + " bytes do not fit its type");
  }
  const auto ds = ds_of(mpdu[1]);
  if (!ds || (*ds != Ds::kNone && *type != FrameType::kData))
    return wrong("DS bits of no such frame");
  Frame frame;
  frame.type = *type;
  frame.qos = mpdu[0] == kQosData;
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
  if (is_control(*type)) return with_block_ack(std::move(frame), mpdu);
  if (std::string problem = get_rest(mpdu, frame); !problem.empty())
    return wrong(std::move(problem));
  return frame;
}

}  // namespace sim::radio
