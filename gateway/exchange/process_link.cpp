#include "gateway/exchange/process_link.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "gateway/exchange/link_parts.h"
#include "hal/types/log.h"

namespace gateway::exchange {
namespace {

/// Period in which an unanswered Step is written again. RELIABLE delivers it the first time; this
/// is for a process that lost its place in the domain meanwhile, e.g. while a debugger had stopped
/// it.
constexpr hal::Duration kResendAfter = std::chrono::seconds{1};

/// Period in which a process on another host is checked for silence.
constexpr hal::Duration kCheckSilenceEvery = std::chrono::milliseconds{100};

}  // namespace

std::string step_topic(const std::string& process) { return "baraka/" + process + "/step"; }
std::string reply_topic(const std::string& process) { return "baraka/" + process + "/reply"; }

ProcessLink::Implementation::Implementation(domain::Participant& participant, LinkSettings settings)
    : settings_(std::move(settings)),
      watch_({settings_.hello.host, settings_.hello.pid, settings_.hello.pid_start_time}),
      steps_(participant, step_topic(settings_.hello.process)),
      replies_(participant, reply_topic(settings_.hello.process), signal_),
      resend_(kResendAfter) {}

hal::Result<void> ProcessLink::Implementation::begin(const hal::node::exchange::Step& step) {
  if (is_dead()) return death();
  at_ = step.events.empty() ? step.until : step.events.front().time;
  to_wire(step, step_);
  step_.server(settings_.server);
  step_.run(settings_.run);
  return write();
}

hal::Result<hal::node::exchange::Reply> ProcessLink::Implementation::finish() {
  const process::Deadline deadline(settings_.reply_timeout.value_or(hal::Duration::max()));
  while (true) {
    hal::Result<std::optional<hal::node::exchange::Reply>> reply = try_finish();
    if (!reply) return tl::unexpected(reply.error());
    if (*reply) return std::move(**reply);
    if (deadline.has_passed()) {
      return hal::fail(
          hal::Errc::kTimeout,
          fmt::format("process '{}' (pid {}) did not answer within {} s: --set reply_timeout=none "
                      "waits for ever, e.g. for a debugger",
                      name(), settings_.hello.pid, hal::to_seconds(*settings_.reply_timeout)));
    }
    wait(deadline);
  }
}

hal::Result<std::optional<hal::node::exchange::Reply>> ProcessLink::Implementation::try_finish() {
  signal_.lower();
  // The Reply first: a process may end immediately after its last one.
  if (auto reply = take_reply()) return reply;
  if (is_dead()) return death();
  if (resend_.has_passed()) {
    if (auto written = write(); !written) return tl::unexpected(written.error());
  }
  return std::nullopt;
}

void ProcessLink::Implementation::wait(const process::Deadline& deadline) const {
  const std::array awaited{signal_.descriptor(), watch_.descriptor()};
  const hal::Duration most = watch_.is_local() ? hal::Duration::max() : kCheckSilenceEvery;
  process::wait_readable(awaited, std::min({deadline.left(), resend_.left(), most}));
}

std::optional<hal::node::exchange::Reply> ProcessLink::Implementation::take_reply() {
  while (const wire::Reply* sample = replies_.take()) {
    // The process may serve other servers as well, and a Reply to a server that is gone may still
    // be kept.
    if (sample->server() != settings_.server) continue;
    if (!is_of_the_process(replies_.origin())) continue;
    if (!answers_step(*sample)) {
      // A second answer to a Step that was written twice is not an error.
      const bool is_echo = sample->run() == settings_.run &&
                           sample->sequence_number() + 1 == step_.sequence_number();
      dropped_.stale += is_echo ? 0 : 1;
      continue;
    }
    hal::Result<hal::node::exchange::Reply> reply = from_wire(*sample);
    if (!reply) {
      on_malformed(reply.error());
      continue;
    }
    return std::move(*reply);
  }
  return std::nullopt;
}

void ProcessLink::Implementation::on_malformed(const hal::Error& error) {
  if (++dropped_.malformed > 1) return;
  hal::log::warning(at_, "dds", "a reply of process '{}' (pid {}) on {} is dropped: {}", name(),
                    settings_.hello.pid, reply_topic(name()), error.message);
}

bool ProcessLink::Implementation::answers_step(const wire::Reply& reply) const {
  return reply.process() == settings_.hello.process && reply.run() == settings_.run &&
         reply.sequence_number() == step_.sequence_number();
}

bool ProcessLink::Implementation::is_of_the_process(const Origin& origin) {
  const hal::rtps::GuidPrefix participant = participant_of(origin);
  if (participant == settings_.participant) return true;
  if (++dropped_.foreign > 1) return false;
  dropped_.first_foreign = text_of(participant);
  hal::log::warning(
      at_, "dds",
      "participant {} answers for process '{}' (pid {}), which is participant {}: its "
      "replies are dropped",
      dropped_.first_foreign, name(), settings_.hello.pid, text_of(settings_.participant));
  return false;
}

hal::Result<void> ProcessLink::Implementation::write() {
  resend_ = process::Deadline(kResendAfter);
  if (steps_.write(step_)) return {};
  return hal::fail(hal::Errc::kNotConnected,
                   fmt::format("Fast DDS refuses a Step for process '{}'", name()));
}

hal::Result<void> ProcessLink::Implementation::check_alive() {
  if (is_dead()) return death();
  return {};
}

bool ProcessLink::Implementation::is_dead() const {
  return watch_.is_local() ? watch_.is_dead() : settings_.is_silent();
}

tl::unexpected<hal::Error> ProcessLink::Implementation::death() const {
  const std::string cause = watch_.is_local()
                                ? watch_.cause()
                                : fmt::format("on host {} is silent", settings_.hello.host);
  return hal::fail(hal::Errc::kNotConnected, fmt::format("process '{}' (pid {}) died: {}", name(),
                                                         settings_.hello.pid, cause));
}

ProcessLink::ProcessLink(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
ProcessLink::~ProcessLink() = default;

const std::string& ProcessLink::name() const { return implementation_->name(); }
hal::Result<void> ProcessLink::begin(const hal::node::exchange::Step& step) {
  return implementation_->begin(step);
}
hal::Result<hal::node::exchange::Reply> ProcessLink::finish() { return implementation_->finish(); }
hal::Result<std::optional<hal::node::exchange::Reply>> ProcessLink::try_finish() {
  return implementation_->try_finish();
}
std::vector<int> ProcessLink::descriptors() const { return implementation_->descriptors(); }
hal::Result<void> ProcessLink::check_alive() { return implementation_->check_alive(); }
const DroppedReplies& ProcessLink::dropped() const { return implementation_->dropped(); }
int ProcessLink::death_descriptor() const { return implementation_->death_descriptor(); }

}  // namespace gateway::exchange
