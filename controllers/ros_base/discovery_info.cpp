#include "controllers/ros_base/discovery_info.h"

#include <algorithm>

namespace controllers {
namespace {

namespace rmw = rmw_dds_common::msg::dds_;
using eprosima::fastrtps::rtps::GUID_t;

std::vector<rmw::Gid_> gids_of(const std::vector<GUID_t>& guids) {
  std::vector<rmw::Gid_> gids;
  gids.reserve(guids.size());
  for (const GUID_t& guid : guids) gids.push_back(gid_of(guid));
  return gids;
}

}  // namespace

rmw::Gid_ gid_of(const GUID_t& guid) {
  rmw::Gid_ gid;
  gid.data().fill(0);
  const auto end = std::ranges::copy(guid.guidPrefix.value, gid.data().begin()).out;
  std::ranges::copy(guid.entityId.value, end);
  return gid;
}

rmw::ParticipantEntitiesInfo_ discovery_info(const GUID_t& participant, const NodeEntities& node) {
  rmw::NodeEntitiesInfo_ entities;
  entities.node_namespace("/" + node.name_space);
  entities.node_name(node.name);
  entities.reader_gid_seq(gids_of(node.readers));
  entities.writer_gid_seq(gids_of(node.writers));
  rmw::ParticipantEntitiesInfo_ info;
  info.gid(gid_of(participant));
  info.node_entities_info_seq({entities});
  return info;
}

std::string enclave_user_data() {
  using namespace std::string_literals;
  return "enclave=/;\0"s;
}

}  // namespace controllers
