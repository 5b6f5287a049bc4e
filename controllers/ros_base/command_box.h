#pragma once

#include <cmath>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <mutex>
#include <utility>

#include "controllers/ros_base/ros_node.h"
#include "inspect.h"

namespace controllers {

/// Collects commands; its callbacks run on a thread of DDS.
class CommandBox : public eprosima::fastdds::dds::DataReaderListener {
 public:
  void on_data_available(eprosima::fastdds::dds::DataReader* reader) override {
    Twist sample;
    eprosima::fastdds::dds::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) put(sample);
    }
  }
  RosNode::Commands take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(commands_, {});
  }

 private:
  using Twist = geometry_msgs::msg::dds_::Twist_;

  static bool is_finite(const geometry_msgs::msg::dds_::Vector3_& v) {
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
  }

  void put(const Twist& sample) {
    const std::lock_guard lock(mutex_);
    if (!is_finite(sample.linear()) || !is_finite(sample.angular())) {
      ++commands_.senseless;
      return;
    }
    ++commands_.count;
    commands_.last = {sample.linear().x(), sample.linear().y(), sample.angular().z()};
  }

  std::mutex mutex_;
  RosNode::Commands commands_;
};

}  // namespace controllers
