#include "sim/radio/reception.h"

#include <algorithm>
#include <limits>

#include "hal/types/math.h"
#include "sim/radio/error_model.h"
#include "sim/radio/propagation.h"

namespace sim::radio {
namespace {

constexpr hal::BitsPerSecond kPlcpRate{1e6};
constexpr double kPlcpHeaderBits = 48;

/// How much of [from, to) lies in [low, high).
hal::Duration overlap(hal::Time from, hal::Time to, hal::Time low, hal::Time high) {
  return std::max(hal::Duration{}, std::min(to, high) - std::max(from, low));
}

}  // namespace

ReceptionRules::ReceptionRules(const RadioConfig& config)
    : error_model(config.error_model),
      min_sinr(hal::math::pow(10, config.min_sinr.value / 10)),
      noise(to_milliwatts(config.noise_floor).value),
      sensitivity(to_milliwatts(config.sensitivity).value),
      airtime(config) {}

hal::Verdict cause_of_loss(const ReceptionRules& rules, const Interference& interference) {
  if (interference.sum < rules.noise) return hal::Verdict::kNoise;
  return interference.strongest >= rules.sensitivity ? hal::Verdict::kCollision
                                                     : hal::Verdict::kInterference;
}

Reception::Reception(const Frame& frame, double power, hal::Time start, hal::Time locked)
    : frame_(&frame),
      power_(power),
      start_(start),
      heard_until_(locked),
      min_sinr_(std::numeric_limits<double>::infinity()) {}

void Reception::hear(const ReceptionRules& rules, const Interference& interference, hal::Time now) {
  if (now == heard_until_) return;
  const double sinr = power_ / (rules.noise + interference.sum);
  min_sinr_ = std::min(min_sinr_, sinr);
  worst_.sum = std::max(worst_.sum, interference.sum);
  worst_.strongest = std::max(worst_.strongest, interference.strongest);
  if (rules.error_model == ErrorModel::kDsss) {
    success_ *= success_of_interval(rules, sinr, heard_until_, now);
  }
  heard_until_ = now;
}

double Reception::success_of_interval(const ReceptionRules& rules, double sinr, hal::Time from,
                                      hal::Time to) const {
  const hal::Time header = start_ + rules.airtime.preamble(frame_->rate);
  const hal::Time body = start_ + rules.airtime.plcp(frame_->rate);
  const hal::Time end = start_ + frame_->airtime;
  const double header_share =
      hal::to_seconds(overlap(from, to, header, body)) / hal::to_seconds(body - header);
  const double body_share =
      hal::to_seconds(overlap(from, to, body, end)) / hal::to_seconds(end - body);
  return success_probability(rules.error_model, sinr, kPlcpRate, header_share * kPlcpHeaderBits) *
         success_probability(rules.error_model, sinr, frame_->rate,
                             body_share * frame_->air_length);
}

double Reception::success_at_min_sinr(const ReceptionRules& rules) const {
  return success_probability(rules.error_model, min_sinr_, kPlcpRate, kPlcpHeaderBits) *
         success_probability(rules.error_model, min_sinr_, frame_->rate, frame_->air_length);
}

bool Reception::in_plcp(const ReceptionRules& rules, hal::Time now) const {
  return now < start_ + rules.airtime.plcp(frame_->rate);
}

Reception::Outcome Reception::judge(const ReceptionRules& rules, hal::RandomStream& errors) const {
  const bool mobility_framework = rules.error_model == ErrorModel::kMobilityFramework;
  if (mobility_framework && min_sinr_ <= rules.min_sinr) {
    return {cause_of_loss(rules, worst_), ReceiveError::kCollision};
  }
  const double success = mobility_framework ? success_at_min_sinr(rules) : success_;
  if (success >= 1 || errors.uniform() < success) return {};
  return {cause_of_loss(rules, worst_), ReceiveError::kBitError};
}

}  // namespace sim::radio
