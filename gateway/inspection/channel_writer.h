#pragma once

#include <atomic>
#include <memory>
#include <span>
#include <string>

#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace gateway::domain {
class Participant;
}

namespace gateway::inspection {

/// Shows one channel of an agent on rt/<agent>/<channel>, in the type of ROS 2 that its kind has.
class ChannelWriter {
 public:
  ChannelWriter() = default;
  ChannelWriter(const ChannelWriter&) = delete;
  ChannelWriter& operator=(const ChannelWriter&) = delete;
  virtual ~ChannelWriter() = default;

  virtual bool has_readers() const noexcept = 0;
  /// @param values  of the channel; another number of them than it has is not shown.
  virtual void publish(hal::Time at, std::span<const double> values) = 0;
};

/// Where a channel is shown: rt/<agent>/<channel>.
struct ChannelTopic {
  domain::Participant& participant;
  const std::string& agent;  ///< Its name.
  const hal::Channel& channel;
  std::atomic<int>& readers;  ///< Of this and other writers; counted in.
};

/// @return null: no type of ROS 2 for that kind. @throws std::runtime_error
std::unique_ptr<ChannelWriter> make_channel_writer(const ChannelTopic& topic);

}  // namespace gateway::inspection
