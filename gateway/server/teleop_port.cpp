#include "gateway/server/teleop_port.h"

#include <algorithm>
#include <utility>

namespace gateway::server {

using hal::node::exchange::Event;
using hal::node::exchange::Reply;
using hal::node::exchange::Step;

TeleopPort::TeleopPort(const std::string& agent, LastCommand last, hal::Duration command_timeout,
                       hal::Duration control_period)
    : name_(std::string(kTeleop) + " of " + agent),
      command_timeout_(command_timeout),
      control_period_(control_period),
      last_(std::move(last)) {}

hal::Result<void> TeleopPort::begin(const Step& step) {
  reply_ = {.process = name_, .run = step.run, .sequence = step.sequence, .actions = {}};
  for (std::uint32_t i = 0; i < step.events.size(); ++i) {
    if (step.events[i].cause() == hal::node::exchange::Cause::kControl) answer(step.events[i], i);
  }
  return {};
}

void TeleopPort::answer(const Event& event, std::uint32_t index) {
  const auto command = last_();
  const hal::Duration pause = std::max(command_timeout_, 2 * control_period_);
  if (event.time - last_event_ > pause) deaf_until_ = event.time + command_timeout_;
  last_event_ = event.time;
  if (event.time < deaf_until_ && command) obeyed_ = command->number;
  const bool is_new = command && command->number != obeyed_;
  // The command would time out before the next control event.
  const bool is_old = event.time + control_period_ > obeyed_at_ + command_timeout_;
  if (!is_new && !(driving_ && is_old)) return;
  hal::node::exchange::DriveBody drive;
  if (is_new) {
    drive.twist = command->twist;
    obeyed_ = command->number;
    obeyed_at_ = event.time;
  }
  driving_ = is_new;
  reply_.actions.push_back({event.agent, index, drive});
}

hal::Result<Reply> TeleopPort::finish() { return std::move(reply_); }

}  // namespace gateway::server
