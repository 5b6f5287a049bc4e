#include "sim/radio/possible_verdicts.h"

namespace sim::radio {

using hal::Verdict;

std::vector<Verdict> reception_verdicts(const RadioConfig& config) {
  std::vector<Verdict> verdicts = {Verdict::kDelivered, Verdict::kBelowSensitivity,
                                   Verdict::kRadioOff};
  if (waves_of(config) == nullptr) return verdicts;
  verdicts.insert(verdicts.end(), {Verdict::kPreambleMissed, Verdict::kCollision,
                                   Verdict::kInterference, Verdict::kNoise, Verdict::kObstacle,
                                   Verdict::kReceiverTransmitting, Verdict::kRandomLoss});
  return verdicts;
}

std::vector<Verdict> request_verdicts(const RadioConfig& config, bool has_access_points) {
  std::vector<Verdict> verdicts = {Verdict::kDelivered, Verdict::kRetryLimit, Verdict::kRadioOff};
  // Only the queue of the ideal radio is unlimited.
  if (!std::holds_alternative<IdealConfig>(config)) verdicts.push_back(Verdict::kQueueFull);
  if (dcf_of(config) != nullptr) {
    verdicts.insert(verdicts.end(), {Verdict::kExpired, Verdict::kQueueDelay});
  }
  if (has_access_points) verdicts.push_back(Verdict::kNoRoute);
  return verdicts;
}

}  // namespace sim::radio
