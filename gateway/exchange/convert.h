#pragma once

#include <string>

#include "exchange.h"
#include "gateway/process/process_watch.h"
#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"
#include "hal/types/result.h"

namespace gateway::exchange {

namespace wire = ::baraka::exchange;

// Conversion between the values of hal/node/exchange and the samples of DDS. Every value is
// preserved bit by bit in both directions, including NaN; only strings end at an embedded zero
// byte, as always in DDS. from_wire: errors: kProtocol (a value outside its enumeration; an event
// or action without a part that its kind needs), with the event or action and its agent. Numbers
// and texts that the kind of an event or action does not use are ignored.

wire::Hello to_wire(const hal::node::exchange::Hello& hello);
hal::Result<hal::node::exchange::Hello> from_wire(const wire::Hello& hello);

/// @param server  the process that answers.
wire::Session to_wire(const hal::node::exchange::Session& session,
                      const process::ProcessIdentity& server);
hal::Result<hal::node::exchange::Session> from_wire(const wire::Session& session);
process::ProcessIdentity from_wire(const wire::ProcessIdentity& identity);

// These overloads, for what is sent in every exchange, reuse the memory of `out`. After an error
// the content of `out` is unspecified, but it can be used again.

void to_wire(const hal::node::exchange::Step& step, wire::Step& out);
hal::Result<void> from_wire(const wire::Step& step, hal::node::exchange::Step& out);

/// @param server  the server whose Step this answers.
void to_wire(const hal::node::exchange::Reply& reply, const std::string& server, wire::Reply& out);
hal::Result<hal::node::exchange::Reply> from_wire(const wire::Reply& reply);

}  // namespace gateway::exchange
