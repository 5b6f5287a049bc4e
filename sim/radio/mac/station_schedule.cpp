#include "sim/radio/mac/station_schedule.h"

namespace sim::radio {

void StationSchedule::add(hal::AgentId receiver) {
  Share& share = shares_[receiver];
  if (share.is_listed) return;
  share.is_listed = true;
  new_.push_back(receiver);
}

void StationSchedule::charge(hal::AgentId receiver, hal::Duration airtime) {
  hal::Duration& deficit = shares_[receiver].deficit;
  deficit = quantum_ ? deficit - airtime : hal::Duration{};
}

}  // namespace sim::radio
