#include "gateway/exchange/visitors.h"

#include <fmt/core.h>

#include <algorithm>

#include "gateway/guard/speaker_check.h"

namespace gateway::exchange {

hal::Result<void> Visitors::receive(const hal::node::exchange::Hello& hello, const Origin& origin,
                                    const std::optional<guard::UdpSender>& sender) {
  const auto known = visitors_.find(hello.instance);
  if (known != visitors_.end()) {
    if (participant_of(known->second.origin) == participant_of(origin)) return {};
    return hal::fail(hal::Errc::kProtocol,
                     fmt::format("it says to be instance '{}' of participant {}", hello.instance,
                                 text_of(participant_of(known->second.origin))));
  }
  const process::ProcessIdentity process{hello.host, hello.pid, hello.pid_start_time};
  if (auto checked = guard::check_speaker(process, sender, trust_); !checked) return checked;
  if (count(process) >= kMostOfProcess) {
    return hal::fail(hal::Errc::kProtocol,
                     fmt::format("its process has said {} Hellos already", kMostOfProcess));
  }
  visitors_[hello.instance] = {.origin = origin, .process = process};
  return {};
}

std::optional<Origin> Visitors::origin_of(const std::string& instance) const {
  const auto known = visitors_.find(instance);
  if (known == visitors_.end()) return std::nullopt;
  return known->second.origin;
}

bool Visitors::is_silent(const std::string& instance) const {
  const auto known = visitors_.find(instance);
  return known == visitors_.end() || known->second.is_silent;
}

std::size_t Visitors::count(const process::ProcessIdentity& process) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      visitors_, [&](const auto& entry) { return entry.second.process == process; }));
}

template <class Predicate>
std::vector<std::string> Visitors::erase(const Predicate& is_gone) {
  std::vector<std::string> gone;
  for (auto visitor = visitors_.begin(); visitor != visitors_.end();) {
    if (!is_gone(visitor->second)) {
      ++visitor;
      continue;
    }
    gone.push_back(visitor->first);
    visitor = visitors_.erase(visitor);
  }
  return gone;
}

std::vector<std::string> Visitors::leave(const Origin& writer) {
  return erase([&](const Visitor& visitor) { return visitor.origin == writer; });
}

std::vector<std::string> Visitors::fall_silent(const Origin& writer) {
  for (auto& [instance, visitor] : visitors_) {
    visitor.is_silent = visitor.is_silent || visitor.origin == writer;
  }
  return erase([&](const Visitor& visitor) {
    const process::ProcessWatch watch(visitor.process);
    // A process that was stopped when it became silent may have died since.
    return watch.is_local() ? watch.is_dead() : visitor.is_silent;
  });
}

}  // namespace gateway::exchange
