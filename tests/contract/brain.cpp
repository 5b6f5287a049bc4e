#include "tests/contract/brain.h"

#include <chrono>
#include <utility>
#include <variant>

namespace contract {
namespace {

using namespace std::chrono_literals;
using hal::exchange::Event;

hal::exchange::Hello hello_of(const std::string& process, std::vector<std::string> agents,
                              std::uint32_t version) {
  hal::exchange::Hello hello;
  hello.version = version;
  hello.process = process;
  hello.program = "contract";
  hello.patterns = std::move(agents);
  hello.both_kinds = true;
  hello.wants.watched = {"test"};
  return hello;
}

}  // namespace

Brain::Brain(int domain, const std::string& process, std::vector<std::string> agents, Rule rule,
             std::uint32_t version)
    : rule_(std::move(rule)),
      client_(domain, hello_of(process, std::move(agents), version)),
      thread_([this] { run(); }) {}

Brain::~Brain() {
  stop_ = true;
  client_.interrupt();
  thread_.join();
}

void Brain::run() {
  while (!stop_) {
    const hal::dds::Arrival arrival = client_.next(100ms);
    if (const auto* session = std::get_if<hal::exchange::Session>(&arrival)) on(*session);
    if (const auto* step = std::get_if<hal::exchange::Step>(&arrival)) on(*step);
  }
}

void Brain::on(const hal::exchange::Session& session) {
  const std::lock_guard lock(mutex_);
  if (!session.refusal.empty()) refusal_ = session.refusal;
}

void Brain::on(const hal::exchange::Step& step) {
  hal::exchange::Reply& reply = replies_[step.server];
  if (step.sequence == reply.sequence && step.run == reply.run) {  // Late, so it was asked again.
    [[maybe_unused]] const auto sent = client_.reply(step.server, reply);
    return;
  }
  const std::uint64_t last = reply.sequence;
  reply = {};
  reply.run = step.run;
  reply.sequence = step.sequence;
  {
    const std::lock_guard lock(mutex_);
    ++steps_;
    gaps_ += step.sequence == last + 1 ? 0 : 1;
    seen_.insert(seen_.end(), step.events.begin(), step.events.end());
  }
  for (std::uint32_t i = 0; i < step.events.size() && rule_; ++i) {
    for (hal::exchange::Action& action : rule_(step.events[i])) {
      action.agent = step.events[i].agent;
      action.event = i;
      reply.actions.push_back(std::move(action));
    }
  }
  while (held_ && !stop_) std::this_thread::sleep_for(1ms);
  [[maybe_unused]] const auto sent = client_.reply(step.server, reply);
}

std::vector<Event> Brain::seen(hal::AgentId agent) const {
  const std::lock_guard lock(mutex_);
  std::vector<Event> found;
  for (const Event& event : seen_) {
    if (event.agent == agent) found.push_back(event);
  }
  return found;
}

std::vector<Event> Brain::seen(hal::AgentId agent, hal::exchange::Cause cause) const {
  std::vector<Event> found = seen(agent);
  std::erase_if(found, [&](const Event& event) { return event.cause != cause; });
  return found;
}

std::string Brain::refusal() const {
  const std::lock_guard lock(mutex_);
  return refusal_;
}

std::uint64_t Brain::steps() const {
  const std::lock_guard lock(mutex_);
  return steps_;
}

std::uint64_t Brain::gaps() const {
  const std::lock_guard lock(mutex_);
  return gaps_;
}

}  // namespace contract
