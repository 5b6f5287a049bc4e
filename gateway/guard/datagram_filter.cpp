#include "gateway/guard/datagram_filter.h"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "gateway/guard/socket_table.h"
#include "gateway/guard/strangers.h"
#include "hal/rtps/validate.h"
#include "hal/types/log.h"

namespace gateway::guard {
namespace {

constexpr const char* kWhere = "dds";
/// Maximum number of participants whose ports are kept; the one that was silent longest is removed.
constexpr std::size_t kMostSpeakers = 8192;
/// Maximum number of sequence numbers that a participant may skip: Fast DDS iterates over them,
/// which takes 2 s for this number. A reader cannot join late a writer with more samples.
constexpr std::int64_t kMostSkipped = 1 << 26;
/// Maximum number of addresses and reasons in the summary of drops.
constexpr std::size_t kMostNamed = 8;
constexpr std::size_t kMostReasons = 5;
constexpr std::uint32_t kWholeAddress = 0xffffffff;

std::uint32_t number_of(const sockaddr* address) {
  return ntohl(reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr);
}

std::uint32_t number_of(const std::string& address) {
  in_addr parsed{};
  return inet_pton(AF_INET, address.c_str(), &parsed) == 1 ? ntohl(parsed.s_addr) : 0;
}

bool is_in_use(const UdpSender& port) {
  const auto sockets = sockets_behind(port);
  return sockets && !sockets->empty();
}

/// Netmask of the interface that has the address.
std::uint32_t mask_of(std::uint32_t address, const ifaddrs* interfaces) {
  for (const ifaddrs* one = interfaces; one != nullptr; one = one->ifa_next) {
    const bool is_it = one->ifa_addr != nullptr && one->ifa_netmask != nullptr &&
                       one->ifa_addr->sa_family == AF_INET && number_of(one->ifa_addr) == address;
    if (is_it) return number_of(one->ifa_netmask);
  }
  return kWholeAddress;
}

}  // namespace

std::vector<Network> networks_of(const std::vector<std::string>& addresses) {
  ifaddrs* interfaces = nullptr;
  if (getifaddrs(&interfaces) != 0) interfaces = nullptr;
  std::vector<Network> networks;
  for (const std::string& text : addresses) {
    const std::uint32_t address = number_of(text);
    networks.push_back({address, mask_of(address, interfaces)});
  }
  for (const ifaddrs* one = interfaces; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    networks.push_back({number_of(one->ifa_addr), kWholeAddress});
  }
  if (interfaces != nullptr) freeifaddrs(interfaces);
  return networks;
}

DatagramFilter::DatagramFilter(Settings settings) : settings_(std::move(settings)) {
  if (settings_.trust) {
    strangers_ = std::make_unique<Strangers>(*settings_.trust, settings_.clock);
  }
}

DatagramFilter::~DatagramFilter() {
  for (const std::string& line : strangers()) {
    hal::log::warning(hal::Time{}, kWhere, "not heard in all: {}", line);
  }
  const std::string dropped = drops();
  if (!dropped.empty()) hal::log::warning(hal::Time{}, kWhere, "dropped in all {}", dropped);
}

std::vector<std::string> DatagramFilter::strangers() const {
  return strangers_ ? strangers_->summary() : std::vector<std::string>{};
}

bool DatagramFilter::is_near(std::uint32_t address) const {
  return std::ranges::any_of(settings_.networks, [&](const auto& n) { return n.holds(address); });
}

bool DatagramFilter::lets_in(hal::rtps::Octets datagram, const UdpSender& sender) {
  const hal::rtps::Walk walk(datagram);
  Reason reason = objection_to(walk, sender);
  if (reason.what.empty()) {
    const hal::rtps::GuidPrefix& source = walk.header().source;
    if (is_of_stranger(source, datagram, sender)) return false;
    reason = objection_to(source, datagram, sender);
  }
  if (!reason.what.empty()) drop(reason, sender);
  return reason.what.empty();
}

/// The user of a port that this participant has used before is not looked up again.
bool DatagramFilter::is_of_stranger(const hal::rtps::GuidPrefix& source, hal::rtps::Octets datagram,
                                    const UdpSender& sender) {
  if (!strangers_) return false;
  {
    const std::lock_guard lock(mutex_);
    const auto known = speakers_.find(source);
    if (known != speakers_.end() && known->second.sender == sender) return false;
  }
  return strangers_->refuse(datagram, sender);
}

DatagramFilter::Reason DatagramFilter::objection_to(const hal::rtps::Walk& walk,
                                                    const UdpSender& sender) const {
  if (!is_near(sender.address)) {
    return {"sender", "it is beyond the interfaces of this participant"};
  }
  const auto& ports = settings_.ports;
  if (!ports.empty() && std::ranges::find(ports, sender.port) == ports.end()) {
    return {"sender", "it is not the process that invited this one"};
  }
  if (walk.fault()) return {walk.fault()->part, walk.fault()->what};
  return {};
}

DatagramFilter::Reason DatagramFilter::objection_to(const hal::rtps::GuidPrefix& source,
                                                    hal::rtps::Octets datagram,
                                                    const UdpSender& sender) {
  const std::lock_guard lock(mutex_);
  const auto known = speakers_.find(source);
  Speaker speaker = known == speakers_.end() ? Speaker{.sender = sender} : known->second;
  if (speaker.is_ignored) return {"sender", "its participant is not heard any more"};
  if (settings_.is_star && speaker.sender != sender) {
    // A participant that ended and was created again in the same process has the same GUID, and its
    // old port is free.
    if (is_in_use(speaker.sender)) {
      return {"sender", "its participant speaks from another port"};
    }
    speaker.sender = sender;
  }
  const hal::rtps::Limits limits{.sequence_number = speaker.highest + kMostSkipped,
                                 .relayed_discovery = !settings_.is_star};
  if (const auto fault = hal::rtps::fault_in(datagram, limits, speaker.highest)) {
    return {fault->part, fault->what};
  }
  speaker.heard = ++heard_;
  speaker.heard_at = settings_.clock.now();
  if (known != speakers_.end()) {
    known->second = speaker;
  } else {
    meet(source, speaker);
  }
  return {};
}

void DatagramFilter::meet(const hal::rtps::GuidPrefix& participant, const Speaker& speaker) {
  if (speakers_.size() == kMostSpeakers) {
    speakers_.erase(std::ranges::min_element(speakers_, {},
                                             [](const auto& entry) { return entry.second.heard; }));
  }
  speakers_[participant] = speaker;
}

void DatagramFilter::ignore(const hal::rtps::GuidPrefix& participant) {
  const std::lock_guard lock(mutex_);
  speakers_[participant].is_ignored = true;
}

std::optional<UdpSender> DatagramFilter::sender_of(const hal::rtps::GuidPrefix& participant) const {
  const std::lock_guard lock(mutex_);
  const auto speaker = speakers_.find(participant);
  if (speaker == speakers_.end() || speaker->second.sender.port == 0) return std::nullopt;
  return speaker->second.sender;
}

std::optional<hal::Duration> DatagramFilter::silence_of(
    const hal::rtps::GuidPrefix& participant) const {
  const std::lock_guard lock(mutex_);
  const auto speaker = speakers_.find(participant);
  if (speaker == speakers_.end() || speaker->second.heard == 0) return std::nullopt;
  return settings_.clock.now() - speaker->second.heard_at;
}

void DatagramFilter::drop(const Reason& reason, const UdpSender& sender) {
  {
    const std::lock_guard lock(mutex_);
    ++drops_[reason];
    if (named_.size() == kMostNamed) return;
    const auto is_named = [&](const UdpSender& one) { return one.address == sender.address; };
    if (std::ranges::any_of(named_, is_named)) return;
    named_.push_back(sender);
  }
  hal::log::warning(hal::Time{}, kWhere,
                    "dropped a datagram from {}: {}: {}; more are only counted", sender.text(),
                    reason.part, reason.what);
}

std::string DatagramFilter::drops() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::pair<std::uint64_t, Reason>> reasons;
  std::uint64_t total = 0;
  for (const auto& [reason, count] : drops_) {
    reasons.emplace_back(count, reason);
    total += count;
  }
  if (total == 0) return {};
  std::ranges::sort(reasons, std::greater{});
  std::string text = fmt::format("{} datagrams from {}{}", total, named_.front().text(),
                                 named_.size() > 1 ? " and others" : "");
  for (std::size_t i = 0; i < std::min(reasons.size(), kMostReasons); ++i) {
    text += fmt::format("{} {} {}: {}", i == 0 ? ":" : ";", reasons[i].first,
                        reasons[i].second.part, reasons[i].second.what);
  }
  return reasons.size() > kMostReasons ? text + "; and others" : text;
}

}  // namespace gateway::guard
