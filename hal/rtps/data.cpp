#include "hal/rtps/data.h"

#include <algorithm>
#include <limits>

#include "hal/rtps/discovery.h"
#include "hal/rtps/parameter_list.h"

namespace hal::rtps {
namespace {

constexpr unsigned kInlineQosFlag = 1;
constexpr unsigned kDataFlag = 2;     // only DATA; a DATA_FRAG always has a payload
constexpr unsigned kKeyFlag = 3;      // of a DATA
constexpr unsigned kFragKeyFlag = 2;  // of a DATA_FRAG
/// Octets from the end of octetsToInlineQos to the inline QoS, in this version.
constexpr std::uint16_t kToInlineQos = 16;
constexpr std::uint16_t kFragToInlineQos = 28;
/// Fast DDS reads octetsToInlineQos as a signed number.
constexpr std::uint16_t kMostToInlineQos = 0x7ffc;
constexpr std::size_t kEncapsulation = 4;

/// Reads the fields that only a DATA_FRAG has.
Objection read_fragments(Cursor& cursor, const Limits& limits, Data& data) {
  data.first_fragment = cursor.u32();
  data.fragments = cursor.u16();
  data.fragment_size = cursor.u16();
  data.sample_size = cursor.u32();
  if (data.first_fragment == 0) return "its first fragment has the number 0";
  if (data.fragments == 0) return "it has no fragment";
  if (data.fragment_size == 0) return "its fragments have no size";
  if (data.sample_size > limits.sample_size) return "its sample is too large";
  const std::uint64_t total =
      (std::uint64_t{data.sample_size} + data.fragment_size - 1) / data.fragment_size;
  if (std::uint64_t{data.first_fragment} + data.fragments - 1 > total) {
    return "its fragments are beyond the end of their sample";
  }
  return {};
}

/// Size of the fragments in octets: all but the last fragment of a sample have the full size.
std::size_t size_of_fragments(const Data& data) {
  const std::uint64_t begin = std::uint64_t{data.first_fragment - 1} * data.fragment_size;
  const std::uint64_t end = begin + std::uint64_t{data.fragments} * data.fragment_size;
  return static_cast<std::size_t>(std::min<std::uint64_t>(end, data.sample_size) - begin);
}

struct InlineQos {
  bool has_status = false;
  std::uint32_t status = 0;
};

Objection read_inline_qos(Cursor& cursor, const Submessage& submessage, const GuidPrefix* source,
                          InlineQos& qos) {
  ParameterList list(cursor, submessage.endianness());
  while (const Parameter* one = list.next()) {
    if (one->id == parameter::kKeyHash && one->value.size() != 16) {
      return "a key hash has not 16 octets";
    }
    if (one->id == parameter::kStatusInfo && one->value.size() != 4) {
      return "a status has not 4 octets";
    }
    if (one->id == parameter::kStatusInfo) {
      qos.has_status = true;
      // Four octets, independent of the endianness.
      qos.status = Cursor(one->value, Endianness::kBig).u32();
    }
    const bool is_foreign =
        source != nullptr && one->id == parameter::kKeyHash &&
        !std::ranges::equal(one->value.first(source->octets.size()), source->octets);
    if (is_foreign) return "it tells of another participant than the one that sent it";
  }
  return list.objection();
}

Objection judge_fragments(const Data& data) {
  // Only whole samples can be checked, and real discovery data fit into one datagram.
  if (is_discovery(data.writer)) return "discovery comes in fragments";
  // Up to 3 octets may pad it to a multiple of 4.
  const std::size_t size = size_of_fragments(data);
  if (data.payload.size() < size) return "its fragments are longer than it";
  if (data.payload.size() > size + 3) return "it is longer than its fragments";
  return {};
}

Objection judge_payload(const Submessage& submessage, const GuidPrefix* source,
                        const InlineQos& qos, Data& data) {
  if (submessage.kind == SubmessageKind::kDataFrag) return judge_fragments(data);
  const bool has_data = submessage.has_flag(kDataFlag);
  if (has_data && data.is_key) return "it says to hold data and a key";
  if (!has_data && !data.is_key) {
    data.payload = {};
    return qos.has_status ? Objection{} : "it holds neither data, key nor status";
  }
  if (data.payload.size() < kEncapsulation) return "its payload is too short";
  if (has_data && is_discovery(data.writer)) return judge_discovery(data.payload, source);
  if (has_data && data.writer == kParticipantMessageWriter) {
    return judge_participant_message(data.payload);
  }
  return {};
}

/// @param offset  octets from the end of the octetsToInlineQos field to the inline QoS.
Objection judge_offset(std::uint16_t offset, bool is_fragment) {
  if (offset < (is_fragment ? kFragToInlineQos : kToInlineQos)) {
    return "its inline QoS begins within its header";
  }
  if (offset > kMostToInlineQos || offset % 4 != 0) {
    return "its inline QoS begins too far away, or between two words";
  }
  return {};
}

}  // namespace

Objection judge_data(const Submessage& submessage, const GuidPrefix& source, const Limits& limits,
                     Data& data) {
  const bool is_fragment = submessage.kind == SubmessageKind::kDataFrag;
  data.is_key = submessage.has_flag(is_fragment ? kFragKeyFlag : kKeyFlag);
  Cursor cursor(submessage.body, submessage.endianness());
  cursor.take(2);  // further flags, for later versions
  const std::uint16_t to_inline_qos = cursor.u16();
  const std::size_t from = cursor.position();
  data.reader = cursor.entity();
  data.writer = cursor.entity();
  data.sequence_number = cursor.sequence_number();
  Objection fragments;
  if (is_fragment) fragments = read_fragments(cursor, limits, data);
  if (cursor.is_short()) return "it is too short";
  if (data.sequence_number < 1) return "its sequence number is below 1";
  if (data.sequence_number > limits.sequence_number) {
    return "its sequence number is far beyond the last one";
  }
  if (!fragments.empty()) return fragments;
  const Objection offset = judge_offset(to_inline_qos, is_fragment);
  if (!offset.empty()) return offset;
  cursor.take(from + to_inline_qos - cursor.position());
  if (cursor.is_short()) return "its inline QoS begins beyond its end";
  const bool is_bound = !limits.relayed_discovery && is_discovery(data.writer);
  const GuidPrefix* const owner = is_bound ? &source : nullptr;
  InlineQos qos;
  if (submessage.has_flag(kInlineQosFlag)) {
    const Objection objection = read_inline_qos(cursor, submessage, owner, qos);
    if (!objection.empty()) return objection;
  }
  data.status = qos.status;
  data.payload = cursor.take(cursor.left());
  return judge_payload(submessage, owner, qos, data);
}

}  // namespace hal::rtps
