#include "hal/robot/drivers/threaded_infrared.h"

#include <utility>

namespace hal::robot::drivers {

ThreadedInfrared::ThreadedInfrared(std::unique_ptr<InfraredDevice> device, const DeviceTimes& times)
    : device_(std::move(device)),
      latest_(times.stale_after),
      thread_(*this,
              {.period = times.period, .late = {}, .silence = times.period + 3 * times.timeout}) {}

Result<void> ThreadedInfrared::connect() {
  if (auto connected = device_->connect(); !connected) return connected;
  return work();
}

Result<void> ThreadedInfrared::work() {
  Result<InfraredReadings> readings = device_->measure();
  if (!readings) return tl::unexpected<Error>(readings.error());
  readings->stamp = platform::BootClock::now();
  latest_.set(std::move(*readings));
  return {};
}

}  // namespace hal::robot::drivers
