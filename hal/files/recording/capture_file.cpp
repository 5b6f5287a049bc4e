#include "hal/files/recording/capture_file.h"

#include <fmt/format.h>

#include "hal/files/recording/file_fault.h"
#include "hal/files/recording/pcapng_file.h"

namespace hal::files::recording {
namespace {

using rtps::Cursor;
using rtps::Endianness;

constexpr std::uint32_t kMicroseconds = 0xa1b2c3d4, kNanoseconds = 0xa1b23c4d;
constexpr std::size_t kFileHeader = 24, kPacketHeader = 16;
constexpr std::int64_t kSecondNs = 1'000'000'000;

/// How a pcap is written.
struct PcapForm {
  Endianness endianness{};
  std::int64_t fraction = 0;  ///< Nanoseconds of a unit of the fraction of a second; 0: no pcap.
};

PcapForm form_of(Octets octets) {
  for (const Endianness endianness : {Endianness::kLittle, Endianness::kBig}) {
    const std::uint32_t magic = Cursor(octets, endianness).u32();
    if (magic == kMicroseconds) return {endianness, 1000};
    if (magic == kNanoseconds) return {endianness, 1};
  }
  return {};
}

void read_pcap(Octets file, const PcapForm& form, const OnPacket& on_packet) {
  if (file.size() < kFileHeader)
    throw FileFault{file.size(), "the file ends within its header of 24 bytes", true};
  constexpr std::size_t kLinkType = 20;
  // The upper bits tell of a frame check sequence.
  const auto link_type =
      static_cast<std::uint16_t>(Cursor(file.subspan(kLinkType), form.endianness).u32());
  std::size_t at = kFileHeader;
  for (std::uint64_t number = 1; at < file.size(); ++number) {
    Cursor cursor(file.subspan(at), form.endianness);
    const std::int64_t seconds = cursor.u32(), fraction = cursor.u32();
    const std::uint32_t captured = cursor.u32(), original = cursor.u32();
    if (cursor.is_short())
      throw FileFault{at, fmt::format("the file ends within the header of packet {}", number),
                      true};
    if (captured > cursor.left())
      throw FileFault{at,
                      fmt::format("the file ends within packet {}: {} of its {} bytes are there",
                                  number, cursor.left(), captured),
                      true};
    on_packet({seconds * kSecondNs + fraction * form.fraction, link_type, cursor.take(captured),
               original > captured});
    at += kPacketHeader + captured;
  }
}

}  // namespace

bool is_capture(Octets octets) { return form_of(octets).fraction != 0 || is_pcapng(octets); }

std::size_t read_packets(Octets file, const OnPacket& on_packet) {
  if (is_pcapng(file)) return read_pcapng(file, on_packet);
  read_pcap(file, form_of(file), on_packet);
  return 0;
}

}  // namespace hal::files::recording
