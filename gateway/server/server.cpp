#include "gateway/server/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "gateway/exchange/server.h"
#include "gateway/process/waiting.h"
#include "gateway/server/admission.h"
#include "gateway/server/remote_port.h"
#include "gateway/server/session_log.h"
#include "hal/types/log.h"

namespace gateway::server {
namespace {

using hal::node::exchange::Hello;
using hal::node::exchange::Session;

/// Period in which gather() asks whether to go on.
constexpr hal::Duration kAskEvery = std::chrono::milliseconds{100};
/// Maximum number of refusals and processes in a summary: a daemon runs for months.
constexpr std::size_t kMostRemembered = 1000;

}  // namespace

class AgentServer::Implementation {
 public:
  Implementation(process::DomainHold hold, hal::node::exchange::AgentHost& host,
                 const ServerSettings& settings)
      : host_(host),
        settings_(settings),
        server_(std::move(hold)),
        admission_(host.offers(), settings.run,
                   settings.attendance == Attendance::kAnyTime ? Admission::Offered::kSome
                                                               : Admission::Offered::kAll) {}
  ~Implementation() {
    for (const Connected& one : connected_) one.port->disconnect();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  int domain() const { return server_.domain(); }
  domain::Invitation invite() { return server_.invite(); }
  exchange::HeldLink& expect(exchange::HeldTurns turns) {
    return *expected_.emplace_back(std::make_unique<exchange::HeldLink>(std::move(turns)));
  }
  hal::Result<void> gather(const std::function<hal::Result<void>()>& keep_waiting);
  void attend(hal::Time now);
  std::vector<int> descriptors() const;
  std::vector<hal::AgentId> missing() const { return admission_.free_agents(); }
  GatewaySummary summary() const;

 private:
  /// A process that was granted agents; kept until the run begins.
  struct Candidate {
    Hello hello;
    Session session;
    std::unique_ptr<exchange::ControllerLink> link;
  };

  void answer_hellos(hal::Duration timeout, hal::Time now);
  void answer(const Hello& hello, hal::Time now);
  void answer_held(hal::Time now);
  bool answer_held(std::unique_ptr<exchange::HeldLink>& link, hal::Time now);
  Session with_directory(Session session, const Hello& hello) const;
  void send(const Session& session, const Hello& hello, hal::Time now);
  void note_refusal(const Hello& hello, const std::string& reason, hal::Time now);
  void release_dead();
  void connect_all();
  void connect(Candidate candidate);
  void let_go_of_dead(hal::Time now);
  std::vector<int> death_descriptors() const;

  hal::node::exchange::AgentHost& host_;
  ServerSettings settings_;
  exchange::Server server_;
  Admission admission_;
  std::vector<std::unique_ptr<exchange::HeldLink>> expected_;
  std::map<std::string, Candidate> candidates_;  ///< By instance.
  /// A process whose agents are connected.
  struct Connected {
    std::string instance;
    std::vector<hal::AgentId> agents;
    std::shared_ptr<RemotePort> port;
  };
  std::vector<Connected> connected_;
  std::vector<ProcessSummary> past_;             ///< Summaries of processes that were disconnected.
  std::map<std::string, std::string> refusals_;  ///< The last one that was reported, by instance.
};

hal::Result<void> AgentServer::Implementation::gather(
    const std::function<hal::Result<void>()>& keep_waiting) {
  process::Deadline deadline(settings_.wait);
  std::size_t joined = 0;
  while (!admission_.is_complete()) {
    answer_hellos(std::min(deadline.left(), kAskEvery), hal::Time{});
    release_dead();
    if (admission_.is_complete()) break;
    if (auto allowed = keep_waiting(); !allowed) return allowed;
    // Many processes take long to start: as long as more of them join, the wait goes on.
    if (candidates_.size() > joined) deadline = process::Deadline(settings_.wait);
    joined = candidates_.size();
    if (!deadline.has_passed()) continue;
    return hal::fail(hal::Errc::kTimeout, fmt::format("no controller within {} s for {}",
                                                      hal::to_seconds(settings_.wait),
                                                      fmt::join(admission_.missing(), ", ")));
  }
  connect_all();
  return {};
}

void AgentServer::Implementation::attend(hal::Time now) {
  let_go_of_dead(now);
  answer_hellos(hal::Duration::zero(), now);
}

void AgentServer::Implementation::answer_hellos(hal::Duration timeout, hal::Time now) {
  answer_held(now);
  if (admission_.is_complete()) timeout = hal::Duration::zero();
  for (const Hello& hello : server_.hellos(timeout, death_descriptors())) answer(hello, now);
  for (const std::string& refusal : server_.take_refusals()) {
    log(hal::log::Level::kWarning, now, "refused " + refusal);
  }
}

/// The controllers in lock-step, one after the other.
void AgentServer::Implementation::answer_held(hal::Time now) {
  std::erase_if(expected_, [&](auto& link) { return answer_held(link, now); });
}

/// @return whether it has said Hello, and its link is used or of no use any more.
bool AgentServer::Implementation::answer_held(std::unique_ptr<exchange::HeldLink>& link,
                                              hal::Time now) {
  const auto hello = link->hello(process::Deadline(settings_.wait));
  if (!hello) return false;
  log_hello(*hello, now);
  const Session session = admission_.decide(*hello);
  if (!session.refusal.empty()) {
    note_refusal(*hello, session.refusal, now);
    link->refuse(session, process::Deadline(settings_.wait));
    return true;
  }
  link->admit(with_directory(session, *hello), settings_.run, settings_.reply_timeout);
  candidates_[hello->instance] = {*hello, session, std::move(link)};
  return true;
}

void AgentServer::Implementation::answer(const Hello& hello, hal::Time now) {
  log_hello(hello, now);
  if (admission_.is_for_others(hello)) return;
  const Session session = admission_.decide(hello);
  const bool is_known =
      candidates_.contains(hello.instance) ||
      std::ranges::find(connected_, hello.instance, &Connected::instance) != connected_.end();
  if (!session.refusal.empty()) {
    note_refusal(hello, session.refusal, now);
  } else if (!is_known) {
    Candidate candidate{hello, session,
                        server_.link(hello, settings_.run, settings_.reply_timeout)};
    if (settings_.attendance == Attendance::kAnyTime) {
      send(session, hello, now);
      return connect(std::move(candidate));
    }
    candidates_[hello.instance] = std::move(candidate);
  }
  send(session, hello, now);
}

/// The directory is added here, so that it is not kept for each process.
Session AgentServer::Implementation::with_directory(Session session, const Hello& hello) const {
  const bool is_granted = session.refusal.empty();
  if (is_granted && hello.wants.names) session.directory = host_.directory();
  return session;
}

void AgentServer::Implementation::send(const Session& session, const Hello& hello, hal::Time now) {
  if (auto sent = server_.answer(with_directory(session, hello)); !sent) {
    log(hal::log::Level::kWarning, now, sent.error().message);
  }
}

void AgentServer::Implementation::note_refusal(const Hello& hello, const std::string& reason,
                                               hal::Time now) {
  if (refusals_.size() >= kMostRemembered) refusals_.clear();
  if (std::exchange(refusals_[hello.instance], reason) == reason) return;
  log(hal::log::Level::kWarning, now,
      fmt::format("refused process '{}' (pid {}): {}", hello.process, hello.pid, reason));
}

void AgentServer::Implementation::release_dead() {
  std::erase_if(candidates_, [this](const auto& entry) {
    const auto alive = entry.second.link->check_alive();
    if (alive) return false;
    log(hal::log::Level::kWarning, hal::Time{},
        alive.error().message + "; its agents are free again");
    admission_.release(entry.first);
    return true;
  });
}

std::vector<int> AgentServer::Implementation::death_descriptors() const {
  std::vector<int> descriptors;
  for (const auto& [instance, candidate] : candidates_) {
    descriptors.push_back(candidate.link->death_descriptor());
  }
  return descriptors;
}

std::vector<int> AgentServer::Implementation::descriptors() const {
  std::vector<int> descriptors{server_.descriptor()};
  for (const Connected& one : connected_) descriptors.push_back(one.port->death_descriptor());
  return descriptors;
}

void AgentServer::Implementation::let_go_of_dead(hal::Time now) {
  std::erase_if(connected_, [&](const Connected& one) {
    const auto alive = one.port->check_alive();
    if (alive) return false;
    log(hal::log::Level::kWarning, now, alive.error().message + "; its agents are free again");
    host_.disconnect(one.agents);
    if (past_.size() < kMostRemembered) past_.push_back(one.port->summary());
    one.port->disconnect();
    admission_.release(one.instance);
    return true;
  });
}

void AgentServer::Implementation::connect_all() {
  admission_.close();
  std::vector<Candidate> candidates;
  for (auto& [instance, candidate] : candidates_) candidates.push_back(std::move(candidate));
  candidates_.clear();
  // Not in order of arrival: the run must not depend on which process came first.
  std::ranges::sort(candidates, {},
                    [](const Candidate& c) { return c.session.agents.front().agent; });
  for (Candidate& candidate : candidates) connect(std::move(candidate));
}

void AgentServer::Implementation::connect(Candidate candidate) {
  std::vector<hal::AgentId> agents;
  for (const auto& agent : candidate.session.agents) agents.push_back(agent.agent);
  // Late processes are refused between exchanges, on this thread, so no locks are needed, and no
  // process waits longer for its answer than one exchange takes.
  const bool is_closed = settings_.attendance == Attendance::kBeforeTheRun;
  log_session(candidate.hello, candidate.session);
  auto port = std::make_shared<RemotePort>(std::move(candidate.link), candidate.hello,
                                           candidate.session, [this, is_closed](hal::Time now) {
                                             if (is_closed && server_.has_hellos())
                                               answer_hellos(hal::Duration::zero(), now);
                                           });
  connected_.push_back({candidate.hello.instance, agents, port});
  host_.connect(std::move(port), agents, candidate.hello.wants);
}

GatewaySummary AgentServer::Implementation::summary() const {
  GatewaySummary summary;
  summary.processes = past_;
  for (const Connected& one : connected_) summary.processes.push_back(one.port->summary());
  return summary;
}

AgentServer::AgentServer(process::DomainHold hold, hal::node::exchange::AgentHost& host,
                         const ServerSettings& settings)
    : implementation_(std::make_unique<Implementation>(std::move(hold), host, settings)) {}
AgentServer::~AgentServer() = default;

int AgentServer::domain() const { return implementation_->domain(); }
domain::Invitation AgentServer::invite() { return implementation_->invite(); }
exchange::HeldLink& AgentServer::expect(exchange::HeldTurns turns) {
  return implementation_->expect(std::move(turns));
}

hal::Result<void> AgentServer::gather(const std::function<hal::Result<void>()>& keep_waiting) {
  return implementation_->gather(keep_waiting);
}

void AgentServer::attend(hal::Time now) { implementation_->attend(now); }
std::vector<int> AgentServer::descriptors() const { return implementation_->descriptors(); }

std::vector<hal::AgentId> AgentServer::missing() const { return implementation_->missing(); }

GatewaySummary AgentServer::summary() const { return implementation_->summary(); }

}  // namespace gateway::server
