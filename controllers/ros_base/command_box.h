#pragma once

#include <cmath>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <mutex>
#include <utility>

#include "controllers/ros_base/ros_node.h"
#include "inspect.h"
#include "ros_nodes.h"

namespace controllers {

/// Collects commands, of which `Message` is Twist_ or TwistStamped_; its callbacks run on a thread
/// of DDS. The stamp of a command is not looked at: the clocks of its sender and of the robot need
/// not agree.
class CommandBox {
 public:
  RosNode::Commands take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(commands_, {});
  }
  void put(const geometry_msgs::msg::dds_::TwistStamped_& sample) { put(sample.twist()); }
  void put(const geometry_msgs::msg::dds_::Twist_& sample) {
    const std::lock_guard lock(mutex_);
    if (!is_finite(sample.linear()) || !is_finite(sample.angular())) {
      ++commands_.senseless;
      return;
    }
    ++commands_.count;
    commands_.last = {sample.linear().x(), sample.linear().y(), sample.angular().z()};
  }

 private:
  static bool is_finite(const geometry_msgs::msg::dds_::Vector3_& v) {
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
  }

  std::mutex mutex_;
  RosNode::Commands commands_;
};

/// Puts what a reader gets into a box.
template <class Message>
class CommandListener : public eprosima::fastdds::dds::DataReaderListener {
 public:
  explicit CommandListener(CommandBox& box) : box_(box) {}
  void on_data_available(eprosima::fastdds::dds::DataReader* reader) override {
    Message sample;
    eprosima::fastdds::dds::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) box_.put(sample);
    }
  }

 private:
  CommandBox& box_;
};

}  // namespace controllers
