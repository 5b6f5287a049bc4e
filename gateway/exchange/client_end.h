#pragma once

#include <string>

#include "gateway/exchange/client.h"

namespace gateway::exchange {

/// What a Client consists of, for one kind of transport. The functions are those of Client.
class ClientEnd {
 public:
  ClientEnd() = default;
  virtual ~ClientEnd() = default;
  ClientEnd(const ClientEnd&) = delete;
  ClientEnd& operator=(const ClientEnd&) = delete;

  virtual const hal::node::exchange::Hello& hello() const = 0;
  virtual int servers() const = 0;
  virtual Arrival next(hal::Duration timeout) = 0;
  virtual void answer(const std::string& server, Client::Answerer answerer) = 0;
  virtual hal::Result<void> reply(const std::string& server,
                                  const hal::node::exchange::Reply& reply) = 0;
  virtual void withdraw() = 0;
  virtual void flush(hal::Duration timeout) = 0;
  virtual void interrupt() noexcept = 0;
};

}  // namespace gateway::exchange
