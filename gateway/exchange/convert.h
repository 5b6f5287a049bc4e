#pragma once

#include <string>

#include "exchange.h"
#include "gateway/process/process_watch.h"
#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"
#include "hal/types/result.h"

namespace gateway::exchange {

namespace wire = ::baraka::exchange;

// The values of hal/node/exchange to what travels and back. Every value survives the way there and
// back bit by bit, NaN included; only strings end at an embedded zero byte, as in all of DDS.
// from_wire: errors: kProtocol (a value outside its enumeration; an event or action without what
// its kind needs), naming the event or action, its agent, and what it is. Numbers and texts that
// the kind of an event or action has no use for are ignored.

wire::Hello to_wire(const hal::node::exchange::Hello& hello);
hal::Result<hal::node::exchange::Hello> from_wire(const wire::Hello& hello);

/// @param server  the process that answers.
wire::Session to_wire(const hal::node::exchange::Session& session,
                      const process::ProcessIdentity& server);
hal::Result<hal::node::exchange::Session> from_wire(const wire::Session& session);
process::ProcessIdentity from_wire(const wire::ProcessIdentity& identity);

// What travels in every exchange is written over `out`, in the memory that it has. After an error
// `out` is of no use, but may be written over again.

void to_wire(const hal::node::exchange::Step& step, wire::Step& out);
hal::Result<void> from_wire(const wire::Step& step, hal::node::exchange::Step& out);

/// @param server  the one whose Step this answers.
void to_wire(const hal::node::exchange::Reply& reply, const std::string& server, wire::Reply& out);
hal::Result<hal::node::exchange::Reply> from_wire(const wire::Reply& reply);

}  // namespace gateway::exchange
