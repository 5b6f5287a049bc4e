#include "hal/files/recording/pcapng_file.h"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <vector>

#include "hal/files/recording/file_fault.h"

namespace hal::files::recording {
namespace {

using rtps::Cursor;
using rtps::Endianness;

constexpr std::uint32_t kSectionHeader = 0x0a0d0d0a, kByteOrder = 0x1a2b3c4d;
constexpr std::uint32_t kInterface = 1, kObsoletePacket = 2, kSimplePacket = 3, kEnhancedPacket = 6;
constexpr std::uint16_t kResolution = 9, kOffset = 14;  // options of an interface

/// An interface of a section.
struct CaptureInterface {
  std::uint16_t link_type = 0;
  std::uint8_t resolution = 6;  ///< if_tsresol: 10^-n s, or 2^-(n - 128) s.
  std::int64_t offset = 0;      ///< s
};

constexpr std::uint64_t kNano = 1'000'000'000;

/// A time since 1970 or since an offset.
struct SecondsAndRest {
  std::uint64_t seconds = 0;
  std::uint64_t rest = 0;  ///< ns
};

/// @param bits  a unit is 2^-bits s.
std::optional<SecondsAndRest> of_binary(std::uint64_t units, unsigned bits) {
  if (bits > 63) return std::nullopt;
  const std::uint64_t seconds = units >> bits;
  std::uint64_t rest = units & ((std::uint64_t{1} << bits) - 1);
  constexpr unsigned kMostBits = 30;  // so that the product fits
  if (bits > kMostBits) {
    rest >>= bits - kMostBits;
    bits = kMostBits;
  }
  return SecondsAndRest{seconds, rest * kNano >> bits};
}

/// @param digits  a unit is 10^-digits s.
std::optional<SecondsAndRest> of_decimal(std::uint64_t units, unsigned digits) {
  constexpr unsigned kMostDigits = 19;
  if (digits > kMostDigits) return std::nullopt;
  std::uint64_t per_second = 1;
  for (unsigned i = 0; i < digits; ++i) per_second *= 10;
  const std::uint64_t rest = units % per_second;
  return SecondsAndRest{units / per_second, per_second <= kNano ? rest * (kNano / per_second)
                                                                : rest / (per_second / kNano)};
}

/// @return nanoseconds since 1970; nullopt: before, or after the year 2261.
std::optional<std::int64_t> to_nanoseconds(std::uint64_t units, const CaptureInterface& interface) {
  constexpr std::uint8_t kBinary = 0x80;
  const unsigned exponent = interface.resolution & 0x7fU;
  const auto time = (interface.resolution & kBinary) != 0 ? of_binary(units, exponent)
                                                          : of_decimal(units, exponent);
  constexpr auto kMost =
      static_cast<std::int64_t>(std::numeric_limits<std::int64_t>::max() / kNano - 1);
  if (!time || time->seconds > static_cast<std::uint64_t>(kMost)) return std::nullopt;
  const auto seconds = static_cast<std::int64_t>(time->seconds);
  if (interface.offset > kMost - seconds || interface.offset < -seconds) return std::nullopt;
  return (seconds + interface.offset) * static_cast<std::int64_t>(kNano) +
         static_cast<std::int64_t>(time->rest);
}

class PcapngReader {
 public:
  PcapngReader(Octets file, const OnPacket& on_packet) : file_(file), on_packet_(on_packet) {}

  std::size_t read() {
    while (at_ < file_.size()) read_block();
    return without_time_;
  }

 private:
  [[noreturn]] void refuse(std::string what) const { throw FileFault{at_, std::move(what)}; }
  void read_block();
  void read_interface(Octets body);
  void read_packet(std::uint32_t type, Octets body);

  Octets file_;
  const OnPacket& on_packet_;
  std::size_t at_ = 0;
  Endianness endianness_{};
  std::vector<CaptureInterface> interfaces_;
  std::size_t without_time_ = 0;
};

void PcapngReader::read_block() {
  constexpr std::size_t kLeast = 12;
  const Octets rest = file_.subspan(at_);
  if (rest.size() < kLeast)
    throw FileFault{at_, "the file ends within the header of a block", true};
  // The type of a section's header is the same in both orders of bytes.
  if (Cursor(rest, Endianness::kBig).u32() == kSectionHeader) {
    constexpr std::size_t kMagic = 8;
    endianness_ = Cursor(rest.subspan(kMagic), Endianness::kLittle).u32() == kByteOrder
                      ? Endianness::kLittle
                      : Endianness::kBig;
    if (Cursor(rest.subspan(kMagic), endianness_).u32() != kByteOrder)
      refuse("a section does not tell its order of bytes");
    interfaces_.clear();
  }
  Cursor cursor(rest, endianness_);
  const std::uint32_t type = cursor.u32(), length = cursor.u32();
  if (length < kLeast || length % 4 != 0) refuse(fmt::format("a block has a length of {}", length));
  if (length > rest.size())
    throw FileFault{at_,
                    fmt::format("the file ends within a block: {} of its {} bytes are there",
                                rest.size(), length),
                    true};
  if (Cursor(rest.subspan(length - 4), endianness_).u32() != length)
    refuse("a block does not end with its length");
  const Octets body = rest.subspan(8, length - kLeast);
  if (type == kInterface) read_interface(body);
  if (type == kEnhancedPacket || type == kObsoletePacket) read_packet(type, body);
  if (type == kSimplePacket) ++without_time_;
  at_ += length;
}

void PcapngReader::read_interface(Octets body) {
  Cursor cursor(body, endianness_);
  CaptureInterface interface { .link_type = cursor.u16() };
  cursor.take(2 + 4);  // reserved, snap length
  while (cursor.left() >= 4) {
    const std::uint16_t option = cursor.u16(), length = cursor.u16();
    if (option == 0) break;
    Cursor value(cursor.take(length), endianness_);
    cursor.take(std::min<std::size_t>((4U - length % 4U) % 4U, cursor.left()));
    if (option == kResolution) interface.resolution = value.u8();
    if (option == kOffset) interface.offset = static_cast<std::int64_t>(value.u64());
  }
  if (cursor.is_short()) refuse("the description of an interface is too short");
  interfaces_.push_back(interface);
}

void PcapngReader::read_packet(std::uint32_t type, Octets body) {
  Cursor cursor(body, endianness_);
  std::uint32_t interface = cursor.u32();
  if (type == kObsoletePacket) {  // 16 bits, then a count of drops
    interface = Cursor(body, endianness_).u16();
  }
  const std::uint64_t high = cursor.u32();
  const std::uint64_t units = high << 32U | cursor.u32();
  const std::uint32_t captured = cursor.u32(), original = cursor.u32();
  const Octets octets = cursor.take(captured);
  if (cursor.is_short()) refuse("a packet is longer than its block");
  if (interface >= interfaces_.size())
    refuse(fmt::format("a packet is of interface {}, which is not described", interface));
  const auto at = to_nanoseconds(units, interfaces_[interface]);
  if (!at) refuse("the time of a packet is before 1970 or after 2261");
  on_packet_({*at, interfaces_[interface].link_type, octets, original > captured});
}

}  // namespace

bool is_pcapng(Octets octets) { return Cursor(octets, Endianness::kBig).u32() == kSectionHeader; }

std::size_t read_pcapng(Octets file, const OnPacket& on_packet) {
  return PcapngReader(file, on_packet).read();
}

}  // namespace hal::files::recording
