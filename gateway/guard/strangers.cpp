#include "gateway/guard/strangers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "gateway/guard/socket_owner.h"
#include "hal/rtps/data.h"
#include "hal/rtps/discovery.h"
#include "hal/rtps/endpoint.h"
#include "hal/rtps/walk.h"
#include "hal/types/log.h"

namespace gateway::guard {
namespace {

/// Time for which a refusal is valid without another check.
constexpr hal::Duration kRefusalHolds = std::chrono::milliseconds{250};
constexpr std::size_t kMostRefused = 1024;  // ports
constexpr std::size_t kMostStrangers = 16;
constexpr std::size_t kMostAttempts = 8;  // per stranger
constexpr std::size_t kLongestName = 64;  // characters of a name in a message

/// PID_ENTITY_NAME in the SPDP data of a participant (OMG DDSI-RTPS 2.5, table 9.13).
std::string name_of_participant(hal::rtps::Octets payload) {
  constexpr std::uint16_t kEntityName = 0x0062;
  constexpr std::uint16_t kLittleEndianList = 0x0003;  // PL_CDR_LE (10.2)
  hal::rtps::Cursor cursor(payload, hal::rtps::Endianness::kBig);
  const auto endianness = cursor.u16() == kLittleEndianList ? hal::rtps::Endianness::kLittle
                                                            : hal::rtps::Endianness::kBig;
  cursor = hal::rtps::Cursor(payload.subspan(4), endianness);
  hal::rtps::ParameterList list(cursor, endianness);
  while (const hal::rtps::Parameter* one = list.next()) {
    if (one->id != kEntityName) continue;
    hal::rtps::Cursor text(one->value, endianness);
    const hal::rtps::Octets octets = text.take(text.u32());
    return {reinterpret_cast<const char*>(octets.data()), octets.empty() ? 0 : octets.size() - 1};
  }
  return {};
}

std::string attempt_of(const hal::rtps::Data& data) {
  if (data.payload.size() < 4 || data.is_key) return {};
  if (data.writer == hal::rtps::kSpdpWriter) {
    return fmt::format("is called '{}'", name_of_participant(data.payload).substr(0, kLongestName));
  }
  const bool writes = data.writer == hal::rtps::kSedpPublicationWriter;
  if (!writes && data.writer != hal::rtps::kSedpSubscriptionWriter) return {};
  const auto endpoint = hal::rtps::read_endpoint(data.payload);
  if (!endpoint || endpoint->topic.empty()) return {};
  return fmt::format("{} {}", writes ? "writes" : "reads", endpoint->topic.substr(0, kLongestName));
}

/// "pid 7 (python3), " for the process that has a socket; empty if there is none that this process
/// may inspect.
std::string process_text(std::uint64_t inode) {
  const auto pid = inode == 0 ? std::nullopt : process_with(inode);
  if (!pid) return {};
  std::ifstream file(fmt::format("/proc/{}/comm", *pid));
  std::string program;
  std::getline(file, program);
  return fmt::format("pid {} ({}), ", *pid, program);
}

std::string name_of(const std::optional<uid_t>& user) {
  return user ? fmt::format("user {}", *user) : "somebody";
}

}  // namespace

std::vector<std::string> attempts_in(hal::rtps::Octets datagram) {
  std::vector<std::string> attempts;
  hal::rtps::Walk walk(datagram);
  while (const hal::rtps::Submessage* one = walk.next()) {
    if (one->kind != hal::rtps::SubmessageKind::kData) continue;
    hal::rtps::Data data;
    if (!hal::rtps::judge_data(*one, walk.header().source, {}, data).empty()) continue;
    std::string attempt = attempt_of(data);
    if (!attempt.empty()) attempts.push_back(std::move(attempt));
  }
  return attempts;
}

bool Strangers::refuse(hal::rtps::Octets datagram, const UdpSender& sender) {
  std::string news;
  std::vector<std::string> attempts;
  {
    const std::lock_guard lock(mutex_);
    const Refused* const refused = refused_at(sender, news);
    if (refused == nullptr) return false;
    const auto stranger = strangers_.find(refused->user);
    if (stranger == strangers_.end()) return true;  // not kept: there are too many
    ++stranger->second.datagrams;
    auto& known = stranger->second.attempts;
    if (known.size() < kMostAttempts) attempts = attempts_in(datagram);
    for (const std::string& attempt : attempts) {
      if (known.size() < kMostAttempts) known.insert(attempt);
    }
  }
  if (news.empty()) return true;
  hal::log::warning(hal::Time{}, "dds", "{}{}{}; more of it is only counted", news,
                    attempts.empty() ? "" : "; it ", fmt::join(attempts, ", "));
  return true;
}

const Strangers::Refused* Strangers::refused_at(const UdpSender& sender, std::string& news) {
  const hal::Time now = clock_.now();
  const auto known = refused_.find(sender);
  if (known != refused_.end() && now < known->second.until) return &known->second;
  const SenderJudgement judgement = judge_sender(sender, trust_);
  if (judgement.objection.empty()) {
    if (known != refused_.end()) refused_.erase(known);
    return nullptr;
  }
  if (refused_.size() == kMostRefused) refused_.clear();
  if (!strangers_.contains(judgement.user) && strangers_.size() < kMostStrangers) {
    strangers_[judgement.user] = {};
    news = introduction(judgement, sender);
  }
  Refused& refused = refused_[sender];
  refused = {judgement.user, now + kRefusalHolds};
  return &refused;
}

std::string Strangers::introduction(const SenderJudgement& judgement,
                                    const UdpSender& sender) const {
  return fmt::format("{} ({}{}) is not heard by this process of user {}: {}, and {}={} is not set",
                     name_of(judgement.user), process_text(judgement.inode), sender.text(),
                     geteuid(), judgement.objection, kTrustVariable,
                     judgement.user ? std::to_string(*judgement.user) : "unverified");
}

std::vector<std::string> Strangers::summary() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> lines;
  lines.reserve(strangers_.size());
  for (const auto& [user, stranger] : strangers_) {
    lines.push_back(fmt::format("{}: {} datagrams{}{}", name_of(user), stranger.datagrams,
                                stranger.attempts.empty() ? "" : "; it ",
                                fmt::join(stranger.attempts, ", ")));
  }
  return lines;
}

}  // namespace gateway::guard
