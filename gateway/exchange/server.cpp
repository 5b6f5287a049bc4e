#include "gateway/exchange/server.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "gateway/exchange/link_parts.h"
#include "gateway/exchange/visitors.h"

namespace gateway::exchange {
namespace {

/// Maximum number of refusals kept for take_refusals().
constexpr std::size_t kMostRefusals = 100;

/// A number distinguishes the servers of this process; the process distinguishes them from all
/// others.
std::string unique_name(const process::ProcessIdentity& identity) {
  static std::atomic<int> next{1};
  return fmt::format("{}/{}/{}/{}", identity.host, identity.pid, identity.start_time, next++);
}

}  // namespace

class Server::Implementation {
 public:
  explicit Implementation(process::DomainHold hold)
      : hold_(std::move(hold)),
        identity_(process::this_process()),
        name_(unique_name(identity_)),
        participant_(domain::Participant::server(hold_.domain(), hold_.place())),
        hellos_(participant_, kHelloTopic, signal_),
        sessions_(participant_, kSessionTopic),
        visitors_(participant_.filter().trust()) {}

  std::vector<hal::node::exchange::Hello> take_hellos() {
    let_go();
    std::vector<hal::node::exchange::Hello> hellos;
    while (const wire::Hello* sample = hellos_.take()) {
      // A Hello that cannot be decoded cannot be refused by name either; its sender will time out.
      auto hello = from_wire(*sample);
      if (!hello) continue;
      name_as_here(*hello, hellos_.origin());
      if (is_heard(*hello, hellos_.origin())) hellos.push_back(std::move(*hello));
    }
    return hellos;
  }

  bool is_silent(const std::string& instance) {
    let_go();
    // On a busy machine, DDS has missed the end of a lease (3 of 120).
    if (const auto origin = visitors_.origin_of(instance)) {
      const auto silence = participant_.filter().silence_of(participant_of(*origin));
      if (silence && *silence > domain::kLivelinessLease) dispose(visitors_.fall_silent(*origin));
    }
    return visitors_.is_silent(instance);
  }

  hal::Result<void> answer(hal::node::exchange::Session session) {
    session.server = name_;
    wire::Session sample = to_wire(session, identity_);
    if (sessions_.write(sample)) return {};
    return hal::fail(hal::Errc::kNotConnected,
                     fmt::format("Fast DDS refuses a Session for {}", session.instance));
  }

  /// Sets the identity of a guest in this namespace, which the guest itself does not know.
  void name_as_here(hal::node::exchange::Hello& hello, const Origin& origin) {
    const auto sender = participant_.filter().sender_of(participant_of(origin));
    if (!sender) return;
    for (domain::Guest& guest : guests_) {
      const auto identity = guest.identity_of(hello.instance, *sender);
      if (!identity) continue;
      hello.host = identity->host;
      hello.pid = identity->pid;
      hello.pid_start_time = identity->start_time;
      return;
    }
  }

  /// Whether to pass on a Hello. A Hello with false claims is not answered: the answer would go to
  /// the process that it names.
  bool is_heard(const hal::node::exchange::Hello& hello, const Origin& origin) {
    const hal::rtps::GuidPrefix participant = participant_of(origin);
    const auto sender = participant_.filter().sender_of(participant);
    if (auto received = visitors_.receive(hello, origin, sender); !received) {
      note(hello,
           fmt::format("{} (participant {})", received.error().message, text_of(participant)));
      participant_.filter().ignore(participant);
      return false;
    }
    return true;
  }

  void note(const hal::node::exchange::Hello& hello, const std::string& reason) {
    if (refusals_.size() == kMostRefusals) return;
    refusals_.push_back(fmt::format("process '{}' (pid {}): {}", hello.process, hello.pid, reason));
  }

  /// Disposes of the Sessions of instances that are gone.
  void dispose(const std::vector<std::string>& instances) {
    for (const std::string& instance : instances) {
      wire::Session sample;
      sample.instance(instance);
      sample.server(name_);
      // There is none if the Hello was left to another server.
      [[maybe_unused]] const bool was_there = sessions_.dispose(sample);
    }
  }

  /// Disposes of the Sessions of processes that are gone.
  void let_go() {
    for (const Origin& origin : hellos_.presence().take_left()) dispose(visitors_.leave(origin));
    for (const Origin& origin : hellos_.presence().take_silent()) {
      dispose(visitors_.fall_silent(origin));
    }
  }

  process::DomainHold hold_;
  process::ProcessIdentity identity_;
  std::string name_;
  process::Signal signal_;
  domain::Participant participant_;
  Reader<wire::Hello> hellos_;
  Writer<wire::Session> sessions_;
  Visitors visitors_;
  std::vector<domain::Guest> guests_;
  std::vector<std::string> refusals_;  ///< Since the last take_refusals().
};

Server::Server(process::DomainHold hold)
    : implementation_(std::make_unique<Implementation>(std::move(hold))) {}
Server::~Server() = default;

int Server::domain() const { return implementation_->hold_.domain(); }
const std::string& Server::name() const { return implementation_->name_; }

std::vector<hal::node::exchange::Hello> Server::hellos(hal::Duration timeout,
                                                       const std::vector<int>& watched) {
  implementation_->signal_.lower();
  std::vector<hal::node::exchange::Hello> hellos = implementation_->take_hellos();
  if (!hellos.empty()) return hellos;
  std::vector<int> descriptors = watched;
  descriptors.push_back(implementation_->signal_.descriptor());
  process::wait_readable(descriptors, timeout);
  return implementation_->take_hellos();
}

int Server::descriptor() const { return implementation_->signal_.descriptor(); }

bool Server::has_hellos() const { return !implementation_->hellos_.is_empty(); }

hal::Result<void> Server::answer(hal::node::exchange::Session session) {
  return implementation_->answer(std::move(session));
}

std::vector<std::string> Server::take_refusals() {
  return std::exchange(implementation_->refusals_, {});
}

domain::Invitation Server::invite() {
  domain::Invited invited = domain::invite(implementation_->participant_.port());
  implementation_->guests_.push_back(std::move(invited.guest));
  return std::move(invited.invitation);
}

std::unique_ptr<ProcessLink> Server::link(const hal::node::exchange::Hello& hello,
                                          std::uint64_t run,
                                          std::optional<hal::Duration> reply_timeout) {
  const auto is_silent = [parts = implementation_.get(), instance = hello.instance] {
    return parts->is_silent(instance);
  };
  const Origin origin = implementation_->visitors_.origin_of(hello.instance).value_or(Origin());
  LinkSettings settings{implementation_->name_, hello,    participant_of(origin), run,
                        reply_timeout,          is_silent};
  auto parts = std::make_unique<ProcessLink::Implementation>(implementation_->participant_,
                                                             std::move(settings));
  return std::unique_ptr<ProcessLink>(new ProcessLink(std::move(parts)));
}

}  // namespace gateway::exchange
