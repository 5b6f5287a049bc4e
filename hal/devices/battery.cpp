#include "hal/devices/battery.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "hal/types/check.h"

namespace hal::devices {

Channel Battery::describe() const {
  Channel channel;
  channel.name = mount.name;
  channel.kind = std::string(kKind);
  channel.unit = "1, V, A";
  channel.length = 3;
  channel.frame = "base";
  return channel;
}

void Discharge::draw(double joules, Duration over) {
  BARAKA_CHECK(joules >= 0 && over > Duration::zero());
  const double seconds = to_seconds(over);
  const double power = joules / seconds;
  const double open = open_voltage();
  const double resistance = battery_.resistance;
  // The same root without the difference of two large numbers; it is right for R = 0, too.
  const double discriminant = std::max(0.0, open * open - 4 * resistance * power);
  const double limit = resistance > 0 ? open / (2 * resistance) : power / open;
  current_ = std::min(limit, 2 * power / (open + std::sqrt(discriminant)));
  charge_ = std::max(0.0, charge_ - open * current_ * seconds / battery_.capacity);
}

void Discharge::take(double joules) {
  charge_ = std::clamp(charge_ - joules / battery_.capacity, 0.0, 1.0);
}

double Discharge::voltage() const { return open_voltage() - battery_.resistance * current_; }

double Discharge::open_voltage() const {
  return battery_.empty_voltage + charge_ * (battery_.full_voltage - battery_.empty_voltage);
}

}  // namespace hal::devices
