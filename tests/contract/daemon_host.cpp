#include <chrono>
#include <cmath>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "gateway/process/domains.h"
#include "gateway/server/server.h"
#include "hal/robot/agent/hardware_agent.h"
#include "hal/robot/drivers/iio.h"
#include "hal/robot/drivers/iio_imu.h"
#include "hal/robot/drivers/power_supply.h"
#include "tests/contract/contract_host.h"
#include "tests/support/sysfs_folder.h"
#include "tests/support/test_domain.h"
#include "tests/unit/hal/robot/agent/fakes.h"

namespace contract {
namespace {

using namespace std::chrono_literals;
using hal::robot::platform::EventLoop;

hal::robot::agent::RobotFile file_of(hal::AgentId agent, const std::string& name,
                                     hal::Duration control_period) {
  hal::robot::agent::RobotFile file;
  file.name = name;
  file.address = agent;
  file.program = "contract";
  file.control_period = control_period;
  file.command_timeout = 200ms;
  file.routing.jitter_max = 1ms;
  file.routing.retry_period = 200ms;
  file.localisation.map = {{kRobot, "r0", {}}, {kMote, "m0", {}}};
  if (agent == kRobot) {
    file.kind = hal::AgentKind::kRobot;
    file.robot.emplace();
    file.robot->wheels = hal::robot::drivers::three_wheels();
    file.robot->infrared.resize(1);
    file.infrared =
        std::make_shared<hal::robot::drivers::ChosenDriver<hal::robot::drivers::InfraredDriver,
                                                           hal::robot::drivers::IioSettings>>(
            hal::robot::drivers::IioSettings{}, hal::robot::drivers::make_iio_infrared);
    file.robot->sensors = {hal::node::devices::Battery{}, hal::node::devices::ImuSensor{}};
  }
  return file;
}

/// The gauge and the inertial unit of the robot, as Linux shows them, and their drivers.
class RobotSensors {
 public:
  RobotSensors() {
    supply_.set("capacity", "73");
    supply_.set("voltage_now", "12000000");
    for (const std::string axis : {"x", "y", "z"}) {
      imu_.set("in_anglvel_" + axis + "_raw", "0");
      imu_.set("in_accel_" + axis + "_raw", axis == "z" ? "981" : "0");
    }
    imu_.set("in_anglvel_scale", "0.001");
    imu_.set("in_accel_scale", "0.01");
  }

  /// @pre the file has a robot.
  void add_to(hal::robot::agent::RobotFile& file) const {
    using namespace hal::robot::drivers;
    const DeviceTimes times{10ms, 100ms, 60s};
    file.sensors = {{0, std::make_shared<ChosenSensor<PowerSupplySettings>>(
                            PowerSupplySettings{supply_.path(), times, 1000}, make_power_supply)},
                    {1, std::make_shared<ChosenSensor<IioImuSettings>>(
                            IioImuSettings{imu_.path(), times}, make_iio_imu)}};
  }

 private:
  tests::SysfsFolder supply_, imu_;
};

/// One agent with its radio and, in a domain, its server, as a daemon has them.
class Daemon final : public hal::node::agent::AgentObserver {
 public:
  Daemon(hal::robot::agent::RobotFile file, std::uint16_t port, EventLoop& loop,
         std::optional<int> domain, Sight& sight)
      : file_(std::move(file)),
        sensors_(make_sensors(file_)),
        loop_(loop),
        sight_(sight),
        link_({.self = file_.address,
               .interface = "lo",
               .address = "127.0.79." + std::to_string(file_.address.value),
               .port = port},
              loop),
        agent_(file_, {loop, link_, devices(), *this}) {
    if (!domain) return;
    server_.emplace(
        gateway::process::join_domain(*domain), agent_,
        gateway::server::ServerSettings{
            .run = 1, .reply_timeout = {}, .attendance = gateway::server::Attendance::kAnyTime});
    attend();
  }

  void connect(std::shared_ptr<hal::node::exchange::ControllerPort> controller,
               const hal::Wants& wants) {
    agent_.connect(std::move(controller), {file_.address}, wants);
  }

  std::uint16_t port() const { return link_.port(); }
  std::vector<hal::node::exchange::AgentName> directory() const { return agent_.directory(); }
  void stop() { agent_.stop(); }
  bool is_over() const { return agent_.is_over(); }
  hal::robot::agent::AgentCounts counts() const { return agent_.counts(); }

  void on_state(hal::Time, hal::AgentId agent, std::string_view state) override {
    sight_.on_state(agent, std::string(state));
  }
  void on_record(hal::Time, hal::AgentId agent, std::string_view name, double value) override {
    sight_.on_record(agent, std::string(name), value);
  }
  bool observes_readings() const override { return true; }
  bool observes(hal::AgentId, const hal::Channel& channel) const override {
    return channel.kind == "range";
  }
  void on_reading(hal::Time, hal::AgentId agent, const hal::Channel&,
                  std::span<const double>) override {
    sight_.on_range(agent);
  }
  void on_cycle(hal::Time, hal::AgentId) override {
    if (file_.robot) sight_.on_speed(std::hypot(wheels_.twist.vx, wheels_.twist.vy));
  }

 private:
  hal::robot::agent::Devices devices() {
    if (!file_.robot) return {};
    hal::robot::agent::Devices devices{.wheels = &wheels_, .infrared = &infrared_};
    for (const auto& sensor : sensors_) devices.sensors.push_back(sensor.get());
    return devices;
  }
  void attend() {
    for (const EventLoop::Watch watch : std::exchange(watches_, {})) loop_.unwatch(watch);
    server_->attend(loop_.now());
    for (const int descriptor : server_->descriptors()) {
      if (descriptor >= 0) watches_.push_back(loop_.watch(descriptor, [this] { attend(); }));
    }
  }

  hal::robot::agent::RobotFile file_;
  std::vector<std::unique_ptr<hal::robot::drivers::SensorDriver>> sensors_;
  EventLoop& loop_;
  Sight& sight_;
  hal::robot::agent::RecordedWheels wheels_;
  hal::robot::agent::FixedInfrared infrared_;
  hal::robot::radio::UdpLink link_;
  hal::robot::agent::HardwareAgent agent_;
  std::optional<gateway::server::AgentServer> server_;
  std::vector<EventLoop::Watch> watches_;
};

class DaemonHost final : public ContractHost {
 public:
  DaemonHost(hal::Duration control_period, std::optional<int> domain)
      : domain_(domain), thread_([this, control_period] { run(control_period); }) {
    ready_.get_future().wait();
  }
  ~DaemonHost() override { end(); }

  std::optional<int> domain() const override { return domain_; }
  const Sight& sight() const override { return sight_; }
  hal::node::exchange::DriveLimits limits() const override {
    return hal::robot::agent::RecordedWheels().limits();
  }
  void connect(std::shared_ptr<hal::node::exchange::ControllerPort> controller, hal::AgentId agent,
               const hal::Wants& wants) override {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({std::move(controller), agent, wants});
  }
  std::vector<hal::node::exchange::AgentName> directory(hal::AgentId agent) const override {
    return directories_.at(agent);
  }
  End end() override {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    return end_;
  }

 private:
  void run(hal::Duration control_period) {
    EventLoop loop;
    const RobotSensors sensors;
    hal::robot::agent::RobotFile file = file_of(kRobot, "r0", control_period);
    sensors.add_to(file);
    Daemon robot(std::move(file), 0, loop, domain_, sight_);
    Daemon mote(file_of(kMote, "m0", control_period), robot.port(), loop, domain_, sight_);
    directories_ = {{kRobot, robot.directory()}, {kMote, mote.directory()}};
    ready_.set_value();
    while (!stop_) {
      for (auto& [controller, agent, wants] : newcomers()) {
        (agent == kRobot ? robot : mote).connect(std::move(controller), wants);
      }
      loop.run_once(20ms);
    }
    robot.stop();
    mote.stop();
    const hal::Time end = loop.now() + 2s;
    while (!(robot.is_over() && mote.is_over()) && loop.now() < end) loop.run_once(5ms);
    end_ = {robot.counts().overflow + mote.counts().overflow,
            robot.counts().refused_actions + mote.counts().refused_actions};
  }

  struct Newcomer {
    std::shared_ptr<hal::node::exchange::ControllerPort> controller;
    hal::AgentId agent;
    hal::Wants wants;
  };
  std::vector<Newcomer> newcomers() {
    const std::lock_guard lock(mutex_);
    return std::exchange(waiting_, {});
  }

  Sight sight_;
  std::mutex mutex_;
  std::vector<Newcomer> waiting_;  ///< For the thread.
  std::atomic<bool> stop_ = false;
  End end_;  ///< Of the thread until it has ended.
  std::optional<int> domain_;
  std::map<hal::AgentId, std::vector<hal::node::exchange::AgentName>>
      directories_;  ///< Once ready.
  std::promise<void> ready_;
  std::thread thread_;
};

}  // namespace

Implementation two_daemons(hal::Duration control_period) {
  return {"TwoDaemons", {.takes_successors = true, .has_neighbours = true}, [control_period] {
            return std::make_unique<DaemonHost>(control_period, test_domain());
          }};
}

Implementation two_daemons_in_process() {
  return {"TwoDaemonsInProcess", {.takes_successors = true}, [] {
            return std::make_unique<DaemonHost>(20ms, std::nullopt);
          }};
}

}  // namespace contract
