#include "results/record/radiotap_phy.h"

#include "hal/types/check.h"

namespace results::record {
namespace {

/// Little-endian; radiotap aligns each field to the size of its largest member.
class FieldWriter {
 public:
  FieldWriter(hal::Bytes& header, std::size_t alignment) : header_(header) {
    while (header_.size() % alignment != 0) header_.push_back(0);
  }
  FieldWriter& u8(int value) { return put(static_cast<std::uint32_t>(value), 1); }
  FieldWriter& u16(int value) { return put(static_cast<std::uint32_t>(value), 2); }
  FieldWriter& u32(std::uint32_t value) { return put(value, 4); }

 private:
  FieldWriter& put(std::uint32_t value, std::size_t octets) {
    for (std::size_t i = 0; i < octets; ++i)
      header_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    return *this;
  }

  hal::Bytes& header_;
};

void check_ht(const RadiotapMode& mode) {
  BARAKA_CHECK(mode.mcs >= 0 && mode.mcs <= 7 && mode.streams >= 1 && mode.streams <= 4);
  BARAKA_CHECK(mode.width_mhz == 20 || mode.width_mhz == 40);
  BARAKA_CHECK(mode.guard_ns == 400 || mode.guard_ns == 800);
}

void check_wide(const RadiotapMode& mode, int last_mcs) {
  BARAKA_CHECK(mode.mcs >= 0 && mode.mcs <= last_mcs && mode.streams >= 1 && mode.streams <= 8);
  BARAKA_CHECK(mode.width_mhz == 20 || mode.width_mhz == 40 || mode.width_mhz == 80 ||
               mode.width_mhz == 160);
}

void put_mcs(hal::Bytes& header, const RadiotapMode& mode) {
  constexpr int kBandwidth = 0x01, kIndex = 0x02, kGuard = 0x04, kFormat = 0x08, kFec = 0x10,
                kStbc = 0x20;
  constexpr int kIs40MHz = 0x01, kIsShort = 0x04, kIsLdpc = 0x10;  // format 0: mixed; STBC 0
  check_ht(mode);
  FieldWriter(header, 1)
      .u8(kBandwidth | kIndex | kGuard | kFormat | kFec | kStbc)
      .u8((mode.width_mhz == 40 ? kIs40MHz : 0) | (mode.guard_ns == 400 ? kIsShort : 0) |
          (mode.is_ldpc ? kIsLdpc : 0))
      .u8(8 * (mode.streams - 1) + mode.mcs);
}

void put_ampdu(hal::Bytes& header, const RadiotapAmpdu& ampdu) {
  constexpr int kLastKnown = 0x0004, kLast = 0x0008, kCrcKnown = 0x0020, kEof = 0x0040,
                kEofKnown = 0x0080;
  int flags = 0;
  if (ampdu.is_last_known) flags |= kLastKnown | (ampdu.is_last ? kLast : 0);
  if (ampdu.delimiter_crc) flags |= kCrcKnown;
  if (ampdu.is_eof) flags |= kEofKnown | (*ampdu.is_eof ? kEof : 0);
  FieldWriter(header, 4).u32(ampdu.reference).u16(flags).u8(ampdu.delimiter_crc.value_or(0)).u8(0);
}

/// The value of VHT's member `bandwidth` for a PPDU that fills it.
int vht_bandwidth(int width_mhz) {
  switch (width_mhz) {
    case 20:
      return 0;
    case 40:
      return 1;
    case 80:
      return 4;
    default:
      return 11;
  }
}

void put_vht(hal::Bytes& header, const RadiotapMode& mode) {
  constexpr int kStbc = 0x0001, kGuard = 0x0004, kBandwidth = 0x0040;
  constexpr int kIsShort = 0x04;  // STBC 0
  check_wide(mode, 9);
  BARAKA_CHECK(mode.guard_ns == 400 || mode.guard_ns == 800);
  FieldWriter(header, 2)
      .u16(kStbc | kGuard | kBandwidth)
      .u8(mode.guard_ns == 400 ? kIsShort : 0)
      .u8(vht_bandwidth(mode.width_mhz))
      .u8(mode.mcs << 4 | mode.streams)
      .u8(0)
      .u8(0)
      .u8(0)  // users 1 to 3: no streams
      .u8(mode.is_ldpc ? 1 : 0)
      .u8(0)    // group, not known
      .u16(0);  // partial AID, not known
}

/// 0: 20, 1: 40, 2: 80, 3: 160 MHz.
int he_bandwidth(int width_mhz) {
  int value = 0;
  while (20 << value < width_mhz) ++value;
  return value;
}

/// 0: 0.8, 1: 1.6, 2: 3.2 us.
int he_guard(int guard_ns) { return guard_ns == 800 ? 0 : guard_ns == 1600 ? 1 : 2; }

/// 0: not known, 1 to 3: symbols of 3.2, 6.4 and 12.8 us.
int he_ltf(const std::optional<int>& ltf_ns) {
  if (!ltf_ns) return 0;
  return *ltf_ns == 3200 ? 1 : *ltf_ns == 6400 ? 2 : 3;
}

void put_he(hal::Bytes& header, const RadiotapMode& mode) {
  constexpr int kMcs = 0x0020, kDcm = 0x0040, kCoding = 0x0080, kStbc = 0x0200, kBandwidth = 0x4000,
                kDoppler = 0x8000;                // of data1; format 0: SU
  constexpr int kGuard = 0x0002, kTxBf = 0x0010;  // of data2
  constexpr int kIsLdpc = 0x2000;                 // of data3; DCM, STBC, beamforming and Doppler 0
  check_wide(mode, 11);
  BARAKA_CHECK(mode.guard_ns == 800 || mode.guard_ns == 1600 || mode.guard_ns == 3200);
  BARAKA_CHECK(!mode.he_ltf_ns || *mode.he_ltf_ns == 3200 || *mode.he_ltf_ns == 6400 ||
               *mode.he_ltf_ns == 12800);
  FieldWriter(header, 2)
      .u16(kMcs | kDcm | kCoding | kStbc | kBandwidth | kDoppler)
      .u16(kGuard | kTxBf)
      .u16(mode.mcs << 8 | (mode.is_ldpc ? kIsLdpc : 0))
      .u16(0)
      .u16(he_bandwidth(mode.width_mhz) | he_guard(mode.guard_ns) << 4 |
           he_ltf(mode.he_ltf_ns) << 6)
      .u16(mode.streams);
}

}  // namespace

std::uint32_t radiotap_bit(RadiotapPhy phy) {
  switch (phy) {
    case RadiotapPhy::kHt:
      return kRadiotapHasMcs;
    case RadiotapPhy::kVht:
      return kRadiotapHasVht;
    case RadiotapPhy::kHe:
      return kRadiotapHasHe;
  }
  BARAKA_CHECK(false);
  return 0;
}

std::uint32_t put_radiotap_phy(hal::Bytes& header, const RadiotapMode& mode,
                               const std::optional<RadiotapAmpdu>& ampdu) {
  if (mode.phy == RadiotapPhy::kHt) put_mcs(header, mode);
  if (ampdu) put_ampdu(header, *ampdu);
  if (mode.phy == RadiotapPhy::kVht) put_vht(header, mode);
  if (mode.phy == RadiotapPhy::kHe) put_he(header, mode);
  return radiotap_bit(mode.phy) | (ampdu ? kRadiotapHasAmpdu : 0);
}

}  // namespace results::record
