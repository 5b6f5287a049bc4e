#include "sim/radio/phy/reception.h"

#include <algorithm>
#include <limits>

#include "hal/types/math.h"
#include "sim/radio/channel/propagation.h"

namespace sim::radio {
namespace {

/// Duration of the part of [from, to) that lies in [low, high).
hal::Duration overlap(hal::Time from, hal::Time to, hal::Time low, hal::Time high) {
  return std::max(hal::Duration{}, std::min(to, high) - std::max(from, low));
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

Reception::Reception(const Frame& frame, double power, hal::Time start, hal::Time locked)
    : frame_(&frame),
      power_(power),
      start_(start),
      locked_(locked),
      heard_until_(locked),
      min_sinr_(std::numeric_limits<double>::infinity()) {}

void Reception::hear(const ReceptionRules& rules, const Interference& interference, hal::Time now) {
  if (now == heard_until_) return;
  const double sinr = power_ / (rules.noise + interference.sum);
  min_sinr_ = std::min(min_sinr_, sinr);
  worst_.sum = std::max(worst_.sum, interference.sum);
  worst_.strongest = std::max(worst_.strongest, interference.strongest);
  if (rules.error_model == ErrorModel::kDsss) {
    success_ *= success_of_interval(sinr, heard_until_, now);
  }
  heard_until_ = now;
}

double Reception::success_of_interval(double sinr, hal::Time from, hal::Time to) const {
  const PhyMode& mode = *frame_->mode;
  const hal::Time header = start_ + mode.preamble();
  const hal::Time body = start_ + mode.preamble_and_header();
  const hal::Time end = start_ + frame_->airtime - mode.signal_extension();
  // Most intervals belong only to the header or only to the MPDU.
  const auto share = [from, to](hal::Time low, hal::Time high) {
    const hal::Duration common = overlap(from, to, low, high);
    return common == hal::Duration{} ? 0.0 : hal::to_seconds(common) / hal::to_seconds(high - low);
  };
  const double header_share = share(header, body), body_share = share(body, end);
  double success = header_share == 0 ? 1 : mode.header_success(sinr, header_share);
  if (body_share != 0) {
    success *= mode.success(sinr, body_share * mode.bits_at_risk(frame_->air_length));
  }
  return success;
}

double Reception::success_at_min_sinr() const {
  return frame_->mode->header_success(min_sinr_, 1) *
         frame_->mode->success(min_sinr_, frame_->air_length);
}

hal::Time Reception::header_end() const { return start_ + frame_->mode->preamble_and_header(); }

void Reception::judge_header(const ReceptionRules& rules, hal::RandomStream& errors) {
  if (header_ != Header::kComing || heard_until_ < header_end()) return;
  // Drawn even if the outcome is certain: the order in which powers are added may change the last
  // bit of a probability of 1, and must not shift the random stream.
  const bool is_right =
      rules.error_model == ErrorModel::kMobilityFramework || errors.uniform() < success_;
  header_ = is_right ? Header::kRight : Header::kWrong;
  success_ = 1;
}

Reception::Outcome Reception::judge(const ReceptionRules& rules, hal::RandomStream& errors) const {
  const bool mobility_framework = rules.error_model == ErrorModel::kMobilityFramework;
  if (mobility_framework && min_sinr_ <= rules.min_sinr) {
    return {cause_of_loss(rules, worst_), ReceiveError::kCollision};
  }
  if (mobility_framework) {
    const double success = success_at_min_sinr();
    if (success >= 1 || errors.uniform() < success) return {};
  } else if (header_ == Header::kWrong) {
    return {cause_of_loss(rules, worst_), ReceiveError::kHeader};
  } else if (errors.uniform() < success_) {  // drawn even if the outcome is certain, as above
    return {};
  }
  return {cause_of_loss(rules, worst_), ReceiveError::kBitError};
}

}  // namespace sim::radio
