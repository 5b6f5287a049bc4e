#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "hal/robot/platform/boot_time.h"
#include "hal/robot/platform/device_counts.h"
#include "hal/types/result.h"
#include "hal/types/time.h"

namespace hal::robot::platform {

/// The operations of a thread on a device. All are called from that thread.
class Device {
 public:
  virtual ~Device() = default;
  /// Connects to the device. Must not take much longer than the device's time-out.
  virtual Result<void> connect() = 0;
  /// Performs one exchange with the device.
  virtual Result<void> work() = 0;
  /// An exchange failed: the device is disconnected until connect() succeeds again.
  virtual void on_lost() {}
  /// Called at the end if the device is connected.
  virtual void leave() {}
};

/// Communicates with one device periodically from its own thread.
///
///         ┌────── wait 100 ms, 200 ms, 400 ms, … 2 s ◀──────┐
///         ▼                                                 │ fails
///   DISCONNECTED ── connect() ──▶ CONNECTED ── work() ──────┤
///         │ fails                     ▲                     │ succeeds
///         └──▶ wait …                 └── wait a period ◀───┘  (or until woken)
class DeviceThread {
 public:
  static constexpr Duration kFirstBackOff{100'000'000};
  static constexpr Duration kLongestBackOff{2'000'000'000};

  struct Rules {
    Duration period{};   ///< From one exchange to the next, > 0.
    Duration late{};     ///< Exchanges with a longer interval are counted as late; 0: none is.
    Duration silence{};  ///< Time without a success after which the device counts as disconnected.
  };

  /// Starts at once. @param device  outlives finish().
  DeviceThread(Device& device, const Rules& rules);
  ~DeviceThread() { finish(); }
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  /// Requests an immediate exchange. A wait before a connection attempt is not shortened.
  void wake();

  /// Calls leave(), ends the thread and waits for it.
  void finish();

  bool connected() const;
  std::string trouble() const;  ///< Why the device is not connected; empty while it is.
  DeviceCounts counts() const;

 private:
  void run();
  bool connect();
  bool work();
  void note(const Error& error);
  void note_success();
  bool fresh() const;  ///< @pre mutex_ is held.
  /// @return false: the thread must end.
  bool wait(Duration at_most, bool may_be_woken);

  Device& device_;
  Rules rules_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool connected_ = false;
  bool woken_ = false;
  bool ending_ = false;
  std::string trouble_ = "not reached yet";
  DeviceCounts counts_;
  BootTime last_success_{};
  std::thread thread_;
};

}  // namespace hal::robot::platform
