#pragma once

#include <utility>

#include "hal/hardware/drivers/device_times.h"
#include "hal/hardware/drivers/sensor_driver.h"
#include "hal/hardware/platform/device_thread.h"
#include "hal/hardware/platform/latest.h"

namespace hal::hardware {

/// A sensor that is asked once per period.
/// @tparam Source  has `Result<std::vector<double>> measure()`, called from one thread.
template <class Source>
class PolledSensor final : public SensorDriver, private Device {
 public:
  PolledSensor(Source source, const DeviceTimes& times)
      : source_(std::move(source)),
        latest_(times.stale_after),
        thread_(*this, {times.period, {}, times.period + 3 * times.timeout}) {}
  ~PolledSensor() override { thread_.finish(); }

  Result<SensorReading> latest() const override { return latest_.get(thread_); }
  bool connected() const override { return thread_.connected(); }
  std::string trouble() const override { return thread_.trouble(); }
  DeviceCounts counts() const override { return thread_.counts(); }

 private:
  Result<void> connect() override { return work(); }
  Result<void> work() override {
    auto values = source_.measure();
    if (!values) return tl::unexpected<Error>(values.error());
    latest_.set({std::move(*values), BootClock::now()});
    return {};
  }

  Source source_;
  Latest<SensorReading> latest_;
  DeviceThread thread_;  ///< Last: it uses the others.
};

}  // namespace hal::hardware
