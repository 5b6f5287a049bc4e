#include "sim/radio/frame_factory.h"

#include <algorithm>

#include "sim/radio/frame_lengths.h"

namespace sim::radio {
namespace {

constexpr int kAgentShift = 48;

}  // namespace

std::shared_ptr<Frame> FrameFactory::blank(FrameType type, hal::AgentId to) {
  auto frame = std::make_shared<Frame>();
  frame->id = (static_cast<std::uint64_t>(agent_.value) << kAgentShift) | ++made_;
  frame->type = type;
  frame->transmitter = agent_;
  frame->receiver = to;
  return frame;
}

void FrameFactory::send_in(const PhyMode& mode, std::uint32_t bits, Frame& frame) {
  frame.mode = &mode;
  frame.rate = mode.rate();
  frame.air_length = bits;
  frame.airtime = mode.airtime(bits);
}

FramePtr FrameFactory::control(FrameType type, hal::AgentId to, hal::Duration duration) {
  auto frame = blank(type, to);
  frame->duration = duration;
  send_in(modes_.control(), mpdu_bits(lengths_, type), *frame);
  return frame;
}

FramePtr FrameFactory::rts(hal::AgentId to, hal::Duration duration) {
  return control(FrameType::kRts, to, duration);
}

FramePtr FrameFactory::cts(hal::AgentId to, hal::Duration duration, hal::Duration sifs) {
  const hal::Duration spent = sifs + control_airtime(FrameType::kCts);
  return control(FrameType::kCts, to, std::max(hal::Duration{}, duration - spent));
}

FramePtr FrameFactory::ack(hal::AgentId to) { return control(FrameType::kAck, to, {}); }

FramePtr FrameFactory::data(const MacRequest& request, const DataOptions& options) {
  auto frame = blank(FrameType::kData, request.destination);
  frame->duration = options.duration;
  frame->sequence = options.sequence;
  frame->retry = options.retry;
  send_in(data_mode(request), mpdu_bits(lengths_, FrameType::kData, request.payload->size()),
          *frame);
  frame->priority = request.priority;
  frame->ethertype = request.ethertype;
  frame->payload = request.payload;
  frame->tag = request.tag;
  return frame;
}

const PhyMode& FrameFactory::data_mode(const MacRequest& request) const {
  return request.destination == hal::kEveryone ? modes_.broadcast() : modes_.data();
}

hal::Duration FrameFactory::data_airtime(const MacRequest& request) const {
  return data_mode(request).airtime(mpdu_bits(lengths_, FrameType::kData, request.payload->size()));
}

hal::Duration FrameFactory::control_airtime(FrameType type) const {
  return modes_.control().airtime(mpdu_bits(lengths_, type));
}

}  // namespace sim::radio
