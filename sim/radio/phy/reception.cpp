#include "sim/radio/phy/reception.h"

#include <algorithm>
#include <limits>

#include "hal/types/math.h"
#include "sim/radio/channel/propagation.h"

namespace sim::radio {
namespace {

constexpr double kNoiseWidth = 20;  // MHz, for which ReceiverConfig::noise_floor is given

struct Span {
  hal::Time low, high;
};

/// Share of a span that lies in [from, to).
inline double share(hal::Time from, hal::Time to, Span span) {
  const hal::Duration common =
      std::max(hal::Duration{}, std::min(to, span.high) - std::max(from, span.low));
  if (common == hal::Duration{}) return 0;
  return hal::to_seconds(common) / hal::to_seconds(span.high - span.low);
}

}  // namespace

ReceptionRules::ReceptionRules(const ReceiverConfig& config)
    : error_model(config.error_model),
      min_sinr(hal::math::pow(10, config.min_sinr.value / 10)),
      noise(to_milliwatts(config.noise_floor).value),
      sensitivity(to_milliwatts(config.sensitivity).value) {}

hal::Verdict cause_of_loss(const ReceptionRules& rules, const Interference& interference) {
  if (interference.sum < rules.noise) return hal::Verdict::kNoise;
  return interference.strongest >= rules.sensitivity ? hal::Verdict::kCollision
                                                     : hal::Verdict::kInterference;
}

Reception::Reception(const Ppdu& ppdu, double power, hal::Time start, hal::Time locked)
    : ppdu_(&ppdu),
      power_(power),
      start_(start),
      locked_(locked),
      heard_until_(locked),
      width_(ppdu.mode->width() / kNoiseWidth),
      min_sinr_(std::numeric_limits<double>::infinity()) {
  if (ppdu.is_aggregate()) others_.resize(ppdu.parts.size() - 1, 1.0);
}

void Reception::hear(const ReceptionRules& rules, const Interference& interference, hal::Time now) {
  if (now == heard_until_) return;
  const double sinr = power_ / (rules.noise * width_ + interference.sum);
  min_sinr_ = std::min(min_sinr_, sinr);
  worst_.sum = std::max(worst_.sum, interference.sum);
  worst_.strongest = std::max(worst_.strongest, interference.strongest);
  if (rules.error_model == ErrorModel::kDsss) {
    count_interval(sinr, heard_until_, now);
  }
  heard_until_ = now;
}

void Reception::count_interval(double sinr, hal::Time from, hal::Time to) {
  const PhyMode& mode = *ppdu_->mode;
  const hal::Time header = start_ + mode.preamble();
  const hal::Time body = start_ + mode.preamble_and_header();
  const hal::Time end = start_ + ppdu_->airtime - mode.signal_extension();
  // Most intervals belong only to the header or only to the PSDU.
  const double header_share = share(from, to, {header, body});
  if (header_share != 0) header_success_ *= mode.header_success(sinr, header_share);
  if (ppdu_->is_aggregate()) return count_parts(sinr, from, to);
  const double body_share = share(from, to, {body, end});
  if (body_share == 0) return;
  success_ *= mode.success(sinr, body_share * mode.bits_at_risk(ppdu_->psdu_bits));
}

/// The MPDUs of an A-MPDU follow each other at the rate of the PSDU.
void Reception::count_parts(double sinr, hal::Time from, hal::Time to) {
  const PhyMode& mode = *ppdu_->mode;
  const hal::Time body = start_ + mode.preamble_and_header();
  const hal::Time end = start_ + ppdu_->airtime - mode.signal_extension();
  if (to <= body) return;
  const double all = ppdu_->psdu_bits;
  const auto time_of = [&](std::uint32_t bit) {
    return body + hal::Duration{static_cast<std::int64_t>(
                      static_cast<double>((end - body).count()) * (bit / all))};
  };
  for (std::size_t i = 0; i < ppdu_->parts.size(); ++i) {
    const Ppdu::Part& part = ppdu_->parts[i];
    const double common = share(from, to, {time_of(part.begin), time_of(part.end)});
    if (common == 0) continue;
    double& success = i == 0 ? success_ : others_[i - 1];
    success *= mode.success(sinr, common * (part.end - part.begin));
  }
}

double Reception::success_at_min_sinr() const {
  return ppdu_->mode->header_success(min_sinr_, 1) *
         ppdu_->mode->success(min_sinr_, ppdu_->psdu_bits);
}

hal::Time Reception::header_end() const { return start_ + ppdu_->mode->preamble_and_header(); }

void Reception::judge_header(const ReceptionRules& rules, hal::RandomStream& errors) {
  if (header_ != Header::kComing || heard_until_ < header_end()) return;
  // Drawn even if the outcome is certain: the order in which powers are added may change the last
  // bit of a probability of 1, and must not shift the random stream.
  const bool is_right =
      rules.error_model == ErrorModel::kMobilityFramework || errors.uniform() < header_success_;
  header_ = is_right ? Header::kRight : Header::kWrong;
}

Reception::Outcome Reception::judge(std::size_t part, const ReceptionRules& rules,
                                    hal::RandomStream& errors) const {
  const bool mobility_framework = rules.error_model == ErrorModel::kMobilityFramework;
  if (mobility_framework && min_sinr_ <= rules.min_sinr) {
    return {cause_of_loss(rules, worst_), ReceiveError::kCollision};
  }
  if (mobility_framework) {
    const double success = success_at_min_sinr();
    if (success >= 1 || errors.uniform() < success) return {};
  } else if (header_ == Header::kWrong) {
    return {cause_of_loss(rules, worst_), ReceiveError::kHeader};
  } else if (errors.uniform() <
             (part == 0 ? success_
                        : others_[part - 1])) {  // drawn even if the outcome is certain, as above
    return {};
  }
  return {cause_of_loss(rules, worst_), ReceiveError::kBitError};
}

}  // namespace sim::radio
