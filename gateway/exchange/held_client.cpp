#include "gateway/exchange/held_client.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "exchangePubSubTypes.h"
#include "gateway/exchange/convert.h"
#include "gateway/exchange/held_channel.h"
#include "gateway/exchange/wire_bytes.h"
#include "gateway/process/waiting.h"
#include "hal/types/log.h"

namespace gateway::exchange {

namespace {

using hal::node::exchange::Hello;
using hal::node::exchange::Reply;
using hal::node::exchange::Session;
using hal::node::exchange::Step;

}  // namespace

class HeldClient final : public ClientEnd {
 public:
  HeldClient(process::OwnedDescriptor socket, Hello hello)
      : hello_(std::move(hello)), channel_(std::move(socket), HeldChannel::Sends::kWaiting) {
    // The run knows who it is. Nothing here may differ from run to run, not even in length: it
    // would move what the program has in memory.
    hello_.instance = hello_.process;
    hello_.pid = getpid();
    wire::Hello sample = to_wire(hello_);
    send({HeldKind::kHello, wire_bytes<wire::HelloPubSubType>(sample)});
    if (channel_.is_closed()) throw std::runtime_error("the run that started this has ended");
  }

  const Hello& hello() const override { return hello_; }
  int servers() const override { return 1; }
  Arrival next(hal::Duration timeout) override;
  void answer(const std::string& server, Client::Answerer answerer) override;
  hal::Result<void> reply(const std::string& server, const Reply& reply) override;
  void withdraw() override {}
  void flush(hal::Duration timeout) override { (void)timeout; }
  void interrupt() noexcept override {
    is_interrupted_ = true;
    signal_.raise();
  }

 private:
  void send(const HeldMessage& message) {
    channel_.put(message);
    channel_.flush();
  }
  std::optional<Arrival> arrived();
  std::optional<Arrival> take_in(const HeldMessage& message);
  std::optional<Arrival> take_session(const HeldMessage& message);
  std::optional<Arrival> take_step(const HeldMessage& message);

  Hello hello_;
  process::Signal signal_;
  std::atomic<bool> is_interrupted_{false};
  HeldChannel channel_;
  std::optional<std::string> server_;  ///< Has granted agents.
  Client::Answerer answerer_;
};

Arrival HeldClient::next(hal::Duration timeout) {
  const process::Deadline deadline(timeout);
  while (true) {
    if (is_interrupted_) return Interrupted{};
    signal_.lower();
    if (auto arrival = arrived()) return std::move(*arrival);
    if (channel_.is_closed() && server_) return ServerGone{*std::exchange(server_, std::nullopt)};
    if (deadline.has_passed()) return Silence{};
    // A channel at its end is readable for ever.
    const std::array awaited{signal_.descriptor(),
                             channel_.is_closed() ? -1 : channel_.descriptor()};
    process::wait_readable(awaited, deadline.left());
    channel_.receive();
  }
}

std::optional<Arrival> HeldClient::arrived() {
  while (const auto message = channel_.take()) {
    if (auto arrival = take_in(*message)) return arrival;
  }
  return std::nullopt;
}

std::optional<Arrival> HeldClient::take_in(const HeldMessage& message) {
  switch (message.kind) {
    case HeldKind::kSession:
      return take_session(message);
    case HeldKind::kStep:
      return take_step(message);
    case HeldKind::kHello:
    case HeldKind::kReply:
      break;
  }
  return std::nullopt;
}

std::optional<Arrival> HeldClient::take_session(const HeldMessage& message) {
  wire::Session sample;
  if (!read_wire_bytes<wire::SessionPubSubType>(message.bytes, sample)) return std::nullopt;
  hal::Result<Session> session = from_wire(sample);
  if (!session) return std::nullopt;
  if (session->refusal.empty()) server_ = session->server;
  return Arrival(std::move(*session));
}

std::optional<Arrival> HeldClient::take_step(const HeldMessage& message) {
  wire::Step sample;
  Step step;
  if (!read_wire_bytes<wire::StepPubSubType>(message.bytes, sample)) return std::nullopt;
  if (const auto good = from_wire(sample, step); !good) {
    hal::log::warning(step.until, hello_.process, "Step {} is dropped: {}", step.sequence,
                      good.error().message);
    return std::nullopt;
  }
  if (!answerer_) return Arrival(std::move(step));
  if (answerer_(step)) return Arrival(Woken{});
  return std::nullopt;
}

/// All Steps come in next(), where the function is called.
void HeldClient::answer(const std::string& server, Client::Answerer answerer) {
  if (server == server_) answerer_ = std::move(answerer);
}

hal::Result<void> HeldClient::reply(const std::string& server, const Reply& reply) {
  wire::Reply sample;
  to_wire(reply, server, sample);
  sample.process(hello_.process);
  send({HeldKind::kReply, wire_bytes<wire::ReplyPubSubType>(sample)});
  if (!channel_.is_closed()) return {};
  return hal::fail(hal::Errc::kNotConnected, "the run has ended");
}

std::unique_ptr<ClientEnd> make_held_client(hal::node::exchange::Hello hello) {
  auto socket = take_held_end();
  if (!socket) return nullptr;
  return std::make_unique<HeldClient>(std::move(*socket), std::move(hello));
}

}  // namespace gateway::exchange
