#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "gateway/server.h"
#include "hal/dds/domains.h"
#include "hal/hardware/hardware_agent.h"
#include "tests/contract/contract_host.h"
#include "tests/support/test_domain.h"
#include "tests/unit/hal/hardware/fakes.h"

namespace contract {
namespace {

using namespace std::chrono_literals;
using hal::hardware::EventLoop;

hal::hardware::RobotFile file_of(hal::AgentId agent, const std::string& name,
                                 hal::Duration control_period) {
  hal::hardware::RobotFile file;
  file.name = name;
  file.address = agent;
  file.program = "contract";
  file.control_period = control_period;
  file.command_timeout = 200ms;
  file.routing.jitter_max = 1ms;
  file.routing.retry_period = 200ms;
  if (agent == kRobot) {
    file.kind = hal::AgentKind::kRobot;
    file.robot.emplace();
    file.robot->wheels = hal::hardware::three_wheels();
  }
  return file;
}

/// One agent with its radio and its server, as a daemon has them.
class Daemon final : public hal::hardware::AgentObserver {
 public:
  Daemon(hal::hardware::RobotFile file, std::uint16_t port, EventLoop& loop, int domain,
         Sight& sight)
      : file_(std::move(file)),
        loop_(loop),
        sight_(sight),
        link_({.self = file_.address,
               .interface = "lo",
               .address = "127.0.79." + std::to_string(file_.address.value),
               .port = port},
              loop),
        agent_(file_, {loop, link_, {.wheels = file_.robot ? &wheels_ : nullptr}, *this}),
        server_(hal::dds::join_domain(domain), agent_,
                {.run = 1, .reply_timeout = {}, .attendance = gateway::Attendance::kAnyTime}) {
    attend();
  }

  std::uint16_t port() const { return link_.port(); }
  void stop() { agent_.stop(); }
  bool is_over() const { return agent_.is_over(); }
  std::uint64_t lost() const { return agent_.counts().overflow; }

  void on_state(hal::Time, const std::string& state) override {
    sight_.on_state(file_.address, state);
  }
  void on_cycle(hal::Time) override {
    if (file_.robot) sight_.on_wheels(wheels_.twist != hal::Twist2{});
  }

 private:
  void attend() {
    for (const EventLoop::Watch watch : std::exchange(watches_, {})) loop_.unwatch(watch);
    server_.attend(loop_.now());
    for (const int descriptor : server_.descriptors()) {
      if (descriptor >= 0) watches_.push_back(loop_.watch(descriptor, [this] { attend(); }));
    }
  }

  hal::hardware::RobotFile file_;
  EventLoop& loop_;
  Sight& sight_;
  hal::hardware::RecordedWheels wheels_;
  hal::hardware::UdpLink link_;
  hal::hardware::HardwareAgent agent_;
  gateway::AgentServer server_;
  std::vector<EventLoop::Watch> watches_;
};

class DaemonHost final : public ContractHost {
 public:
  explicit DaemonHost(hal::Duration control_period)
      : thread_([this, control_period] { run(control_period); }) {}
  ~DaemonHost() override { end(); }

  int domain() const override { return domain_; }
  const Sight& sight() const override { return sight_; }
  std::uint64_t end() override {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    return lost_;
  }

 private:
  void run(hal::Duration control_period) {
    EventLoop loop;
    Daemon robot(file_of(kRobot, "r0", control_period), 0, loop, domain_, sight_);
    Daemon mote(file_of(kMote, "m0", control_period), robot.port(), loop, domain_, sight_);
    while (!stop_) loop.run_once(20ms);
    robot.stop();
    mote.stop();
    const hal::Time end = loop.now() + 2s;
    while (!(robot.is_over() && mote.is_over()) && loop.now() < end) loop.run_once(5ms);
    lost_ = robot.lost() + mote.lost();
  }

  Sight sight_;
  std::atomic<bool> stop_ = false;
  std::uint64_t lost_ = 0;  ///< Of the thread until it has ended.
  int domain_ = test_domain();
  std::thread thread_;
};

}  // namespace

Implementation two_daemons(hal::Duration control_period) {
  return {"TwoDaemons", {.takes_successors = true, .has_neighbours = true}, [control_period] {
            return std::make_unique<DaemonHost>(control_period);
          }};
}

}  // namespace contract
