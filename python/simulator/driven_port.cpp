#include "python/simulator/driven_port.h"

#include <utility>

namespace python::simulator {

using hal::node::exchange::Action;
using hal::node::exchange::Cause;
using hal::node::exchange::DriveBody;
using hal::node::exchange::Event;
using hal::node::exchange::Step;

DrivenPort::DrivenPort(const std::vector<hal::node::exchange::AgentSession>& sessions, Ask ask)
    : ask_(std::move(ask)), channels_(sessions.size()), views_(sessions.size()) {
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    places_[sessions[i].agent] = i;
    for (const hal::Channel& one : sessions[i].channels) channels_[i][one.id] = one.name;
  }
}

void DrivenPort::take_in(const Event& event) {
  const std::size_t place = places_.at(event.agent);
  for (const hal::node::exchange::Reading& reading : event.readings) {
    const auto channel = channels_[place].find(reading.channel);
    if (channel == channels_[place].end()) continue;
    if (reading.lost) {
      views_[place].readings.erase(channel->second);
    } else {
      views_[place].readings[channel->second] = reading.values;
    }
  }
}

hal::Result<void> DrivenPort::begin(const Step& step) {
  reply_ = {.process = name_, .run = step.run, .sequence = step.sequence, .actions = {}};
  // With a latency above the control period a Step has several control instants.
  std::map<hal::Time, std::vector<std::uint32_t>> due;
  for (std::uint32_t i = 0; i < step.events.size(); ++i) {
    const Event& event = step.events[i];
    take_in(event);
    if (event.cause() == Cause::kControl) due[event.time].push_back(i);
    const bool is_last_of_instant =
        i + 1 == step.events.size() || step.events[i + 1].time != event.time;
    if (is_last_of_instant && due.contains(event.time)) answer(step, event.time, due[event.time]);
  }
  return {};
}

void DrivenPort::answer(const Step& step, hal::Time at, const std::vector<std::uint32_t>& due) {
  Situation situation;
  situation.now = at;
  situation.agents = views_;
  const auto drives = ask_(std::move(situation));
  if (!drives) return;
  for (const std::uint32_t i : due) {
    const hal::AgentId agent = step.events[i].agent;
    reply_.actions.push_back(Action{agent, i, DriveBody{drives->at(places_.at(agent))}});
  }
}

}  // namespace python::simulator
