#pragma once

#include <map>
#include <mutex>
#include <set>

#include "hal/dds/datagram_filter.h"
#include "hal/dds/exchange/origin.h"

namespace hal::dds {

/// How many instances of a topic one participant may have at a reader, so that none takes the room
/// of the others: who has more is not heard any more at all. Any thread.
class Quota {
 public:
  /// @param most  instances of one participant.
  Quota(DatagramFilter& filter, std::size_t most) : filter_(filter), most_(most) {}

  /// Notes a sample, or that its instance is gone. @return whether to take the sample.
  bool admits(const api::SampleInfo& info);
  /// A writer is gone, and its instances with it.
  void leave(const Origin& writer);

 private:
  DatagramFilter& filter_;
  std::size_t most_;
  std::mutex mutex_;
  std::map<hal::rtps::GuidPrefix, std::set<rtps::InstanceHandle_t>> instances_;
  std::set<hal::rtps::GuidPrefix> refused_;
};

}  // namespace hal::dds
