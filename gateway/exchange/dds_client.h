#pragma once

#include <memory>

#include "gateway/exchange/client_end.h"

namespace gateway::exchange {

/// A client that exchanges over Fast DDS. @throws std::runtime_error  if DDS cannot be opened.
std::unique_ptr<ClientEnd> make_dds_client(int domain, hal::node::exchange::Hello hello);

}  // namespace gateway::exchange
