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

/// Publishes one channel of an agent on rt/<agent>/<channel>, with the ROS 2 type for its kind.
class ChannelWriter {
 public:
  ChannelWriter() = default;
  ChannelWriter(const ChannelWriter&) = delete;
  ChannelWriter& operator=(const ChannelWriter&) = delete;
  virtual ~ChannelWriter() = default;

  virtual bool has_readers() const noexcept = 0;
  /// @param values  a reading of the channel; ignored if the number of values is wrong.
  virtual void publish(hal::Time at, std::span<const double> values) = 0;
};

/// The topic rt/<agent>/<channel> of a channel.
struct ChannelTopic {
  domain::Participant& participant;
  const std::string& agent;  ///< The agent's name.
  const hal::Channel& channel;
  std::atomic<int>& readers;  ///< Counts readers; may be shared with other writers.
};

/// @return null: the channel's kind has no ROS 2 type.
/// @throws std::runtime_error  if DDS makes no writer.
std::unique_ptr<ChannelWriter> make_channel_writer(const ChannelTopic& topic);

}  // namespace gateway::inspection
