#pragma once

#include <memory>
#include <string>

#include "hal/robot/drivers/device_times.h"
#include "hal/robot/drivers/infrared.h"
#include "hal/robot/platform/device_thread.h"
#include "hal/robot/platform/latest.h"

namespace hal::robot::drivers {

/// A device with infrared sensors. Both calls come from one thread.
class InfraredDevice {
 public:
  virtual ~InfraredDevice() = default;
  /// Connects to the device.
  virtual Result<void> connect() { return {}; }
  /// One measurement; ThreadedInfrared sets its stamp.
  virtual Result<InfraredReadings> measure() = 0;
};

/// An InfraredDriver that measures periodically.
class ThreadedInfrared final : public InfraredDriver, private platform::Device {
 public:
  ThreadedInfrared(std::unique_ptr<InfraredDevice> device, const DeviceTimes& times);
  ~ThreadedInfrared() override { thread_.finish(); }

  Result<InfraredReadings> latest() const override { return latest_.get(thread_); }
  bool connected() const override { return thread_.connected(); }
  std::string trouble() const override { return thread_.trouble(); }
  platform::DeviceCounts counts() const override { return thread_.counts(); }

 private:
  Result<void> connect() override;
  Result<void> work() override;

  std::unique_ptr<InfraredDevice> device_;
  platform::Latest<InfraredReadings> latest_;
  platform::DeviceThread thread_;  ///< Last, because it uses the others.
};

}  // namespace hal::robot::drivers
