#include "gateway/server/remote_port.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hal/node/exchange/foreign_call.h"

namespace gateway::server {
namespace {

tl::unexpected<hal::Error> disconnected() {
  return hal::fail(hal::Errc::kNotConnected, "the server of the controllers has ended");
}

}  // namespace

using hal::node::exchange::Action;
using hal::node::exchange::Event;
using hal::node::exchange::Reply;
using hal::node::exchange::Step;

RemotePort::RemotePort(std::unique_ptr<exchange::ControllerLink> link,
                       const hal::node::exchange::Hello& hello,
                       const hal::node::exchange::Session& session,
                       std::function<void(hal::Time)> before_begin)
    : link_(std::move(link)),
      granted_(session.agents),
      before_begin_(std::move(before_begin)),
      who_(fmt::format("process '{}'", hello.process)) {
  summary_.name = hello.process;
  summary_.pid = hello.pid;
  for (const auto& agent : granted_) summary_.agents.push_back(agent.name);
}

hal::Result<void> RemotePort::begin(const Step& step) {
  if (!link_) return disconnected();
  step_time_ = step.events.empty() ? step.until : step.events.front().time;
  before_begin_(step_time_);
  asked_.clear();
  for (const Event& event : step.events) asked_.push_back(event.agent);
  return link_->begin(step);
}

hal::Result<Reply> RemotePort::finish() {
  if (!link_) return disconnected();
  const hal::node::exchange::ForeignCall call(who_, "the answer", step_time_);
  hal::Result<Reply> reply = link_->finish();
  if (reply) *reply = checked(std::move(*reply));
  return reply;
}

hal::Result<std::optional<Reply>> RemotePort::try_finish() {
  if (!link_) return disconnected();
  std::optional<hal::node::exchange::ForeignCall> call;
  if (link_->shares_time()) call.emplace(who_, "the answer", step_time_);
  hal::Result<std::optional<Reply>> reply = link_->try_finish();
  if (reply && *reply) *reply = checked(std::move(**reply));
  return reply;
}

std::vector<int> RemotePort::descriptors() const {
  return link_ ? link_->descriptors() : std::vector<int>{};
}

Reply RemotePort::checked(Reply reply) {
  ++summary_.exchanges;
  std::erase_if(reply.actions, [this](const Action& action) { return !is_good(action); });
  return reply;
}

hal::Result<void> RemotePort::check_alive() {
  if (!link_) return disconnected();
  return link_->check_alive();
}

bool RemotePort::is_good(const Action& action) {
  const ActionVerdict verdict = judge(action, granted_, asked_);
  if (verdict == ActionVerdict::kMalformed) ++summary_.malformed_actions;
  if (verdict == ActionVerdict::kForeign) {
    ++summary_.foreign_actions;
    auto& agents = summary_.foreign_agents;
    if (std::ranges::find(agents, action.agent) == agents.end()) agents.push_back(action.agent);
  }
  return verdict == ActionVerdict::kGood;
}

void RemotePort::disconnect() {
  summary_ = summary();
  link_.reset();
}

ProcessSummary RemotePort::summary() const {
  ProcessSummary summary = summary_;
  if (!link_) return summary;
  summary.stale_replies = link_->dropped().stale;
  summary.malformed_replies = link_->dropped().malformed;
  summary.foreign_replies = link_->dropped().foreign;
  summary.foreign_participant = link_->dropped().first_foreign;
  return summary;
}

}  // namespace gateway::server
