#pragma once

#include <string>

#include "exchange.h"
#include "hal/dds/process_watch.h"
#include "hal/exchange/session.h"
#include "hal/exchange/step.h"
#include "hal/types/result.h"

namespace hal::dds {

namespace wire = ::baraka::exchange;

// The values of hal/exchange to what travels and back. Every value survives the way there and back
// bit by bit, NaN included; only strings end at an embedded zero byte, as in all of DDS.
// from_wire: errors: kProtocol (a value outside its enumeration).

wire::Hello to_wire(const exchange::Hello& hello);
Result<exchange::Hello> from_wire(const wire::Hello& hello);

/// @param server  the process that answers.
wire::Session to_wire(const exchange::Session& session, const ProcessIdentity& server);
Result<exchange::Session> from_wire(const wire::Session& session);
ProcessIdentity from_wire(const wire::ProcessIdentity& identity);

wire::Step to_wire(const exchange::Step& step);
Result<exchange::Step> from_wire(const wire::Step& step);

/// @param server  the one whose Step this answers.
wire::Reply to_wire(const exchange::Reply& reply, const std::string& server);
Result<exchange::Reply> from_wire(const wire::Reply& reply);

}  // namespace hal::dds
