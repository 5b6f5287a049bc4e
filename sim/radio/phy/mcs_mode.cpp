#include "sim/radio/phy/mcs_mode.h"

#include <array>

#include "hal/types/check.h"
#include "sim/radio/phy/ofdm_error_model.h"

namespace sim::radio {
namespace {

using namespace std::chrono_literals;

constexpr std::array kMcsCodings{Coding{Constellation::kBpsk, CodeRate::kHalf},
                                 Coding{Constellation::kQpsk, CodeRate::kHalf},
                                 Coding{Constellation::kQpsk, CodeRate::kThreeQuarters},
                                 Coding{Constellation::kQam16, CodeRate::kHalf},
                                 Coding{Constellation::kQam16, CodeRate::kThreeQuarters},
                                 Coding{Constellation::kQam64, CodeRate::kTwoThirds},
                                 Coding{Constellation::kQam64, CodeRate::kThreeQuarters},
                                 Coding{Constellation::kQam64, CodeRate::kFiveSixths},
                                 Coding{Constellation::kQam256, CodeRate::kThreeQuarters},
                                 Coding{Constellation::kQam256, CodeRate::kFiveSixths},
                                 Coding{Constellation::kQam1024, CodeRate::kThreeQuarters},
                                 Coding{Constellation::kQam1024, CodeRate::kFiveSixths}};
/// IEEE Std 802.11-2020, table 10-10, by MCS; 1024-QAM as 256-QAM.
constexpr std::array kReferenceRates{6e6,  12e6, 18e6, 24e6, 36e6, 48e6,
                                     54e6, 54e6, 54e6, 54e6, 54e6, 54e6};
constexpr std::array kTrainingFields{1, 2, 4, 4};

constexpr hal::Duration kLegacyPreamble = 16us;  // L-STF and L-LTF
constexpr hal::Duration kSignalExtensionTime = 6us;
/// What LENGTH in the L-SIG can express: 4095 bytes at 6 Mb/s.
constexpr hal::Duration kLongestPpdu = 5484us;
constexpr std::int64_t kServiceBits = 16, kTailBits = 6;
constexpr Coding kHeaderCoding{Constellation::kBpsk, CodeRate::kHalf};
constexpr std::uint8_t kHighestMandatoryMcs = 7;
constexpr hal::Duration kShortGuard = 400ns;

double rate_of(int coded_bits, CodeRatio ratio, hal::Duration symbol) {
  return 1.0 * coded_bits * ratio.information / ratio.coded / hal::to_seconds(symbol);
}

}  // namespace

Coding mcs_coding(std::uint8_t mcs) {
  BARAKA_CHECK(mcs < kMcsCodings.size());
  return kMcsCodings[mcs];
}

int McsMode::coded_bits(const ModeId& id, int data_subcarriers) {
  return data_subcarriers * static_cast<int>(mcs_coding(id.mcs).constellation) * id.streams;
}

int McsMode::training_fields(const ModeId& id) {
  BARAKA_CHECK(id.streams >= 1 && id.streams <= kTrainingFields.size());
  return kTrainingFields[static_cast<std::size_t>(id.streams) - 1];
}

McsMode::McsMode(const ModeId& id, const Format& format, const Options& options)
    : PhyMode(id,
              hal::BitsPerSecond{rate_of(coded_bits(id, format.data_subcarriers),
                                         ratio_of(mcs_coding(id.mcs).rate), format.symbol)},
              kLegacyPreamble, format.header),
      format_(format),
      options_(options),
      coding_(mcs_coding(id.mcs)) {
  const CodeRatio ratio = ratio_of(coding_.rate);
  bits_per_symbol_ = coded_bits(id, format.data_subcarriers) * ratio.information / ratio.coded;
}

hal::BitsPerSecond McsMode::reference_rate() const {
  return hal::BitsPerSecond{kReferenceRates[id().mcs]};
}

bool McsMode::is_mandatory() const {
  const bool is_narrow = id().width == 20 || modulation_class() != ModulationClass::kHt;
  return id().streams == 1 && id().mcs <= kHighestMandatoryMcs && is_narrow &&
         id().guard != kShortGuard;
}

hal::Duration McsMode::airtime(std::uint32_t psdu_bits) const {
  const std::int64_t bits =
      kServiceBits + static_cast<std::int64_t>(psdu_bits) + kTailBits * format_.encoders;
  const std::int64_t symbols = (bits + bits_per_symbol_ - 1) / bits_per_symbol_;
  const hal::Duration multiple = format_.multiple;
  const std::int64_t parts = (symbols * format_.symbol + multiple - hal::Duration{1}) / multiple;
  return preamble_and_header() + parts * multiple + extension();
}

hal::Duration McsMode::longest_ppdu() const { return kLongestPpdu; }

hal::Duration McsMode::extension() const {
  return options_.has_extension ? kSignalExtensionTime : hal::Duration{};
}

hal::Duration McsMode::signal_extension() const {
  return options_.at_risk == BitsAtRisk::kMpdu ? extension() : hal::Duration{};
}

double McsMode::bits_at_risk(std::uint32_t psdu_bits) const {
  if (options_.at_risk == BitsAtRisk::kMpdu) return psdu_bits;
  return rate().value * hal::to_seconds(airtime(psdu_bits) - preamble_and_header());
}

double McsMode::header_success(double sinr, double share) const {
  return ofdm_success_probability(sinr, kHeaderCoding, share * format_.header_bits);
}

double McsMode::success(double sinr, double bits) const {
  return options_.curve ? options_.curve->success(sinr, bits)
                        : ofdm_success_probability(sinr, coding_, bits);
}

}  // namespace sim::radio
