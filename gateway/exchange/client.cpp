#include "gateway/exchange/client.h"

#include <utility>

#include "gateway/exchange/dds_client.h"
#include "gateway/exchange/held_client.h"

namespace gateway::exchange {

Client::Client(int domain, hal::node::exchange::Hello hello) : end_(make_held_client(hello)) {
  if (!end_) end_ = make_dds_client(domain, std::move(hello));
}
Client::~Client() = default;

const hal::node::exchange::Hello& Client::hello() const { return end_->hello(); }
int Client::servers() const { return end_->servers(); }
Arrival Client::next(hal::Duration timeout) { return end_->next(timeout); }

hal::Result<void> Client::reply(const std::string& server,
                                const hal::node::exchange::Reply& reply) {
  return end_->reply(server, reply);
}

void Client::answer(const std::string& server, Answerer answerer) {
  end_->answer(server, std::move(answerer));
}

void Client::withdraw() { end_->withdraw(); }
void Client::flush(hal::Duration timeout) { end_->flush(timeout); }
void Client::interrupt() noexcept { end_->interrupt(); }

}  // namespace gateway::exchange
