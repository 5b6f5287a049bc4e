#include <memory>

#include "hal/robot/drivers/odometry_frame.h"
#include "hal/robot/drivers/robotino.h"
#include "hal/robot/drivers/robotino_rest.h"
#include "hal/robot/drivers/threaded_wheels.h"
#include "hal/robot/platform/device_thread.h"
#include "hal/robot/platform/latest.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;

/// Festo, "Rest API": omnidrive must be repeated at least every 200 ms, or the robot stops.
constexpr Duration kStopsAfter = 200ms;

Duration silence_of(const DeviceTimes& times) { return times.period + 3 * times.timeout; }

/// Polls the odometry.
class RobotinoOdometry final : private platform::Device {
 public:
  explicit RobotinoOdometry(const RobotinoSettings& settings)
      : rest_(settings),
        latest_(settings.times.stale_after),
        thread_(*this, {settings.times.period, {}, silence_of(settings.times)}) {}
  ~RobotinoOdometry() override { thread_.finish(); }

  Result<WheelState> latest() const { return latest_.get(thread_); }
  std::uint64_t bad_answers() const { return thread_.counts().bad_answers; }

 private:
  Result<void> connect() override { return work(); }

  Result<void> work() override {
    const auto odometry = rest_.odometry();
    if (!odometry) return tl::unexpected<Error>(odometry.error());
    // A measurement that was seen before does not become newer.
    if (known_ && odometry->sequence == sequence_) return {};
    known_ = true;
    sequence_ = odometry->sequence;
    latest_.set({frame_.update(odometry->pose, odometry->sequence), odometry->twist,
                 platform::BootClock::now()});
    return {};
  }

  RobotinoRest rest_;
  OdometryFrame frame_;
  bool known_ = false;
  double sequence_ = 0;
  platform::Latest<WheelState> latest_;
  platform::DeviceThread thread_;  ///< Last, because it uses the others.
};

class RobotinoWheels final : public WheelDevice {
 public:
  explicit RobotinoWheels(const RobotinoSettings& settings)
      : rest_(settings), odometry_(settings) {}

  Result<void> connect() override {
    if (const auto sent = rest_.put_velocity({}); !sent) return tl::unexpected<Error>(sent.error());
    return {};
  }

  Result<Sent> send(const TimedVelocity& velocity) override {
    const auto sent = rest_.put_velocity(velocity);
    if (!sent) return tl::unexpected<Error>(sent.error());
    return Sent{.body = *sent, .confirmed = true};
  }

  Result<WheelState> state(const platform::DeviceThread&) const override {
    return odometry_.latest();
  }
  std::uint64_t passed_over() const override { return odometry_.bad_answers(); }

 private:
  RobotinoRest rest_;
  RobotinoOdometry odometry_;
};

}  // namespace

std::unique_ptr<WheelDriver> make_robotino_wheels(const RobotinoSettings& settings,
                                                  const DrivenRobot& robot) {
  const platform::DeviceThread::Rules rules{settings.times.period, kStopsAfter,
                                            silence_of(settings.times)};
  return std::make_unique<ThreadedWheels>(
      std::make_unique<RobotinoWheels>(settings),
      ThreadedWheels::Setup{node::devices::WheelDrive(robot.description.wheels), robot.limits,
                            robot.command_timeout, rules});
}

}  // namespace hal::robot::drivers
