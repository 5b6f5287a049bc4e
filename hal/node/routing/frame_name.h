#pragma once

#include <string_view>

#include "hal/node/routing/algorithm.h"
#include "hal/node/routing/packet.h"

namespace hal::node::routing {

/// Returns the protocol's name of one of its own control packets; "" for those of others.
using NameControl = std::string_view (*)(const Control& control);

/// The name of a frame of frame.h.
FrameName frame_name(std::span<const std::uint8_t> bytes, NameControl name_control);

/// For protocols without control packets.
inline std::string_view no_control(const Control&) { return {}; }

/// For protocols that do not choose routes by weights.
inline std::optional<double> no_weight(const RoutingConfig&, const Route&) { return std::nullopt; }

}  // namespace hal::node::routing
