// How long one exchange with controller processes takes, in wall time: a Step to each of them, then
// the Replies of all.
//
//   exchange_bench [EXCHANGES [PROCESSES AGENTS [guests]]]
//
// Guests are in network and pid namespaces of their own (gateway/domain/invitation.h).

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "gateway/exchange/controller_process.h"
#include "gateway/exchange/server.h"
#include "tests/unit/gateway/exchange/child.h"
#include "tests/unit/gateway/exchange/echo_controller.h"
#include "tests/unit/gateway/exchange/guest_child.h"

namespace {

using Clock = std::chrono::steady_clock;

/// 168 bytes, as many as a pose, a twist and 16 ranges in single precision, which the peer sends.
constexpr std::uint32_t kReadings = 21;
constexpr std::uint16_t kChannel = 1;

/// Controller processes with `agents` motes each, linked up.
struct Processes {
  gateway::exchange::Server server{gateway::process::take_domain(std::nullopt)};
  std::vector<std::unique_ptr<Child>> children;
  std::vector<std::unique_ptr<GuestChild>> guests;
  std::vector<std::unique_ptr<gateway::exchange::ProcessLink>> links;
};

hal::node::exchange::Session session_of(const hal::node::exchange::Hello& hello, int agents) {
  hal::node::exchange::Session session = session_for(hello, 1);
  // Described, or the controller would log each reading as an error.
  hal::Channel channel;
  channel.id = kChannel;
  channel.name = channel.kind = "any";
  channel.length = kReadings;
  session.agents[0].channels = {channel};
  session.agents.resize(static_cast<std::size_t>(agents), session.agents[0]);
  for (std::size_t i = 0; i < session.agents.size(); ++i) {
    session.agents[i].agent.value = static_cast<std::uint16_t>(i + 1);
  }
  return session;
}

/// Its processes' names begin so: a controller that waits for another server may be in the domain
/// by chance.
std::string prefix() { return fmt::format("bench{}-", getpid()); }

void start(Processes& processes, int count, int agents, bool as_guests) {
  for (int i = 0; i < count; ++i) {
    const std::string domain = std::to_string(processes.server.domain());
    const std::vector<std::string> role{"controller", domain, fmt::format("{}{}", prefix(), i)};
    if (as_guests) {
      processes.guests.push_back(std::make_unique<GuestChild>(processes.server, role));
    } else {
      processes.children.push_back(std::make_unique<Child>(role));
    }
  }
  while (static_cast<int>(processes.links.size()) < count) {
    for (const auto& hello : processes.server.hellos(std::chrono::seconds{10})) {
      if (!hello.process.starts_with(prefix())) continue;
      processes.links.push_back(processes.server.link(hello, 1, std::chrono::seconds{10}));
      if (!processes.server.answer(session_of(hello, agents)))
        throw std::runtime_error("no answer");
    }
  }
}

template <class T>
void require(const hal::Result<T>& result) {
  if (!result) throw std::runtime_error(result.error().message);
}

void exchange_once(Processes& processes, const hal::node::exchange::Step& step) {
  for (const auto& link : processes.links) require(link->begin(step));
  for (const auto& link : processes.links) require(link->finish());
}

/// UDP datagrams that this network namespace has received: also those of other programs in it.
double datagrams() {
  std::ifstream counters("/proc/net/snmp");
  for (std::string line; std::getline(counters, line);) {
    if (line.starts_with("Udp: ") && std::isdigit(static_cast<unsigned char>(line[5])) != 0) {
      return std::stod(line.substr(5));
    }
  }
  return 0;
}

void measure(int count, int agents, int exchanges, bool as_guests = false) {
  Processes processes;
  start(processes, count, agents, as_guests);
  hal::node::exchange::Step step = step_with(hal::node::exchange::ControlDue{}, 1);
  step.events.resize(static_cast<std::size_t>(agents), step.events[0]);
  for (std::size_t i = 0; i < step.events.size(); ++i) {
    step.events[i].agent.value = static_cast<std::uint16_t>(i + 1);
    step.events[i].readings = {{kChannel, std::vector<double>(kReadings, 0.1)}};
  }
  std::vector<double> microseconds;
  const double before = datagrams();
  for (int i = 0; i < exchanges; ++i) {
    const auto begin = Clock::now();
    exchange_once(processes, step);
    microseconds.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
  }
  const double each = (datagrams() - before) / exchanges;
  std::ranges::sort(microseconds);
  const auto quantile = [&](double q) {
    return microseconds[static_cast<std::size_t>(q * static_cast<double>(exchanges - 1))];
  };
  fmt::print(
      "{:2} processes, {:4} agents each: median {:.1f} us, 99 % {:.1f} us, {:.2f} datagrams\n",
      count, agents, quantile(0.5), quantile(0.99), each);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 4 && argv[1] == std::string("controller")) {  // The role of a Child.
    const hal::ControllerKind kind = echo_kind();
    const auto outcome =
        gateway::exchange::run_controllers(kind, options_for(std::stoi(argv[2]), "m1", argv[3]));
    return static_cast<int>(outcome);
  }
  const int exchanges = argc > 1 ? std::stoi(argv[1]) : 5000;
  if (argc >= 4) {
    measure(std::stoi(argv[2]), std::stoi(argv[3]), exchanges, argc == 5);
    return 0;
  }
  measure(1, 1, exchanges);
  measure(1, 37, exchanges);
  measure(1, 1000, exchanges / 10);
  measure(2, 1, exchanges);
  measure(26, 1, exchanges / 10);
}
