#pragma once

#include "programs/netns/namespaces.h"
#include "programs/netns/packed.h"

namespace programs::netns {

/// An agent's network in a message of message.h.
void pack(Packer& out, const AgentNetwork& agent);
/// @throws std::runtime_error  there are not enough bytes.
AgentNetwork unpacked_agent(Unpacker& in);

}  // namespace programs::netns
