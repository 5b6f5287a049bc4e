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

// What travels in every exchange is written over `out`, in the memory that it has. After an error
// `out` is of no use, but may be written over again.

void to_wire(const exchange::Step& step, wire::Step& out);
Result<void> from_wire(const wire::Step& step, exchange::Step& out);

/// @param server  the one whose Step this answers.
void to_wire(const exchange::Reply& reply, const std::string& server, wire::Reply& out);
Result<exchange::Reply> from_wire(const wire::Reply& reply);

}  // namespace hal::dds
