#include "hal/rtps/discovery.h"

#include <algorithm>

#include "hal/rtps/parameter_list.h"

namespace hal::rtps {
namespace {

constexpr std::uint16_t kPlCdrBig = 0x0002;
constexpr std::uint16_t kPlCdrLittle = 0x0003;

enum class Form : std::uint8_t {
  kString,
  kStrings,
  kOctets,
  kProperties,
  kToken,
  kFilter,
  kLocator,
  kGuid,
  kDuration,
  kWord,
};

struct Formed {
  std::uint16_t id;
  Form form;
};

/// OMG DDSI-RTPS 2.5, table 9.14; tokens: OMG DDS Security 1.1, 7.4.1.3.
constexpr Formed kFormed[] = {
    {0x0002, Form::kDuration},    // PID_PARTICIPANT_LEASE_DURATION
    {0x0005, Form::kString},      // PID_TOPIC_NAME
    {0x0007, Form::kString},      // PID_TYPE_NAME
    {0x0015, Form::kWord},        // PID_PROTOCOL_VERSION
    {0x0016, Form::kWord},        // PID_VENDORID
    {0x0029, Form::kStrings},     // PID_PARTITION
    {0x002c, Form::kOctets},      // PID_USER_DATA
    {0x002d, Form::kOctets},      // PID_GROUP_DATA
    {0x002e, Form::kOctets},      // PID_TOPIC_DATA
    {0x002f, Form::kLocator},     // PID_UNICAST_LOCATOR
    {0x0030, Form::kLocator},     // PID_MULTICAST_LOCATOR
    {0x0031, Form::kLocator},     // PID_DEFAULT_UNICAST_LOCATOR
    {0x0032, Form::kLocator},     // PID_METATRAFFIC_UNICAST_LOCATOR
    {0x0033, Form::kLocator},     // PID_METATRAFFIC_MULTICAST_LOCATOR
    {0x0035, Form::kFilter},      // PID_CONTENT_FILTER_PROPERTY
    {0x0048, Form::kLocator},     // PID_DEFAULT_MULTICAST_LOCATOR
    {0x0050, Form::kGuid},        // PID_PARTICIPANT_GUID
    {0x0052, Form::kGuid},        // PID_GROUP_GUID
    {0x0058, Form::kWord},        // PID_BUILTIN_ENDPOINT_SET
    {0x0059, Form::kProperties},  // PID_PROPERTY_LIST
    {0x005a, Form::kGuid},        // PID_ENDPOINT_GUID
    {0x0062, Form::kString},      // PID_ENTITY_NAME
    {0x0070, Form::kGuid},        // PID_KEY_HASH
    {0x1001, Form::kToken},       // PID_IDENTITY_TOKEN
    {0x1002, Form::kToken},       // PID_PERMISSIONS_TOKEN
    {0x1006, Form::kToken},       // PID_IDENTITY_STATUS_TOKEN
    {0x4014, Form::kString},      // PID_DOMAIN_TAG
};

/// LOCATOR_KIND_RESERVED is no kind to send to.
constexpr std::uint32_t kLocatorKinds[] = {
    0xffffffff,  // LOCATOR_KIND_INVALID
    0x00000001,  // UDPv4
    0x00000002,  // UDPv6
    0x00000004,  // TCPv4, of Fast DDS and others
    0x00000008,  // TCPv6
    0x00000010,  // shared memory of Fast DDS
    0x8000fffd,  // PSMX and …
    0x8000fffe,  // … raw Ethernet of Cyclone DDS
    0x01000000,  // shared memory of RTI Connext
};

/// A length and that number of octets, of which the last is 0, then padding to a multiple of 4.
/// Some senders omit the padding at the end.
bool skip_string(Cursor& cursor) {
  const std::uint32_t length = cursor.u32();
  const Octets text = cursor.take(length);
  if (cursor.is_short()) return false;
  if (!text.empty() && text.back() != std::byte{0}) return false;
  cursor.take(std::min<std::size_t>((4 - length % 4) % 4, cursor.left()));
  return true;
}

bool skip_octets(Cursor& cursor) {
  const std::uint32_t length = cursor.u32();
  cursor.take(length);
  if (cursor.is_short()) return false;
  cursor.take(std::min<std::size_t>((4 - length % 4) % 4, cursor.left()));
  return true;
}

/// A sequence: its length, then that number of elements, which `skip` passes over.
template <class Skip>
bool skip_each(Cursor& cursor, const Skip& skip) {
  const std::uint32_t count = cursor.u32();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (cursor.left() == 0 || !skip(cursor)) return false;
  }
  return !cursor.is_short();
}

bool skip_strings(Cursor& cursor) { return skip_each(cursor, skip_string); }

/// Properties, then binary properties unless the list ends before them.
bool skip_properties(Cursor& cursor) {
  const auto skip_two = [](Cursor& c) { return skip_string(c) && skip_string(c); };
  const auto skip_binary = [](Cursor& c) { return skip_string(c) && skip_octets(c); };
  if (!skip_each(cursor, skip_two)) return false;
  return cursor.left() < 4 || skip_each(cursor, skip_binary);
}

bool skip_filter(Cursor& cursor) {
  return skip_string(cursor) && skip_string(cursor) && skip_string(cursor) && skip_string(cursor) &&
         skip_strings(cursor);
}

Objection judge_locator(Cursor& cursor) {
  const std::uint32_t kind = cursor.u32();
  if (cursor.left() != 20) return "a locator has not 24 octets";
  if (std::ranges::find(kLocatorKinds, kind) == std::end(kLocatorKinds)) {
    return "a locator is of an unknown kind";
  }
  return {};
}

Objection unless(bool is_good, Objection otherwise) { return is_good ? Objection{} : otherwise; }

Objection judge(Form form, Cursor& cursor) {
  switch (form) {
    case Form::kString:
      return unless(skip_string(cursor), "a string goes beyond its parameter, or has no end");
    case Form::kStrings:
      return unless(skip_strings(cursor), "a list of strings goes beyond its parameter");
    case Form::kOctets:
      return unless(skip_octets(cursor), "a sequence of octets goes beyond its parameter");
    case Form::kProperties:
      return unless(skip_properties(cursor), "a list of properties goes beyond its parameter");
    case Form::kToken:
      return unless(skip_string(cursor) && skip_properties(cursor),
                    "a token goes beyond its parameter");
    case Form::kFilter:
      return unless(skip_filter(cursor), "a content filter goes beyond its parameter");
    case Form::kLocator:
      return judge_locator(cursor);
    case Form::kGuid:
      return unless(cursor.left() == 16, "a GUID has not 16 octets");
    case Form::kDuration:
      return unless(cursor.left() == 8, "a duration has not 8 octets");
    case Form::kWord:
      return unless(cursor.left() >= 4, "a parameter of 4 octets is shorter");
  }
  return {};
}

bool belongs_to(const Parameter& parameter, const GuidPrefix& source) {
  const bool is_guid = parameter.id == parameter::kParticipantGuid ||
                       parameter.id == parameter::kEndpointGuid ||
                       parameter.id == parameter::kKeyHash;
  return !is_guid || std::ranges::equal(parameter.value.first(source.octets.size()), source.octets);
}

}  // namespace

bool is_discovery(EntityId writer) {
  switch (writer.value) {
    case kSpdpWriter.value:
    case kSedpTopicWriter.value:
    case kSedpPublicationWriter.value:
    case kSedpSubscriptionWriter.value:
    case 0xff0003c2:
    case 0xff0004c2:
    case 0xff0101c2:
      return true;
    default:
      return false;
  }
}

Objection judge_discovered(const Parameter& parameter, Endianness endianness) {
  const auto* const formed = std::ranges::lower_bound(kFormed, parameter.id, {}, &Formed::id);
  if (formed == std::end(kFormed) || formed->id != parameter.id) return {};
  Cursor cursor(parameter.value, endianness);
  return judge(formed->form, cursor);
}

Objection judge_discovery(Octets payload, const GuidPrefix* source) {
  Cursor cursor(payload, Endianness::kBig);
  const std::uint16_t encapsulation = cursor.u16();
  if (encapsulation != kPlCdrBig && encapsulation != kPlCdrLittle) {
    return "discovery is no list of parameters";
  }
  const Endianness endianness =
      encapsulation == kPlCdrLittle ? Endianness::kLittle : Endianness::kBig;
  Cursor content(payload.subspan(std::min<std::size_t>(4, payload.size())), endianness);
  ParameterList list(content, endianness);
  while (const Parameter* one = list.next()) {
    if (const Objection objection = judge_discovered(*one, endianness); !objection.empty()) {
      return objection;
    }
    if (source != nullptr && !belongs_to(*one, *source)) {
      return "it tells of another participant than the one that sent it";
    }
  }
  return list.objection();
}

Objection judge_participant_message(Octets payload) {
  Cursor encapsulation(payload, Endianness::kBig);
  const std::uint16_t kind = encapsulation.u16();
  // The standard requires CDR; Fast DDS declares a list of parameters.
  if (kind > kPlCdrLittle) return "a participant message is of another encoding";
  Cursor cursor(payload, kind % 2 == 1 ? Endianness::kLittle : Endianness::kBig);
  cursor.take(4 + sizeof(GuidPrefix::octets) + 4);  // encapsulation, sender, kind
  return unless(skip_octets(cursor), "a participant message is too short");
}

}  // namespace hal::rtps
