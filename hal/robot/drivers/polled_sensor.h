#pragma once

#include <utility>

#include "hal/robot/drivers/device_times.h"
#include "hal/robot/drivers/sensor_driver.h"
#include "hal/robot/platform/device_thread.h"
#include "hal/robot/platform/latest.h"

namespace hal::robot::drivers {

/// A sensor that is queried once per period.
/// @tparam Source  has `Result<std::vector<double>> measure()`, called from one thread.
template <class Source>
class PolledSensor final : public SensorDriver, private platform::Device {
 public:
  PolledSensor(Source source, const DeviceTimes& times)
      : source_(std::move(source)),
        latest_(times.stale_after),
        thread_(*this, {times.period, {}, times.period + 3 * times.timeout}) {}
  ~PolledSensor() override { thread_.finish(); }

  Result<SensorReading> latest() const override { return latest_.get(thread_); }
  bool connected() const override { return thread_.connected(); }
  std::string trouble() const override { return thread_.trouble(); }
  platform::DeviceCounts counts() const override { return thread_.counts(); }

 private:
  Result<void> connect() override { return work(); }
  Result<void> work() override {
    auto values = source_.measure();
    if (!values) return tl::unexpected<Error>(values.error());
    latest_.set({std::move(*values), platform::BootClock::now()});
    return {};
  }

  Source source_;
  platform::Latest<SensorReading> latest_;
  platform::DeviceThread thread_;  ///< Last, because it uses the others.
};

}  // namespace hal::robot::drivers
