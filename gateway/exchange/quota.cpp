#include "gateway/exchange/quota.h"

#include <fmt/core.h>

#include "hal/types/log.h"

namespace gateway::exchange {

std::string text_of(const hal::rtps::GuidPrefix& participant) {
  std::string text;
  for (const std::byte octet : participant.octets) {
    text += fmt::format("{:02x}", std::to_integer<unsigned>(octet));
  }
  return text;
}

bool Quota::admits(const guard::api::SampleInfo& info) {
  const hal::rtps::GuidPrefix participant = participant_of(info.publication_handle);
  {
    const std::lock_guard lock(mutex_);
    auto& own = instances_[participant];
    if (!info.valid_data) {
      own.erase(info.instance_handle);
      return false;
    }
    if (own.contains(info.instance_handle)) return true;
    if (own.size() < most_) {
      own.insert(info.instance_handle);
      return true;
    }
    // The rest of the current datagram still arrives.
    if (!refused_.insert(participant).second) return false;
  }
  const auto sender = filter_.sender_of(participant);
  filter_.ignore(participant);
  hal::log::warning(hal::Time{}, "dds",
                    "participant {} ({}) is not heard any more: it goes by more than {} names",
                    text_of(participant), sender ? sender->text() : "of unknown address", most_);
  return false;
}

void Quota::leave(const Origin& writer) {
  const std::lock_guard lock(mutex_);
  instances_.erase(participant_of(writer));
  refused_.erase(participant_of(writer));
}

}  // namespace gateway::exchange
