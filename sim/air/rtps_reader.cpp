#include "sim/air/rtps_reader.h"

#include <algorithm>

#include "hal/rtps/data.h"
#include "hal/rtps/walk.h"

namespace sim::air {
namespace {

using hal::rtps::Submessage;
using hal::rtps::SubmessageKind;

/// Octets of a submessage that must be known before it is interpreted: its header, extra flags and
/// the fields of a DATA_FRAG before its inline QoS.
constexpr std::uint32_t kFixedPart = 48;

/// Whether it is a SEDP writer of publications or of subscriptions, secured or not.
bool tells_of_endpoints(hal::rtps::EntityId writer) {
  return writer == hal::rtps::kSedpPublicationWriter ||
         writer == hal::rtps::kSedpSubscriptionWriter || writer.value == 0xff0003c2 ||
         writer.value == 0xff0004c2;
}

bool is_about_writer(SubmessageKind kind) {
  return kind == SubmessageKind::kAckNack || kind == SubmessageKind::kNackFrag;
}

hal::rtps::GuidPrefix prefix_in(Octets body, std::size_t offset) {
  hal::rtps::GuidPrefix prefix;
  if (body.size() >= offset + prefix.octets.size())
    std::ranges::copy(body.subspan(offset, prefix.octets.size()), prefix.octets.begin());
  return prefix;
}

/// Reads which sample, or part of a sample, a DATA or DATA_FRAG contains. Octets in IP fragments
/// that have not been observed are 0; no field read here depends on them.
void read_sample(const Submessage& one, DatagramPart& part) {
  if (one.kind != SubmessageKind::kData && one.kind != SubmessageKind::kDataFrag) return;
  hal::rtps::Data data;
  if (!judge_data(one, {}, {}, data).empty()) return;
  part.sequence_number = data.sequence_number;
  part.sample_size = static_cast<std::uint32_t>(data.payload.size());
  if (data.fragment_size == 0) return;
  part.first_fragment = data.first_fragment;
  part.fragments = data.fragments;
  part.sample_size = data.sample_size;
  part.all_fragments = (data.sample_size + data.fragment_size - 1) / data.fragment_size;
}

/// Assigns preceding INFO_TS, INFO_DST etc. to the submessage that follows them.
void name_those_before(Datagram& datagram, const DatagramPart& part) {
  for (std::size_t i = datagram.parts.size(); i > 0; --i) {
    AirKind& before = datagram.parts[i - 1].kind;
    if (before.purpose != Purpose::kRtps) return;
    before.purpose = part.kind.purpose;
    before.topic = part.kind.topic;
  }
}

}  // namespace

/// Decides by the octets that are equal for the reader and the writer of a pair (9.3.1.3).
Purpose purpose_of(hal::rtps::EntityId reader, hal::rtps::EntityId writer) {
  const hal::rtps::EntityId entity = writer == hal::rtps::kUnknownEntity ? reader : writer;
  if (!entity.is_builtin()) return Purpose::kUser;
  switch (entity.value >> 8U) {
    case 0x000100:
    case 0xff0101:
      return Purpose::kSpdp;
    case 0x000002:
    case 0x000003:
    case 0x000004:
    case 0xff0003:
    case 0xff0004:
      return Purpose::kSedp;
    case 0x000200:
    case 0xff0200:
      return Purpose::kLiveliness;
    default:
      return Purpose::kBuiltin;
  }
}

std::size_t RtpsReader::read(hal::Time at, Datagram& datagram) {
  const std::size_t before = datagram.parts.size();
  if (datagram.octets.empty() || datagram.known < hal::rtps::Header::kSize) return before;
  hal::rtps::Walk walk(datagram.octets);
  if (walk.fault()) return before;
  if (datagram.walk.next == 0) {
    datagram.is_rtps = true;
    datagram.walk.next = hal::rtps::Header::kSize;
    datagram.walk.source = walk.header().source;
    endpoints_.place(walk.header().source, datagram.source);
  }
  while (datagram.walk.next < datagram.size) {
    const std::uint32_t wanted = std::min(datagram.walk.next + kFixedPart, datagram.size);
    if (datagram.known < wanted) break;
    const Submessage* const one = walk.next();
    if (one == nullptr) {
      datagram.parts.push_back({.begin = datagram.walk.next,
                                .end = datagram.size,
                                .kind = {.purpose = Purpose::kRtps, .what = kMalformed}});
      datagram.walk.next = datagram.size;
    } else if (one->at >= datagram.walk.next) {
      read_one(datagram, *one);
    }
  }
  if (datagram.is_whole()) {
    learn(at, datagram);
    std::vector<std::byte>().swap(datagram.octets);
  }
  return before;
}

/// Reads discovery data once all of the datagram is known.
void RtpsReader::learn(hal::Time at, Datagram& datagram) {
  hal::rtps::Walk walk(datagram.octets);
  for (DatagramPart& part : datagram.parts) {
    const Submessage* const one = walk.next();
    if (one == nullptr) return;
    if (one->kind != SubmessageKind::kData || !tells_of_endpoints(one->writer())) continue;
    hal::rtps::Data data;
    if (!judge_data(*one, {}, {}, data).empty()) continue;
    const auto endpoint = hal::rtps::read_endpoint(data.payload);
    if (!endpoint) continue;
    part.told = endpoints_.learn(at, *endpoint);
    if (data.status != 0) endpoints_.remove(endpoint->guid);
  }
}

void RtpsReader::read_one(Datagram& datagram, const Submessage& one) {
  DatagramPart part{.begin = static_cast<std::uint32_t>(one.at),
                    .end = static_cast<std::uint32_t>(one.at + one.size())};
  part.kind = {.purpose = Purpose::kRtps, .what = static_cast<std::uint16_t>(one.kind)};
  datagram.walk.next = part.end;
  constexpr std::size_t kInfoSourcePrefix = 8;
  if (one.kind == SubmessageKind::kInfoDestination)
    datagram.walk.destination = prefix_in(one.body, 0);
  if (one.kind == SubmessageKind::kInfoSource)
    datagram.walk.source = prefix_in(one.body, kInfoSourcePrefix);
  part.to = datagram.walk.destination;
  if (one.has_endpoints()) {
    const hal::rtps::EntityId writer = one.writer();
    part.kind.purpose = purpose_of(one.reader(), writer);
    part.writer = endpoints_.of(
        {is_about_writer(one.kind) ? datagram.walk.destination : datagram.walk.source, writer});
    if (part.kind.purpose == Purpose::kUser) {
      part.kind.topic = endpoints_.all()[part.writer].topic;
      read_sample(one, part);
    }
    name_those_before(datagram, part);
  }
  datagram.parts.push_back(part);
}

}  // namespace sim::air
