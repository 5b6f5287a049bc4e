#include "sim/radio/mac/frame_factory.h"

#include <algorithm>

#include "sim/radio/infrastructure/management.h"
#include "sim/radio/mac/frame_lengths.h"

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

std::shared_ptr<Frame> FrameFactory::control(FrameType type, const PhyMode& mode, hal::AgentId to,
                                             hal::Duration duration) {
  auto frame = blank(type, to);
  frame->duration = duration;
  send_in(mode, mpdu_bits(lengths_, type), *frame);
  return frame;
}

FramePtr FrameFactory::rts(hal::AgentId to, hal::Duration duration) {
  return rts(to, duration, modes_.control());
}

FramePtr FrameFactory::rts(hal::AgentId to, hal::Duration duration, const PhyMode& mode) {
  return control(FrameType::kRts, mode, to, duration);
}

FramePtr FrameFactory::cts_to_self(hal::Duration duration, const PhyMode& mode) {
  return control(FrameType::kCts, mode, agent_, duration);
}

FramePtr FrameFactory::block_ack_request(hal::AgentId to, const BlockAckFields& fields,
                                         hal::Duration duration, const PhyMode& mode) {
  auto frame = blank(FrameType::kBlockAckRequest, to);
  frame->duration = duration;
  frame->block_ack = std::make_shared<const BlockAckFields>(fields);
  send_in(mode, mpdu_bits(lengths_, FrameType::kBlockAckRequest), *frame);
  return frame;
}

FramePtr FrameFactory::block_ack(const Frame& to, const BlockAckFields& fields, hal::Decibels snr) {
  auto frame = blank(FrameType::kBlockAck, to.transmitter);
  frame->answered_snr = snr;
  frame->block_ack = std::make_shared<const BlockAckFields>(fields);
  send_in(modes_.response_to(*to.mode), block_ack_bits(fields.length), *frame);
  return frame;
}

FramePtr FrameFactory::cts(const Frame& rts, hal::Duration sifs) {
  const hal::Duration spent = sifs + response_airtime(FrameType::kCts, *rts.mode);
  return control(FrameType::kCts, modes_.response_to(*rts.mode), rts.transmitter,
                 std::max(hal::Duration{}, rts.duration - spent));
}

FramePtr FrameFactory::ack(const Frame& data, hal::Decibels snr) {
  auto frame = control(FrameType::kAck, modes_.response_to(*data.mode), data.transmitter, {});
  frame->answered_snr = snr;
  return frame;
}

std::shared_ptr<Frame> FrameFactory::data(const MacRequest& request, const DataOptions& options) {
  const MacHeader& header = request.header;
  auto frame = blank(header.type, request.destination);
  frame->duration = options.duration;
  frame->sequence = options.sequence;
  frame->retry = options.retry;
  frame->ds = header.ds;
  frame->address3 = header.address3;
  frame->qos = options.qos;
  const std::uint32_t bits = mpdu_bits(lengths_, header.type, request.payload->size()) +
                             (options.qos ? kQosControlBits : 0);
  send_in(options.mode ? *options.mode : data_mode(request), options.bits ? options.bits : bits,
          *frame);
  frame->priority = request.priority;
  frame->ethertype = request.ethertype;
  frame->payload = header.type == FrameType::kBeacon
                       ? with_timestamp(*request.payload, options.at, *frame->mode)
                       : request.payload;
  frame->tag = request.tag;
  frame->group = request.group;
  return frame;
}

const PhyMode& FrameFactory::data_mode(const MacRequest& request) const {
  if (request.header.type == FrameType::kBeacon) return modes_.beacon();
  const bool is_basic = request.destination == hal::kEveryone || is_management(request.header.type);
  return is_basic ? modes_.broadcast() : modes_.data();
}

hal::Duration FrameFactory::data_airtime(const MacRequest& request) const {
  return data_airtime(request, data_mode(request));
}

hal::Duration FrameFactory::data_airtime(const MacRequest& request, const PhyMode& mode) const {
  return mode.airtime(mpdu_bits(lengths_, request.header.type, request.payload->size()));
}

hal::Duration FrameFactory::response_airtime(FrameType type, const PhyMode& to) const {
  return modes_.response_to(to).airtime(mpdu_bits(lengths_, type));
}

}  // namespace sim::radio
