#include "hal/files/recording/rtps_traffic.h"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "hal/rtps/walk.h"
#include "hal/types/printable.h"

namespace hal::files::recording {
namespace {

using rtps::SubmessageKind;

bool announces_writers(rtps::EntityId writer) {
  constexpr rtps::EntityId kSecure{0xff0003c2};
  return writer == rtps::kSedpPublicationWriter || writer == kSecure;
}

bool announces_readers(rtps::EntityId writer) {
  constexpr rtps::EntityId kSecure{0xff0004c2};
  return writer == rtps::kSedpSubscriptionWriter || writer == kSecure;
}

OfferedQos to_offered(const rtps::DiscoveredEndpoint& told) {
  OfferedQos offered;
  constexpr std::uint32_t kBestEffort = 1;
  if (told.reliability == kBestEffort)  // a writer's default is reliable (OMG DDS 1.4, 2.2.3)
    offered.qos.reliability = TopicQos::Reliability::kBestEffort;
  if (told.durability > 0) offered.qos.durability = TopicQos::Durability::kTransientLocal;
  if (told.deadline) offered.qos.deadline = Duration(*told.deadline);
  offered.tells_depth = told.history.has_value();
  if (told.history && told.history->keeps_all) {
    offered.qos.depth.reset();
  } else if (told.history && told.history->depth > 0) {
    offered.qos.depth = told.history->depth;
  }
  return offered;
}

/// The participant that INFO_SRC names (8.3.7.9): after unused octets, version and vendor.
void follow_source(const rtps::Submessage& one, rtps::GuidPrefix& source) {
  constexpr std::size_t kPrefix = 8;
  if (one.kind != SubmessageKind::kInfoSource || one.body.size() < kPrefix + source.octets.size())
    return;
  std::ranges::copy(one.body.subspan(kPrefix, source.octets.size()), source.octets.begin());
}

std::string unknown_writer(const rtps::Guid& guid) {
  std::string name = "unknown_writer_";
  for (const std::byte octet : guid.prefix.octets)
    name += fmt::format("{:02x}", std::to_integer<unsigned>(octet));
  return name + fmt::format("_{:08x}", guid.entity.value);
}

std::string address_text(const rtps::IpAddress& address) {
  constexpr std::ptrdiff_t kBeforeIpv4 = 12;
  const bool is_four = std::all_of(address.begin(), address.begin() + kBeforeIpv4,
                                   [](std::uint8_t octet) { return octet == 0; });
  char text[INET6_ADDRSTRLEN] = {};
  ::inet_ntop(is_four ? AF_INET : AF_INET6, address.data() + (is_four ? kBeforeIpv4 : 0), text,
              sizeof(text));
  return text;
}

}  // namespace

std::string ros_type(std::string_view dds_type) {
  constexpr std::string_view kInside = "::dds_::";
  const std::size_t at = dds_type.find(kInside);
  std::string type(dds_type);
  if (at == std::string_view::npos || !dds_type.ends_with('_')) return type;
  type =
      fmt::format("{}::{}", dds_type.substr(0, at),
                  dds_type.substr(at + kInside.size(), dds_type.size() - at - kInside.size() - 1));
  for (std::size_t i = type.find("::"); i != std::string::npos; i = type.find("::", i))
    type.replace(i, 2, "/");
  return type;
}

bool RtpsTraffic::read(std::int64_t at, const rtps::IpAddress& from, rtps::Octets datagram) {
  rtps::Walk walk(datagram);
  if (walk.fault()) return false;
  ++datagrams_;
  octets_ += datagram.size();
  Sender sender{from, walk.header().source};
  while (const rtps::Submessage* one = walk.next()) {
    follow_source(*one, sender.participant);
    if (one->kind == SubmessageKind::kData || one->kind == SubmessageKind::kDataFrag)
      read_data(at, *one, sender);
    encrypted_ += one->kind == SubmessageKind::kSecureBody ? 1 : 0;
  }
  malformed_ += walk.fault() ? 1 : 0;
  return true;
}

void RtpsTraffic::read_data(std::int64_t at, const rtps::Submessage& one, const Sender& sender) {
  rtps::Data data;
  if (!judge_data(one, sender.participant, {}, data).empty()) {
    ++malformed_;
    return;
  }
  if (announces_writers(data.writer)) return learn(data);
  if (announces_readers(data.writer)) return learn_reader(data);
  if (data.writer.is_builtin() || data.is_key || data.payload.empty()) return;
  const std::uint32_t bytes =
      data.fragment_size > 0 ? data.sample_size : static_cast<std::uint32_t>(data.payload.size());
  Writer& writer = writers_[{sender.participant, data.writer}];
  if (writer.samples.empty()) writer.address = sender.address;
  const bool is_new = writer.samples.emplace(data.sequence_number, Sample{at, bytes}).second;
  if (is_new && ++samples_ > kMostSamples)
    throw std::runtime_error(fmt::format("there are more than {} samples", kMostSamples));
}

void RtpsTraffic::learn(const rtps::Data& data) {
  const auto told = rtps::read_endpoint(data.payload);
  if (!told || data.status != 0 || told->topic.empty()) return;
  Writer& writer = writers_[told->guid];
  writer.topic = printable(told->topic);
  writer.type = ros_type(printable(told->type));
  writer.offered = to_offered(*told);
}

void RtpsTraffic::learn_reader(const rtps::Data& data) {
  const auto told = rtps::read_endpoint(data.payload);
  if (!told || data.status != 0 || told->topic.empty()) return;
  const auto [found, is_new] = readers_.try_emplace(printable(told->topic), told->guid.prefix);
  if (!is_new) found->second = std::min(found->second, told->guid.prefix);
}

/// Of the participants that write or read topics.
std::map<rtps::GuidPrefix, std::uint32_t> RtpsTraffic::numbers() const {
  std::map<rtps::GuidPrefix, std::uint32_t> numbers;
  for (const auto& [guid, writer] : writers_) numbers[guid.prefix] = 0;
  for (const auto& [topic, prefix] : readers_) numbers[prefix] = 0;
  std::uint32_t next = 0;
  for (auto& [prefix, number] : numbers) number = next++;
  return numbers;
}

void RtpsTraffic::finish(Collector& into) const {
  if (datagrams_ == 0) return;
  std::uint64_t of_samples = 0, unknown = 0;
  for (const auto& [guid, writer] : writers_) {
    const bool is_known = !writer.topic.empty();
    unknown += is_known ? 0 : 1;
    const std::size_t topic = is_known ? into.topic(writer.topic, writer.type, writer.offered)
                                       : into.topic(unknown_writer(guid), "", std::nullopt);
    for (const auto& [number, sample] : writer.samples) {
      into.add(topic, sample.at, sample.bytes);
      of_samples += sample.bytes;
    }
  }
  into.note(
      fmt::format("RTPS: {} datagrams of {} bytes, of which samples take {}; discovery, "
                  "acknowledgements, repetitions and headers are not among the topics",
                  datagrams_, octets_, of_samples));
  if (unknown > 0)
    into.note(
        fmt::format("{} writer{} not announced in the capture, which began later: {} under "
                    "unknown_writer_GUID, without a type or QoS",
                    unknown, unknown == 1 ? " is" : "s are", unknown == 1 ? "it is" : "they are"));
  tell_participants(into);
  note_addresses(into);
  if (malformed_ > 0) into.note(fmt::format("{} RTPS messages are malformed", malformed_));
  if (encrypted_ > 0)
    into.note(
        fmt::format("{} RTPS submessages are encrypted; their samples are not seen", encrypted_));
}

void RtpsTraffic::tell_participants(Collector& into) const {
  const auto number_of = numbers();
  for (const bool is_silent : {false, true}) {  // those with samples are the first to count
    for (const auto& [guid, writer] : writers_) {
      if (writer.samples.empty() != is_silent) continue;
      std::optional<std::uint32_t> reader;
      if (const auto found = readers_.find(writer.topic); found != readers_.end())
        reader = number_of.at(found->second);
      const std::string name = writer.topic.empty() ? unknown_writer(guid) : writer.topic;
      into.participants(into.topic(name, "", std::nullopt), number_of.at(guid.prefix), reader);
    }
  }
}

void RtpsTraffic::note_addresses(Collector& into) const {
  std::map<rtps::IpAddress, std::set<std::string>> topics;
  for (const auto& [guid, writer] : writers_) {
    if (!writer.samples.empty())
      topics[writer.address].insert(writer.topic.empty() ? unknown_writer(guid) : writer.topic);
  }
  if (topics.size() < 2) return;
  for (const auto& [address, names] : topics) {
    into.note(fmt::format("written at {}: {}", address_text(address), fmt::join(names, ", ")));
  }
}

}  // namespace hal::files::recording
