#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/message.h"

namespace results::record {

/// The PHYs with MCS that radiotap has a field for. Clauses of IEEE Std 802.11-2020: HT 19, VHT 21;
/// HE: IEEE Std 802.11ax-2021, 27.
enum class RadiotapPhy : std::uint8_t {
  kHt,   ///< HT-mixed format.
  kVht,  ///< VHT, to a single user.
  kHe,   ///< HE SU.
};

/// How the data of a PPDU are modulated.
struct RadiotapMode {
  RadiotapPhy phy = RadiotapPhy::kHt;
  /// Modulation and coding of one stream: 0..7 for HT, whose index in the standard is
  /// 8 (streams - 1) + mcs, 0..9 for VHT, 0..11 for HE.
  int mcs = 0;
  int streams = 1;     ///< Spatial streams, 1..4 for HT, else 1..8; without STBC.
  int width_mhz = 20;  ///< 20 or 40; with VHT and HE also 80 or 160.
  /// Guard interval: 800 or 400 ns; for HE 800, 1600 or 3200 ns.
  int guard_ns = 800;
  bool is_ldpc = false;  ///< Coding; false: BCC.
  /// HE-LTF symbol without its guard interval: 3200, 6400 or 12800 ns (1x, 2x, 4x); none: not
  /// known.
  std::optional<int> he_ltf_ns{};
};

/// Place of an MPDU in an A-MPDU.
struct RadiotapAmpdu {
  std::uint32_t reference = 0;  ///< The same for all MPDUs of an A-MPDU, and no other.
  bool is_last = false;         ///< The last MPDU of the A-MPDU.
  /// Whether the receiver knows which one is the last; then all MPDUs of the A-MPDU say so.
  bool is_last_known = true;
  std::optional<bool> is_eof{};  ///< The EOF bit of its delimiter: VHT and HE; none: not known.
  std::optional<std::uint8_t> delimiter_crc{};
};

/// Bits of the field `it_present`.
inline constexpr std::uint32_t kRadiotapHasMcs = 1U << 19, kRadiotapHasAmpdu = 1U << 20,
                               kRadiotapHasVht = 1U << 21, kRadiotapHasHe = 1U << 23;

/// The bit of `it_present` for a mode's field.
std::uint32_t radiotap_bit(RadiotapPhy phy);

/// Appends the fields to a header, with the padding before each that its alignment requires. They
/// are the last of those known in the header's `it_present`: radiotap.org/fields, "MCS", "A-MPDU
/// status", "VHT", "HE". The field of HT comes before that of the A-MPDU, those of VHT and HE
/// after.
/// @param header  from its first byte on, up to the field before.
/// @param ampdu  none: the MPDU is alone, not in an A-MPDU.
/// @return the bits of `it_present` for what was appended.
/// @pre the mode is in the ranges above; aborts otherwise.
std::uint32_t put_radiotap_phy(hal::Bytes& header, const RadiotapMode& mode,
                               const std::optional<RadiotapAmpdu>& ampdu);

}  // namespace results::record
