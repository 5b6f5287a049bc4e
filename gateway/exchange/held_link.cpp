#include "gateway/exchange/held_link.h"

#include <fmt/core.h>

#include <csignal>

#include "exchangePubSubTypes.h"
#include "gateway/exchange/convert.h"
#include "gateway/exchange/wire_bytes.h"
#include "hal/types/log.h"

namespace gateway::exchange {
namespace {

using hal::node::exchange::Hello;
using hal::node::exchange::Reply;
using hal::node::exchange::Session;
using hal::node::exchange::Step;

/// Name of the server in Sessions and Steps. Equal in all runs: see HeldClient.
constexpr const char* kServer = "run";
/// Number that the first descriptor which a program inherits gets.
constexpr const char* kNumber = "3";

std::optional<Hello> read_hello(HeldChannel& channel) {
  const auto message = channel.take();
  wire::Hello sample;
  const bool is_one = message && message->kind == HeldKind::kHello &&
                      read_wire_bytes<wire::HelloPubSubType>(message->bytes, sample);
  if (!is_one) return std::nullopt;
  auto hello = exchange::from_wire(sample);
  if (!hello) return std::nullopt;
  return std::move(*hello);
}

}  // namespace

HeldLink::HeldLink(HeldTurns turns) : HeldLink(std::move(turns), make_held_ends()) {}

HeldLink::HeldLink(HeldTurns turns, HeldEnds ends)
    : turns_(std::move(turns)),
      controllers_end_(std::move(ends.controllers)),
      channel_(std::move(ends.own), HeldChannel::Sends::kAtOnce) {}

std::pair<std::string, std::string> HeldLink::variable() const { return {kHeldVariable, kNumber}; }

std::optional<Hello> HeldLink::hello(const process::Deadline& limit) {
  turns_.give([&limit] { return !limit.has_passed(); });
  channel_.receive();
  auto hello = read_hello(channel_);
  if (!hello) return std::nullopt;
  const process::ProcessIdentity identity{process::this_process().host, channel_.peer(),
                                          process::start_time_of(channel_.peer()).value_or(0)};
  hello->host = identity.host;
  hello->pid = identity.pid;
  hello->pid_start_time = identity.start_time;
  watch_.emplace(identity);
  hello_ = *hello;
  return hello;
}

void HeldLink::send(const Session& session) {
  Session named = session;
  named.server = kServer;
  wire::Session sample = to_wire(named, process::ProcessIdentity{});
  channel_.put({HeldKind::kSession, wire_bytes<wire::SessionPubSubType>(sample)});
}

void HeldLink::refuse(const Session& session, const process::Deadline& limit) {
  send(session);
  channel_.flush();
  turns_.give([&limit] { return !limit.has_passed(); });
}

void HeldLink::admit(const Session& session, std::uint64_t run,
                     std::optional<hal::Duration> reply_timeout) {
  run_ = run;
  reply_timeout_ = reply_timeout;
  send(session);
}

hal::Result<void> HeldLink::begin(const Step& step) {
  if (is_dead()) return death();
  at_ = step.events.empty() ? step.until : step.events.front().time;
  begun_ = turns_.now();
  sequence_ = step.sequence;
  wire::Step sample;
  to_wire(step, sample);
  sample.server(kServer);
  sample.run(run_);
  channel_.put({HeldKind::kStep, wire_bytes<wire::StepPubSubType>(sample)});
  return {};
}

hal::Result<Reply> HeldLink::finish() {
  auto reply = try_finish();
  if (!reply) return tl::unexpected(reply.error());
  if (!*reply) {
    return hal::fail(
        hal::Errc::kTimeout,
        fmt::format("process '{}' (pid {}) waits for simulated time", name(), hello_.pid));
  }
  return std::move(**reply);
}

/// What is larger than the socket's buffer goes there piece by piece, in both directions.
hal::Result<std::optional<Reply>> HeldLink::try_finish() {
  for (bool is_moving = true; is_moving;) {
    is_moving = channel_.flush();
    limit_.emplace(reply_timeout_.value_or(hal::Duration::max()));
    turns_.give([this] { return goes_on(); });
    is_moving = channel_.receive() || is_moving;
    if (auto reply = take_reply()) return reply;
  }
  if (is_late_) return silence(" while it computed");
  if (is_dead()) return death();
  if (reply_timeout_ && turns_.now() - begun_ >= *reply_timeout_)
    return silence(" of simulated time");
  return std::nullopt;
}

/// A process that computes for too long is killed: while it runs, simulated time stands.
bool HeldLink::goes_on() {
  if (is_late_ || !limit_->has_passed() || is_dead()) return true;
  is_late_ = true;
  kill(static_cast<pid_t>(hello_.pid), SIGKILL);
  return true;
}

std::optional<Reply> HeldLink::take_reply() {
  while (const auto message = channel_.take()) {
    wire::Reply sample;
    const bool is_one = message->kind == HeldKind::kReply &&
                        read_wire_bytes<wire::ReplyPubSubType>(message->bytes, sample);
    auto reply = is_one ? from_wire(sample) : hal::fail(hal::Errc::kProtocol, "it is none");
    if (!reply) {
      if (++dropped_.malformed == 1) {
        hal::log::warning(at_, "exchange", "a reply of process '{}' (pid {}) is dropped: {}",
                          name(), hello_.pid, reply.error().message);
      }
      continue;
    }
    if (reply->run == run_ && reply->sequence == sequence_) return std::move(*reply);
    ++dropped_.stale;
  }
  return std::nullopt;
}

hal::Result<void> HeldLink::check_alive() {
  if (is_dead()) return death();
  return {};
}

bool HeldLink::is_dead() const { return channel_.is_closed() || (watch_ && watch_->is_dead()); }

tl::unexpected<hal::Error> HeldLink::death() const {
  const bool has_ended = watch_ && watch_->is_dead();
  return hal::fail(hal::Errc::kNotConnected,
                   fmt::format("process '{}' (pid {}) died: {}", name(), hello_.pid,
                               has_ended ? watch_->cause() : "has closed its end of the exchange"));
}

tl::unexpected<hal::Error> HeldLink::silence(const char* of_time) const {
  const double seconds = reply_timeout_ ? hal::to_seconds(*reply_timeout_) : 0;
  return hal::fail(hal::Errc::kTimeout,
                   fmt::format("process '{}' (pid {}) did not answer within {} s{}: --set "
                               "reply_timeout=none waits for ever, as debugging needs",
                               name(), hello_.pid, seconds, of_time));
}

}  // namespace gateway::exchange
