#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "idl/ros/cdr.h"
#include "results/report/mcap_writer.h"

namespace results::report {

/// The topics of an MCAP file of ROS 2 messages. A topic is added with its first message.
class McapTopics {
 public:
  explicit McapTopics(McapWriter& file) : file_(file) {}

  /// Whether a player delivers the last message to readers that join later.
  enum class Latched : bool { kNo, kYes };

  /// @param message  of a type in idl/ros/cdr.h
  /// @throws std::runtime_error  there are more topics than an MCAP file can have
  template <class Message>
  void publish(std::int64_t at_ns, const std::string& topic, const Message& message,
               Latched latched = Latched::kNo) {
    idl::ros::write_cdr(message, bytes_);
    file_.add_message(channel_of(topic, idl::ros::kTypeName<Message>, latched), at_ns, bytes_);
  }

 private:
  std::uint16_t channel_of(const std::string& topic, std::string_view type, Latched latched);
  std::uint16_t channel(const std::string& topic, std::string_view type, Latched latched);

  McapWriter& file_;
  std::string bytes_;  ///< The last message, serialised.
  std::map<std::string, std::uint16_t> channels_;
  std::map<std::string, std::uint16_t, std::less<>> schemas_;
};

}  // namespace results::report
