#pragma once

#include <fastdds/rtps/common/Guid.h>

#include <string>
#include <vector>

#include "ros_nodes.h"

namespace controllers {

/// Gid of an entity as rmw_fastrtps makes it (release Humble): its GUID, then zeros.
rmw_dds_common::msg::dds_::Gid_ gid_of(const eprosima::fastrtps::rtps::GUID_t& guid);

/// A node with all its endpoints.
struct NodeEntities {
  std::string name_space, name;  ///< "r0" or empty; "ros_base".
  std::vector<eprosima::fastrtps::rtps::GUID_t> readers, writers;
};

/// What a participant with one node tells on `ros_discovery_info`.
rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_ discovery_info(
    const eprosima::fastrtps::rtps::GUID_t& participant, const NodeEntities& node);

/// User data of a participant with nodes, as rmw_fastrtps writes it, with its final zero.
std::string enclave_user_data();

}  // namespace controllers
