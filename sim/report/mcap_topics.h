#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "sim/report/mcap_writer.h"

namespace sim::report {

/// The topics of an MCAP file of ROS 2 messages; each is there from its first message on.
class McapTopics {
 public:
  explicit McapTopics(McapWriter& file) : file_(file) {}

  /// Whether a player hands the last message to readers that come later.
  enum class Latched : bool { kNo, kYes };

  /// @param type  "std_msgs/msg/Bool"; ros_schema() knows it.  @param message  in CDR
  /// @throws std::runtime_error  more topics than such a file can have
  void publish(std::int64_t at_ns, const std::string& topic, std::string_view type,
               std::string_view message, Latched latched = Latched::kNo);

 private:
  std::uint16_t channel(const std::string& topic, std::string_view type, Latched latched);

  McapWriter& file_;
  std::map<std::string, std::uint16_t> channels_;
  std::map<std::string, std::uint16_t, std::less<>> schemas_;
};

}  // namespace sim::report
