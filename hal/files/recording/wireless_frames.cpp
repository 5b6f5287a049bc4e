#include "hal/files/recording/wireless_frames.h"

#include <algorithm>

namespace hal::files::recording {
namespace {

using rtps::Cursor;
using rtps::Endianness;

constexpr std::size_t kFcs = 4;
constexpr std::size_t kMostSeen = 1U << 16U;
constexpr std::int64_t kRepeatedWithin = 2'000'000'000;  // ns; sequence numbers come again

// Frame control (9.2.4.1), as a little-endian number.
constexpr unsigned kToDs = 0x0100, kFromDs = 0x0200, kMoreFragments = 0x0400, kRetry = 0x0800,
                   kProtected = 0x4000, kHtc = 0x8000, kQos = 0x0080, kNoData = 0x0040;
constexpr unsigned kTypeMask = 0x000c, kDataType = 0x0008;
constexpr std::uint8_t kNoTid = 16;

/// LLC and SNAP (IEEE Std 802-2014, 9.4; RFC 1042) before the packet.
void read_snap(Octets msdu, const OnNetworkPacket& on_packet) {
  Cursor cursor(msdu, Endianness::kBig);
  const bool is_snap = cursor.u32() == 0xaaaa0300 && cursor.u16() == 0;
  const std::uint16_t type = cursor.u16();
  if (is_snap && !cursor.is_short()) on_packet({type, cursor.take(cursor.left())});
}

/// Subframes of an A-MSDU (9.3.2.2.2): addresses, length, MSDU, padding to a multiple of 4.
void read_amsdu(Octets body, const OnNetworkPacket& on_packet) {
  Cursor cursor(body, Endianness::kBig);
  while (cursor.left() > 14) {
    cursor.take(12);
    const std::uint16_t length = cursor.u16();
    const Octets msdu = cursor.take(length);
    if (cursor.is_short()) return;
    read_snap(msdu, on_packet);
    cursor.take(std::min<std::size_t>((4U - (14U + length) % 4U) % 4U, cursor.left()));
  }
}

}  // namespace

void WirelessFrames::read(std::int64_t at, Octets frame, const OnNetworkPacket& on_packet) {
  read_frame(at, frame, 1, on_packet);
}

void WirelessFrames::read_radiotap(std::int64_t at, Octets octets,
                                   const OnNetworkPacket& on_packet) {
  Cursor cursor(octets, Endianness::kLittle);
  cursor.take(2);  // version, padding
  const std::size_t length = cursor.u16();
  std::uint32_t present = cursor.u32();
  const bool has_tsft = (present & 1U) != 0, has_flags = (present & 2U) != 0;
  constexpr std::uint32_t kFurther = 0x80000000;
  while ((present & kFurther) != 0 && !cursor.is_short()) present = cursor.u32();
  constexpr std::size_t kTsft = 8;
  if (has_tsft) cursor.take((kTsft - cursor.position() % kTsft) % kTsft + kTsft);
  const unsigned flags = has_flags ? cursor.u8() : 0;
  if (cursor.is_short() || length > octets.size()) return;
  constexpr unsigned kHasFcs = 0x10, kIsPadded = 0x20, kIsBad = 0x40;
  Octets frame = octets.subspan(length);
  if ((flags & kIsBad) != 0 || frame.size() < kFcs) return;
  if ((flags & kHasFcs) != 0) frame = frame.first(frame.size() - kFcs);
  read_frame(at, frame, (flags & kIsPadded) != 0 ? 4 : 1, on_packet);
}

void WirelessFrames::read_frame(std::int64_t at, Octets frame, std::size_t padding,
                                const OnNetworkPacket& on) {
  Cursor cursor(frame, Endianness::kLittle);
  const unsigned control = cursor.u16();
  if ((control & (kTypeMask | kNoData)) != kDataType || frame.size() < 24) return;
  cursor.take(8);  // duration, address 1
  MacAddress transmitter;
  std::ranges::copy(cursor.take(transmitter.size()), transmitter.begin());
  cursor.take(6);
  const std::uint16_t sequence = cursor.u16();
  const unsigned ds = control & (kToDs | kFromDs);
  if (ds == (kToDs | kFromDs)) cursor.take(6);
  const bool has_qos = (control & kQos) != 0;
  const unsigned qos = has_qos ? cursor.u16() : 0;
  if (has_qos && (control & kHtc) != 0) cursor.take(4);
  cursor.take((padding - cursor.position() % padding) % padding);
  if (cursor.is_short()) return;
  const std::uint8_t tid = has_qos ? qos & 0xfU : kNoTid;
  if (is_repetition(at, {transmitter, tid, sequence}, (control & kRetry) != 0)) return;
  if (is_relayed(frame, ds)) return;
  const bool is_fragment = (control & kMoreFragments) != 0 || (sequence & 0xfU) != 0;
  const Octets body = cursor.take(cursor.left());
  constexpr unsigned kAmsduPresent = 0x80;
  if ((control & kProtected) != 0) {
    ++encrypted_;
  } else if (is_fragment) {
    ++fragments_;
  } else if ((qos & kAmsduPresent) != 0) {
    read_amsdu(body, on);
  } else {
    read_snap(body, on);
  }
}

bool WirelessFrames::is_repetition(std::int64_t at, const FrameKey& key, bool is_retry) {
  const auto [found, is_new] = seen_.emplace(key, at);
  if (!is_new) {
    const bool is_repeated = is_retry && at - found->second < kRepeatedWithin;
    found->second = at;
    return is_repeated;
  }
  order_.push_back(key);
  if (order_.size() > kMostSeen) {
    seen_.erase(order_.front());
    order_.pop_front();
  }
  return false;
}

bool WirelessFrames::is_relayed(Octets frame, unsigned ds) {
  constexpr std::size_t kAddress2 = 10, kAddress3 = 16;
  MacAddress address;
  const auto read = [&](std::size_t from) {
    std::ranges::copy(frame.subspan(from, address.size()), address.begin());
  };
  if (ds == kToDs && stations_.size() < kMostSeen) {
    read(kAddress2);
    stations_.insert(address);
  }
  if (ds != kFromDs) return false;
  read(kAddress3);  // the source
  return stations_.contains(address);
}

}  // namespace hal::files::recording
