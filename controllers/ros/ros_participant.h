#pragma once

#include <exception>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>
#include <string>

namespace controllers {

/// QoS of a topic as ROS 2 has it: reliable, or RELIABILITY best effort; volatile, or DURABILITY
/// transient local; HISTORY keep last. The defaults are rmw_qos_profile_default.
struct RosQos {
  int depth = 10;
  bool best_effort = false;      ///< Lost samples are not retransmitted.
  bool transient_local = false;  ///< Late readers get the last samples.
};

/// A DDS participant that communicates with ROS 2 nodes (Humble), on one network interface only,
/// over UDP, with the discovery of ROS 2's middleware. Listeners of its readers must outlive it.
class RosParticipant {
 public:
  struct Settings {
    std::string interface;  ///< E.g. "wlan0"; its first IPv4 address is used.
    int domain = 0;         ///< ROS_DOMAIN_ID, 0..232.
    std::string name;       ///< Name of the participant.
    /// User data of the participant, by which rmw finds those with nodes; empty: none.
    std::string user_data{};
  };

  /// @throws std::runtime_error  the interface does not exist or has no address, or DDS fails to
  ///   open.
  explicit RosParticipant(const Settings& settings);
  ~RosParticipant();
  RosParticipant(const RosParticipant&) = delete;
  RosParticipant& operator=(const RosParticipant&) = delete;

  /// @tparam Generated  class that fastddsgen generates for a message, e.g. Twist_PubSubType.
  /// @param name  as in DDS: "rt/cmd_vel". @throws std::runtime_error
  template <class Generated>
  eprosima::fastdds::dds::Topic* topic(const std::string& name) {
    const eprosima::fastdds::dds::TypeSupport type(new Guarded<Generated>());
    // A peer with this version crashes when it receives a type with a sequence of structures.
    type->auto_fill_type_object(false);
    type->auto_fill_type_information(false);
    type.register_type(participant_);
    return registered(name, type.get_type_name());
  }
  /// It never blocks on the network. @throws std::runtime_error
  eprosima::fastdds::dds::DataWriter* writer(eprosima::fastdds::dds::Topic* topic,
                                             const RosQos& ros);
  /// @throws std::runtime_error
  eprosima::fastdds::dds::DataReader* reader(eprosima::fastdds::dds::Topic* topic,
                                             const RosQos& ros,
                                             eprosima::fastdds::dds::DataReaderListener* listener);

  const eprosima::fastrtps::rtps::GUID_t& guid() const { return participant_->guid(); }

 private:
  /// Drops samples that cannot be decoded: the generated code does not catch all exceptions of Fast
  /// CDR, and those would end the program.
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
