#pragma once

#include <string>
#include <utility>

#include "controllers/ros_base/freshness.h"
#include "controllers/ros_base/ros_node.h"
#include "hal/api/robot.h"
#include "idl/ros/sensors.h"

namespace controllers {

/// A topic with the readings of one channel.
class SensorTopic {
 public:
  virtual ~SensorTopic() = default;
  /// Writes the reading that the robot holds, if it is new.
  virtual void publish(const hal::Robot& robot, RosNode& node, const RosNode::Stamp& stamp) = 0;
};

/// @tparam Kind  one of idl::ros::SensorKinds, whose channel has the name of its kind.
template <class Kind>
class SensorTopicOf final : public SensorTopic {
 public:
  /// @param topic  a key of base_topics(). @param frame  of the header, if the message has one.
  SensorTopicOf(std::string topic, const hal::Channel& channel, const std::string& frame)
      : topic_(std::move(topic)), freshness_(channel.period) {
    Kind::describe(message_, "", channel);
    if constexpr (kHasHeader) message_.header().frame_id(frame);
  }

  void publish(const hal::Robot& robot, RosNode& node, const RosNode::Stamp& stamp) override {
    const auto values = robot.reading(Kind::kKind);
    if (!values || values->size() < Kind::kValues) return;
    if (!freshness_.is_new(*values, robot.now())) return;
    Kind::measure(message_, {}, *values);
    if constexpr (kHasHeader) message_.header().stamp(stamp);
    node.write(topic_, message_);
  }

 private:
  using Message = typename Kind::Message;
  static constexpr bool kHasHeader = requires(Message & message) { message.header(); };

  const std::string topic_;
  Freshness freshness_;
  Message message_;
};

}  // namespace controllers
