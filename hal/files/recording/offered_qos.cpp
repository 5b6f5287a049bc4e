#include "hal/files/recording/offered_qos.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/files/config/document_limits.h"
#include "hal/files/config/yaml.h"

namespace hal::files::recording {
namespace {

using config::Node;

/// From here on a duration is infinite: what Fast DDS has for RMW_DURATION_INFINITE, which itself
/// is 9223372036 s.
constexpr std::int64_t kInfiniteSeconds = 2147483647;

[[noreturn]] void refuse_qos(std::string_view what) {
  throw std::runtime_error(fmt::format("offered_qos_profiles: {}", what));
}

/// Numbers of `rmw_qos_*_policy_t` and their words, beginning with 0.
using Words = std::span<const std::string_view>;
constexpr std::string_view kHistories[] = {"system_default", "keep_last", "keep_all", "unknown"};
constexpr std::string_view kReliabilities[] = {"system_default", "reliable", "best_effort",
                                               "unknown", "best_available"};
constexpr std::string_view kDurabilities[] = {"system_default", "transient_local", "volatile",
                                              "unknown", "best_available"};

/// @return the word of a policy; "unknown" if it is not told.
std::string_view policy(const Node& profile, const std::string& key, Words words) {
  const config::Entry* const entry = profile.find(key);
  if (entry == nullptr) return "unknown";
  std::size_t number = 0;
  for (const std::string_view word : words) {
    if (entry->value.text == word || entry->value.text == std::to_string(number)) return word;
    ++number;
  }
  refuse_qos(fmt::format("{} is {}", key, config::kind_name(entry->value)));
}

std::int64_t whole_number_of(const Node& mapping, const std::string& key) {
  const config::Entry* const entry = mapping.find(key);
  if (entry == nullptr) return 0;
  const std::string& text = entry->value.text;
  std::int64_t number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 0)
    refuse_qos(fmt::format("{} is {}", key, config::kind_name(entry->value)));
  return number;
}

std::optional<Duration> deadline_of(const Node& profile) {
  const config::Entry* const entry = profile.find("deadline");
  if (entry == nullptr) return std::nullopt;
  const std::int64_t seconds = whole_number_of(entry->value, "sec");
  const std::int64_t rest = whole_number_of(entry->value, "nsec");
  if (rest > UINT32_MAX) refuse_qos(fmt::format("a deadline has {} ns", rest));
  if (seconds >= kInfiniteSeconds || (seconds == 0 && rest == 0)) return std::nullopt;
  return std::chrono::seconds(seconds) + Duration(rest);
}

OfferedQos to_offered(const Node& profile) {
  if (profile.kind != Node::Kind::kMapping)
    refuse_qos("a profile is " + config::kind_name(profile));
  OfferedQos offered;
  const std::string_view history = policy(profile, "history", kHistories);
  const std::int64_t depth = whole_number_of(profile, "depth");
  if (depth > UINT32_MAX) refuse_qos(fmt::format("a depth is {}", depth));
  if (history == "keep_all") {
    offered.qos.depth.reset();
  } else if (depth > 0) {
    offered.qos.depth = static_cast<std::uint32_t>(depth);
  } else {
    offered.tells_depth = false;
  }
  if (policy(profile, "reliability", kReliabilities) == "best_effort")
    offered.qos.reliability = TopicQos::Reliability::kBestEffort;
  if (policy(profile, "durability", kDurabilities) == "transient_local")
    offered.qos.durability = TopicQos::Durability::kTransientLocal;
  offered.qos.deadline = deadline_of(profile);
  return offered;
}

}  // namespace

std::optional<OfferedQos> read_offered_qos(const std::string& text) {
  std::vector<config::Problem> problems;
  std::size_t values_left = config::kMostValues;
  const Node list = config::parse_yaml(text, {}, problems, values_left);
  if (!problems.empty()) refuse_qos(problems.front().what);
  if (list.kind == Node::Kind::kNull) return std::nullopt;
  if (list.kind == Node::Kind::kScalar && list.text.empty()) return std::nullopt;
  if (list.kind != Node::Kind::kList) refuse_qos("it is " + config::kind_name(list));
  std::optional<OfferedQos> first;
  for (const Node& profile : list.items) {
    const OfferedQos offered = to_offered(profile);
    if (!first) first = offered;
    first->qos.reliability = std::max(first->qos.reliability, offered.qos.reliability);
    first->qos.durability = std::max(first->qos.durability, offered.qos.durability);
  }
  return first;
}

}  // namespace hal::files::recording
