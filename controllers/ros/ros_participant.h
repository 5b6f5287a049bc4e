#pragma once

#include <exception>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>
#include <string>

namespace controllers {

/// A DDS participant among the nodes of ROS 2 (Humble), on one network interface and no other, by
/// UDP, with discovery as ROS 2's middleware has it. Whatever listens to its readers must outlive
/// it.
class RosParticipant {
 public:
  struct Settings {
    std::string interface;  ///< E.g. "wlan0"; its first IPv4 address is used.
    int domain = 0;         ///< ROS_DOMAIN_ID, 0..232.
    std::string name;       ///< Of the participant.
  };

  /// @throws std::runtime_error  the interface is not there or has no address, DDS cannot be
  /// opened.
  explicit RosParticipant(const Settings& settings);
  ~RosParticipant();
  RosParticipant(const RosParticipant&) = delete;
  RosParticipant& operator=(const RosParticipant&) = delete;

  /// @tparam Generated  what fastddsgen makes for a message, e.g. Twist_PubSubType.
  /// @param name  as in DDS: "rt/cmd_vel". @throws std::runtime_error
  template <class Generated>
  eprosima::fastdds::dds::Topic* topic(const std::string& name) {
    const eprosima::fastdds::dds::TypeSupport type(new Guarded<Generated>());
    // A peer of this version crashes when it is told a type with a sequence of structures.
    type->auto_fill_type_object(false);
    type->auto_fill_type_information(false);
    type.register_type(participant_);
    return registered(name, type.get_type_name());
  }
  /// Reliable, and never waits for the network. @param depth  of its history.
  /// @throws std::runtime_error
  eprosima::fastdds::dds::DataWriter* writer(eprosima::fastdds::dds::Topic* topic, int depth);
  /// @param best_effort  lost samples are not asked for again. @throws std::runtime_error
  eprosima::fastdds::dds::DataReader* reader(eprosima::fastdds::dds::Topic* topic, bool best_effort,
                                             eprosima::fastdds::dds::DataReaderListener* listener);

  /// rmw_qos_profile_default of ROS 2.
  static constexpr int kDepth = 10;

 private:
  /// What cannot be decoded is dropped: the generated code lets some of what Fast CDR throws
  /// through, and that would be the end of the program.
  template <class Generated>
  class Guarded final : public Generated {
   public:
    bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
      try {
        return Generated::deserialize(payload, data);
      } catch (const std::exception&) {
        return false;
      }
    }
  };

  eprosima::fastdds::dds::Topic* registered(const std::string& name, const std::string& type);
  void close();

  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
};

}  // namespace controllers
