#pragma once

#include <map>
#include <mutex>
#include <set>

#include "gateway/exchange/origin.h"
#include "gateway/guard/datagram_filter.h"

namespace gateway::exchange {

/// Limits the number of instances of a topic that one participant may have at a reader, so that no
/// participant uses up the memory of others. A participant that exceeds the limit is refused from
/// then on. Any thread.
class Quota {
 public:
  /// @param most  instances of one participant.
  Quota(guard::DatagramFilter& filter, std::size_t most) : filter_(filter), most_(most) {}

  /// Notes a sample, or that its instance is gone. @return whether the sample is accepted.
  bool admits(const guard::api::SampleInfo& info);
  /// Call when a writer has left: its instances are gone as well.
  void leave(const Origin& writer);

 private:
  guard::DatagramFilter& filter_;
  std::size_t most_;
  std::mutex mutex_;
  std::map<hal::rtps::GuidPrefix, std::set<guard::rtps::InstanceHandle_t>> instances_;
  std::set<hal::rtps::GuidPrefix> refused_;
};

}  // namespace gateway::exchange
