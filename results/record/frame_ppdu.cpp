#include "results/record/frame_ppdu.h"

#include <fmt/format.h>

#include "results/record/hexadecimal.h"
#include "sim/radio/mac/access_category.h"

namespace results::record {
namespace {

using sim::radio::ModulationClass;

std::optional<std::string_view> modulation_name(ModulationClass modulation) {
  switch (modulation) {
    case ModulationClass::kNone:
      return std::nullopt;
    case ModulationClass::kDsss:
      return "DSSS";
    case ModulationClass::kOfdm:
      return "OFDM";
    case ModulationClass::kHt:
      return "HT";
    case ModulationClass::kVht:
      return "VHT";
    case ModulationClass::kHe:
      return "HE";
  }
  return std::nullopt;
}

/// "17:0300000000000000", or "17" of a BlockAckReq.
std::string block_ack_text(const sim::radio::BlockAckFields& fields) {
  std::vector<std::uint8_t> bytes(fields.length / 8);
  for (std::uint32_t bit = 0; bit < fields.length; ++bit) {
    if (!fields.received[bit]) continue;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] | 1 << bit % 8);
  }
  if (bytes.empty()) return std::to_string(fields.start);
  return fmt::format("{}:{}", fields.start, to_hexadecimal(bytes));
}

}  // namespace

FramePpdu::FramePpdu(const sim::radio::Frame& frame) {
  if (frame.mode != nullptr) {
    const sim::radio::ModeId& mode = frame.mode->id();
    modulation = modulation_name(mode.modulation);
    if (sim::radio::has_streams(mode.modulation)) {
      mcs = mode.mcs;
      streams = mode.streams;
      width_mhz = mode.width;
      guard_ns = mode.guard.count();
    }
  }
  if (frame.qos) {
    tid = frame.priority;
    category = sim::radio::name(sim::radio::category_of(frame.priority));
  }
  if (frame.type == sim::radio::FrameType::kData)
    msdus = frame.amsdu ? static_cast<int>(frame.amsdu->size()) : 1;
  if (frame.block_ack) {
    tid = frame.block_ack->tid;
    block_ack = block_ack_text(*frame.block_ack);
  }
}

std::vector<Column> FramePpdu::columns() {
  return {
      {"modulation", "TEXT", "",
       "'DSSS', 'OFDM', 'HT', 'VHT' or 'HE'; null: the radio profile has no modes"},
      {"mcs", "INTEGER", "",
       "MCS of one stream: HT 0 to 7, VHT to 9, HE to 11; null: an older one"},
      {"streams", "INTEGER", "", "spatial streams; null: it has no MCS"},
      {"width_mhz", "INTEGER", "MHz", "width; null: it has no MCS"},
      {"guard_ns", "INTEGER", "ns", "guard interval; null: it has no MCS"},
      {"tid", "INTEGER", "",
       "traffic identifier, which is the user priority: of QoS data, BlockAck and BlockAckReq; "
       "null: any other frame"},
      {"category", "TEXT", "",
       "access category of QoS data: 'BK', 'BE', 'VI' or 'VO'; null: any other frame"},
      {"msdus", "INTEGER NOT NULL", "",
       "data: MSDUs in it, more than 1 in an A-MSDU, see msdus; 0: any other frame"},
      {"block_ack", "TEXT", "",
       "BlockAck: first sequence number and bitmap, as '17:0300000000000000': bytes in hexadecimal "
       "digits as they are sent, the lowest bit first; BlockAckReq: the number; null: any other "
       "frame"},
  };
}

}  // namespace results::record
