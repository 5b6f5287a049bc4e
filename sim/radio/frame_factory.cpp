#include "sim/radio/frame_factory.h"

#include <algorithm>

namespace sim::radio {
namespace {

constexpr int kAgentShift = 48;

}  // namespace

FrameFactory::FrameFactory(const RadioConfig& config, hal::AgentId agent)
    : config_(config), airtime_(config), agent_(agent) {}

std::shared_ptr<Frame> FrameFactory::blank(FrameType type, hal::AgentId to) {
  auto frame = std::make_shared<Frame>();
  frame->id = (static_cast<std::uint64_t>(agent_.value) << kAgentShift) | ++made_;
  frame->type = type;
  frame->transmitter = agent_;
  frame->receiver = to;
  return frame;
}

FramePtr FrameFactory::control(FrameType type, hal::AgentId to, hal::Duration duration) {
  auto frame = blank(type, to);
  frame->duration = duration;
  frame->rate = config_.control_rate;
  frame->air_length = airtime_.mpdu_bits(type);
  frame->airtime = airtime_.of(frame->air_length, frame->rate);
  return frame;
}

FramePtr FrameFactory::rts(hal::AgentId to, hal::Duration duration) {
  return control(FrameType::kRts, to, duration);
}

FramePtr FrameFactory::cts(hal::AgentId to, hal::Duration duration) {
  const hal::Duration spent = config_.sifs + control_airtime(FrameType::kCts);
  return control(FrameType::kCts, to, std::max(hal::Duration{}, duration - spent));
}

FramePtr FrameFactory::ack(hal::AgentId to) { return control(FrameType::kAck, to, {}); }

FramePtr FrameFactory::data(const MacRequest& request, const DataOptions& options) {
  auto frame = blank(FrameType::kData, request.destination);
  frame->duration = options.duration;
  frame->sequence = options.sequence;
  frame->retry = options.retry;
  frame->rate = data_rate(request);
  frame->air_length = airtime_.mpdu_bits(FrameType::kData, request.payload->size());
  frame->airtime = airtime_.of(frame->air_length, frame->rate);
  frame->priority = request.priority;
  frame->ethertype = request.ethertype;
  frame->payload = request.payload;
  frame->tag = request.tag;
  return frame;
}

hal::BitsPerSecond FrameFactory::data_rate(const MacRequest& request) const {
  return request.destination == hal::kEveryone ? config_.broadcast_rate : config_.data_rate;
}

hal::Duration FrameFactory::data_airtime(const MacRequest& request) const {
  return airtime_.of(airtime_.mpdu_bits(FrameType::kData, request.payload->size()),
                     data_rate(request));
}

hal::Duration FrameFactory::control_airtime(FrameType type) const {
  return airtime_.of(airtime_.mpdu_bits(type), config_.control_rate);
}

}  // namespace sim::radio
