#include "sim/radio/mac/block_ack_action.h"

#include "sim/radio/mac/mac_address.h"

namespace sim::radio {
namespace {

constexpr std::uint8_t kBlockAckCategory = 3;
enum : std::uint8_t { kAddRequest, kAddResponse, kDelete };
constexpr std::uint16_t kImmediate = 1 << 1;
constexpr int kSetTidShift = 2, kSetWindowShift = 6, kStartShift = 4;
constexpr int kDeleteTidShift = 12, kInitiatorShift = 11;
constexpr std::uint16_t kSetTidMask = 0xf;

std::uint16_t parameter_set(std::uint8_t tid, std::uint32_t window) {
  const std::uint32_t shifted = std::uint32_t{tid} << kSetTidShift | window << kSetWindowShift;
  return static_cast<std::uint16_t>(kImmediate | shifted);
}

hal::Bytes body_of(const AddBlockAckRequest& one) {
  hal::Bytes out{kBlockAckCategory, kAddRequest, one.dialog_token};
  put_little_endian(out, parameter_set(one.tid, one.window), 2);
  put_little_endian(out, 0, 2);  // no timeout
  put_little_endian(out, static_cast<std::uint64_t>(one.start) << kStartShift, 2);
  return out;
}

hal::Bytes body_of(const AddBlockAckResponse& one) {
  hal::Bytes out{kBlockAckCategory, kAddResponse, one.dialog_token};
  put_little_endian(out, one.status, 2);
  put_little_endian(out, parameter_set(one.tid, one.window), 2);
  put_little_endian(out, 0, 2);
  return out;
}

hal::Bytes body_of(const DeleteBlockAck& one) {
  hal::Bytes out{kBlockAckCategory, kDelete};
  const int set = one.tid << kDeleteTidShift | (one.by_originator ? 1 << kInitiatorShift : 0);
  put_little_endian(out, static_cast<std::uint64_t>(set), 2);
  put_little_endian(out, one.reason, 2);
  return out;
}

std::uint16_t field(std::span<const std::uint8_t> body, std::size_t at) {
  return static_cast<std::uint16_t>(get_little_endian(body.subspan(at), 2));
}

std::uint8_t tid_in(std::uint16_t set) {
  return static_cast<std::uint8_t>(set >> kSetTidShift & kSetTidMask);
}

}  // namespace

hal::Bytes encode(const BlockAckAction& action) {
  return std::visit([](const auto& one) { return body_of(one); }, action);
}

std::optional<BlockAckAction> decode_block_ack_action(std::span<const std::uint8_t> body) {
  constexpr std::size_t kAdd = 9, kDel = 6;
  if (body.size() < kDel || body[0] != kBlockAckCategory) return std::nullopt;
  if (body[1] == kDelete) {
    const std::uint16_t set = field(body, 2);
    return DeleteBlockAck{(set >> kInitiatorShift & 1) != 0,
                          static_cast<std::uint8_t>(set >> kDeleteTidShift), field(body, 4)};
  }
  if (body.size() < kAdd) return std::nullopt;
  if (body[1] == kAddRequest) {
    const std::uint16_t set = field(body, 3);
    return AddBlockAckRequest{body[2], tid_in(set),
                              static_cast<std::uint32_t>(set >> kSetWindowShift),
                              static_cast<std::uint16_t>(field(body, 7) >> kStartShift)};
  }
  if (body[1] != kAddResponse) return std::nullopt;
  const std::uint16_t set = field(body, 5);
  return AddBlockAckResponse{body[2], field(body, 3), tid_in(set),
                             static_cast<std::uint32_t>(set >> kSetWindowShift)};
}

}  // namespace sim::radio
