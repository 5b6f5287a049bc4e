#include "hal/robot/drivers/tmc200.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "hal/node/devices/odometry.h"
#include "hal/robot/drivers/threaded_wheels.h"
#include "hal/robot/drivers/tmc200_protocol.h"
#include "hal/robot/platform/device_thread.h"
#include "hal/robot/platform/latest.h"
#include "hal/robot/platform/serial_line.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;

/// An answer takes about 5 ms at 57600 baud. A later one is read with the next exchange.
constexpr Duration kUsualAnswer = 15ms;

/// Longest wait until the last command has been sent.
constexpr Duration kFarewell = 200ms;

/// Maximum number of lines read at once: a line that sends continuously must not delay commands.
constexpr int kMostLines = 32;

class Tmc200 final : public WheelDevice {
 public:
  Tmc200(const Tmc200Settings& settings, const node::devices::RobotDescription& robot)
      : settings_(settings),
        protocol_(settings, robot),
        wheels_(robot.wheels),
        odometry_(wheels_),
        angles_(robot.wheels.size(), 0.0),
        latest_(settings.times.stale_after) {}
  ~Tmc200() override { line_.drain(kFarewell); }

  Result<void> connect() override;
  Result<Sent> send(const TimedVelocity& velocity) override;
  Result<WheelState> state(const platform::DeviceThread& thread) const override {
    return latest_.get(thread);
  }
  std::uint64_t passed_over() const override { return passed_over_; }

 private:
  Result<void> ask(const std::string& command);
  bool is_stuck() const;
  Result<void> read_late_answers();
  Result<bool> take_line(Duration at_most);
  void move(const std::vector<double>& speeds);

  Tmc200Settings settings_;
  Tmc200Protocol protocol_;
  node::devices::WheelDrive wheels_;
  node::devices::WheelOdometry odometry_;
  std::vector<double> angles_;  ///< Wheel angles, rad.
  platform::SerialLine line_;
  int unanswered_ = 0;             ///< Number of unanswered SVs.
  platform::BootTime sent_{};      ///< Time of the last SV.
  platform::BootTime answered_{};  ///< Time of the last answer to SV, or of the connection.
  platform::Latest<WheelState> latest_;
  std::atomic<std::uint64_t> passed_over_{0};
};

Result<void> Tmc200::connect() {
  if (auto opened = line_.open(settings_.device); !opened) return opened;
  // Terminates a partial command that may be left in the controller.
  if (auto sent = line_.write("\n"); !sent) return sent;
  for (const std::string& command : protocol_.set_up()) {
    if (auto done = ask(command); !done) return done;
  }
  unanswered_ = 0;
  answered_ = platform::BootClock::now();
  if (const auto sent = send({}); !sent) return tl::unexpected<Error>(sent.error());
  return {};
}

/// Sends a command of the set-up and waits for its "OK", ignoring other lines.
Result<void> Tmc200::ask(const std::string& command) {
  if (auto sent = line_.write(command); !sent) return sent;
  const platform::BootTime end = platform::BootClock::now() + settings_.times.timeout;
  std::string other = "silence";
  while (true) {
    const Duration left = end - platform::BootClock::now();
    if (left <= Duration::zero()) break;
    const auto line = line_.read(left);
    if (!line) return tl::unexpected<Error>(line.error());
    if (!*line) break;
    if (Tmc200Protocol::is_ok(**line)) return {};
    other = fmt::format("'{:.60}'", **line);
  }
  const Errc code = other == "silence" ? Errc::kTimeout : Errc::kProtocol;
  return fail(code, fmt::format("TMC200: {} after '{}', 'OK' expected", other,
                                command.substr(0, command.find_last_not_of(" \n") + 1)));
}

Result<WheelDevice::Sent> Tmc200::send(const TimedVelocity& velocity) {
  if (const auto read = read_late_answers(); !read) return tl::unexpected<Error>(read.error());
  std::string moving = protocol_.set_speeds(wheels_.wheel_speeds(velocity.body));
  std::string standing = protocol_.set_speeds(wheels_.wheel_speeds({}));
  if (is_stuck()) {
    // Otherwise the motors would get this velocity when the line recovers. The rest of a partly
    // sent line must not join the next one.
    line_.forget_unsent();
    for (std::string* line : {&moving, &standing}) line->insert(line->begin(), '\n');
  }
  const Twist2 body = velocity.at(platform::BootClock::now());
  const auto sent = line_.write(body == Twist2{} ? standing : moving);
  if (!sent) return tl::unexpected<Error>(sent.error());
  ++unanswered_;
  sent_ = platform::BootClock::now();
  for (int lines = 0; unanswered_ > 0 && lines < kMostLines; ++lines) {
    const Duration left = sent_ + kUsualAnswer - platform::BootClock::now();
    const auto took = take_line(std::max(left, Duration::zero()));
    if (!took) return tl::unexpected<Error>(took.error());
    if (!*took) break;
  }
  const Duration silence = platform::BootClock::now() - answered_;
  if (silence > settings_.times.period + settings_.times.timeout) {
    return fail(Errc::kTimeout,
                fmt::format("TMC200: no answer to SV for {:.3f} s", to_seconds(silence)));
  }
  return Sent{.body = body, .confirmed = unanswered_ == 0};
}

/// Whether the last SV has not been sent yet.
bool Tmc200::is_stuck() const {
  return platform::BootClock::now() - sent_ > kUsualAnswer && line_.unsent() > 0;
}

/// Reads what arrived since the last exchange. Answers that are still missing were lost.
Result<void> Tmc200::read_late_answers() {
  for (int lines = 0; lines < kMostLines; ++lines) {
    const auto took = take_line(0ms);
    if (!took) return tl::unexpected<Error>(took.error());
    if (!*took) break;
  }
  if (platform::BootClock::now() - sent_ > 2 * kUsualAnswer) unanswered_ = 0;
  return {};
}

/// Takes one line as an answer to SV; invalid lines are counted and ignored.
/// @return false: no line arrived in time.
Result<bool> Tmc200::take_line(Duration at_most) {
  const auto line = line_.read(at_most);
  if (!line && line.error().code != Errc::kProtocol) return tl::unexpected<Error>(line.error());
  if (line && !*line) return false;
  const auto speeds =
      line ? protocol_.measured(**line) : Result<std::vector<double>>(tl::unexpected(line.error()));
  if (speeds) {
    unanswered_ = std::max(0, unanswered_ - 1);
    move(*speeds);
  } else {
    ++passed_over_;
  }
  return true;
}

/// Moves the odometry, assuming that the wheels had these speeds since the last answer.
void Tmc200::move(const std::vector<double>& speeds) {
  const platform::BootTime now = platform::BootClock::now();
  const Duration elapsed = std::max(Duration{now - answered_}, Duration{1});
  answered_ = now;
  // In a longer gap the speeds are unknown.
  const double seconds = to_seconds(std::min(elapsed, settings_.times.timeout));
  for (std::size_t i = 0; i < angles_.size(); ++i) angles_[i] += speeds[i] * seconds;
  odometry_.update(angles_, elapsed);
  latest_.set({odometry_.pose(), wheels_.body_velocity(speeds), now});
}

}  // namespace

std::unique_ptr<WheelDriver> make_tmc200_wheels(const Tmc200Settings& settings,
                                                const DrivenRobot& robot) {
  const DeviceTimes& times = settings.times;
  const platform::DeviceThread::Rules rules{times.period, settings.cut_off,
                                            times.period + 3 * times.timeout};
  return std::make_unique<ThreadedWheels>(
      std::make_unique<Tmc200>(settings, robot.description),
      ThreadedWheels::Setup{node::devices::WheelDrive(robot.description.wheels), robot.limits,
                            robot.command_timeout, rules});
}

}  // namespace hal::robot::drivers
