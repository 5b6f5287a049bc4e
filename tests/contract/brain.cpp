#include "tests/contract/brain.h"

#include <chrono>
#include <utility>
#include <variant>

namespace contract {
namespace {

using namespace std::chrono_literals;
using hal::node::exchange::Event;
using hal::node::exchange::Reply;
using hal::node::exchange::Step;

hal::node::exchange::Hello hello_of(const std::string& process, std::vector<std::string> agents,
                                    const hal::Wants& wants, std::uint32_t version) {
  hal::node::exchange::Hello hello;
  hello.version = version;
  hello.process = process;
  hello.program = "contract";
  hello.patterns = std::move(agents);
  hello.both_kinds = true;
  hello.wants = wants;
  return hello;
}

}  // namespace

Reply Brain::answer(const Step& step, const std::string& server) {
  Reply reply;
  reply.run = step.run;
  reply.sequence = step.sequence;
  {
    const std::lock_guard lock(mutex_);
    ++steps_;
    std::uint64_t& last = last_[server];
    gaps_ += step.sequence == last + 1 ? 0 : 1;
    last = step.sequence;
    seen_.insert(seen_.end(), step.events.begin(), step.events.end());
  }
  for (std::uint32_t i = 0; i < step.events.size() && rule_; ++i) {
    for (hal::node::exchange::Action& action : rule_(step.events[i])) {
      if (action.agent == hal::AgentId{}) {
        action.agent = step.events[i].agent;
        action.event = i;
      }
      reply.actions.push_back(std::move(action));
    }
  }
  return reply;
}

std::vector<Event> Brain::seen(hal::AgentId agent) const {
  const std::lock_guard lock(mutex_);
  std::vector<Event> found;
  for (const Event& event : seen_) {
    if (event.agent == agent) found.push_back(event);
  }
  return found;
}

std::vector<Event> Brain::seen(hal::AgentId agent, hal::node::exchange::Cause cause) const {
  std::vector<Event> found = seen(agent);
  std::erase_if(found, [&](const Event& event) { return event.cause() != cause; });
  return found;
}

std::uint64_t Brain::steps() const {
  const std::lock_guard lock(mutex_);
  return steps_;
}

std::uint64_t Brain::gaps() const {
  const std::lock_guard lock(mutex_);
  return gaps_;
}

RemoteBrain::RemoteBrain(int domain, const std::string& process, std::vector<std::string> agents,
                         Rule rule, const hal::Wants& wants, std::uint32_t version)
    : Brain(std::move(rule)),
      client_(domain, hello_of(process, std::move(agents), wants, version)),
      thread_([this] { run(); }) {}

RemoteBrain::~RemoteBrain() {
  stop_ = true;
  client_.interrupt();
  thread_.join();
}

void RemoteBrain::run() {
  while (!stop_) {
    const gateway::exchange::Arrival arrival = client_.next(100ms);
    if (const auto* session = std::get_if<hal::node::exchange::Session>(&arrival)) on(*session);
    if (const auto* step = std::get_if<Step>(&arrival)) on(*step);
  }
}

void RemoteBrain::on(const hal::node::exchange::Session& session) {
  const std::lock_guard lock(mutex_);
  if (!session.refusal.empty()) {
    refusal_ = session.refusal;
  } else {
    directories_.push_back(session.directory);
  }
}

void RemoteBrain::on(const Step& step) {
  Reply& reply = replies_[step.server];
  // Late, so it was asked again.
  const bool is_repeated = step.sequence == reply.sequence && step.run == reply.run;
  if (!is_repeated) reply = answer(step, step.server);
  while (!is_repeated && held_ && !stop_) std::this_thread::sleep_for(1ms);
  [[maybe_unused]] const auto sent = client_.reply(step.server, reply);
}

std::string RemoteBrain::refusal() const {
  const std::lock_guard lock(mutex_);
  return refusal_;
}

std::vector<std::vector<hal::node::exchange::AgentName>> RemoteBrain::directories() const {
  const std::lock_guard lock(mutex_);
  return directories_;
}

}  // namespace contract
