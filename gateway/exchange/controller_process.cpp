#include "gateway/exchange/controller_process.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "gateway/guard/trust.h"
#include "gateway/process/domains.h"
#include "gateway/runtime/exit_watch.h"
#include "gateway/runtime/fault_watch.h"
#include "hal/types/log.h"
#include "hal/types/printable.h"

namespace gateway::exchange {
namespace {

/// Maximum time for the last Reply to reach the server before the process ends.
constexpr hal::Duration kFlushTimeout = std::chrono::seconds{2};
/// The same if the waiting thread is the one that would receive the acknowledgement.
constexpr hal::Duration kLinger = std::chrono::milliseconds{300};

/// "; user 997 serves it, …" if another user than this one holds a place of the domain.
std::string hint_of_users(int domain) {
  for (const uid_t user : process::users_in(domain)) {
    if (user == geteuid()) continue;
    return fmt::format(
        "; user {} serves it, this is user {}: they hear each other if {} of each "
        "names the other",
        user, geteuid(), guard::kTrustVariable);
  }
  return {};
}

/// The task that one server has given to this process.
struct Assignment {
  std::unique_ptr<runtime::ControllerHost> host;  ///< Null: it could not be created.
  std::string failure;                            ///< Why it could not be created.
  std::set<hal::AgentId> running;                 ///< Agents that have not been stopped.
  std::uint64_t sequence = 0;                     ///< Number of the last Step that was answered.
  hal::node::exchange::Reply reply;               ///< The answer to it.
};

///  waiting ──Session──▶ running ──STOP for every agent──▶ done, or waiting again with --stay
///     │ refused by all,     │ server gone
///     ▼ nobody answers      ▼
///   ends                  ends, or waiting again with --stay
class ControllerProcess {
 public:
  ControllerProcess(const hal::ControllerKind& kind, const runtime::ControllerOptions& options,
                    Client& client)
      : kind_(kind), options_(options), client_(client), patience_(options.wait) {}

  ~ControllerProcess() {
    for (const auto& [server, assignment] : assignments_) client_.answer(server, {});
  }
  ControllerProcess(const ControllerProcess&) = delete;
  ControllerProcess& operator=(const ControllerProcess&) = delete;

  Outcome run() {
    while (!outcome()) {
      std::visit([this](auto&& arrival) { on(arrival); }, client_.next(patience_));
    }
    client_.withdraw();
    client_.flush(kFlushTimeout);
    return *outcome();
  }

 private:
  void on(const hal::node::exchange::Session& session);
  bool answer(const hal::node::exchange::Step& step);
  void work_off(const hal::node::exchange::Step& step);
  void on(const hal::node::exchange::Step& step) { answer(step); }
  void on(const ServerGone& departure);
  void on(const Silence& silence);
  void on(const Woken& woken) { (void)woken; }
  void on(const Interrupted& interrupted);

  void accept(const hal::node::exchange::Session& session);
  void refused(const hal::node::exchange::Session& session);
  hal::node::exchange::Reply reply_to(const hal::node::exchange::Step& step,
                                      Assignment& assignment);
  void end_of_run();
  void end(Outcome outcome);
  std::optional<Outcome> outcome();
  bool is_running() const;
  int on_exit_called(const runtime::ExitCall& call);

  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) const {
    fmt::print(stderr, "{}: {}\n", hal::printable(client_.hello().process),
               hal::printable_lines(fmt::format(format, std::forward<Args>(args)...)));
  }
  template <class... Args>
  void say_for_debugging(fmt::format_string<Args...> format, Args&&... args) const {
    if (hal::log::is_on(hal::log::Level::kDebug)) say(format, std::forward<Args>(args)...);
  }

  const hal::ControllerKind& kind_;
  const runtime::ControllerOptions& options_;
  Client& client_;
  hal::Duration patience_;
  std::set<std::string> refusers_;

  /// Guards the members below: Steps are answered on the thread that receives them.
  std::mutex mutex_;
  std::map<std::string, Assignment> assignments_;  ///< By server.
  std::optional<Outcome> outcome_;
  /// The Step that controllers are handling; null: none.
  const hal::node::exchange::Step* step_ = nullptr;
  runtime::ControllerHost* host_ = nullptr;  ///< The host of these controllers.

  const runtime::ExitWatch exit_watch_{
      [this](const runtime::ExitCall& call) { return on_exit_called(call); }};
  const runtime::FaultWatch fault_watch_{client_.hello().process};
};

std::optional<Outcome> ControllerProcess::outcome() {
  const std::lock_guard lock(mutex_);
  return outcome_;
}

void ControllerProcess::end(Outcome outcome) {
  const std::lock_guard lock(mutex_);
  outcome_ = outcome;
}

bool ControllerProcess::is_running() const {
  return std::ranges::any_of(assignments_,
                             [](const auto& entry) { return !entry.second.running.empty(); });
}

void ControllerProcess::on(const hal::node::exchange::Session& session) {
  if (session.refusal.empty() && session.version == hal::node::exchange::kProtocolVersion) {
    accept(session);
  } else {
    refused(session);
  }
}

void ControllerProcess::accept(const hal::node::exchange::Session& session) {
  Assignment assignment;
  std::vector<std::string> names;
  for (const hal::node::exchange::AgentSession& agent : session.agents) {
    assignment.running.insert(agent.agent);
    names.push_back(agent.name);
  }
  say_for_debugging("session with server '{}', run {}: {}", session.server, session.run,
                    fmt::join(names, ", "));
  auto host = runtime::ControllerHost::create(kind_, session);
  if (host) {
    assignment.host = std::move(*host);
  } else {
    assignment.failure = host.error().message;
    say("{}", assignment.failure);
  }
  {
    const std::lock_guard lock(mutex_);
    assignments_[session.server] = std::move(assignment);
  }
  patience_ = hal::Duration::max();
  client_.answer(session.server,
                 [this](const hal::node::exchange::Step& step) { return answer(step); });
}

void ControllerProcess::refused(const hal::node::exchange::Session& session) {
  const std::string reason =
      session.refusal.empty() ? fmt::format("the server speaks protocol version {}, this is {}",
                                            session.version, hal::node::exchange::kProtocolVersion)
                              : session.refusal;
  say("refused: {}", reason);
  refusers_.insert(session.server);
  // Another server of the domain may still have the agents: wait for it, but not without limit.
  const bool by_all = static_cast<int>(refusers_.size()) >= client_.servers();
  const std::lock_guard lock(mutex_);
  if (by_all && !options_.stay && !is_running()) outcome_ = Outcome::kRefused;
}

/// Called on the thread that receives Steps.
bool ControllerProcess::answer(const hal::node::exchange::Step& step) {
  thread_local const runtime::SignalStack stack;
  const std::lock_guard lock(mutex_);
  work_off(step);
  return outcome_.has_value();
}

void ControllerProcess::work_off(const hal::node::exchange::Step& step) {
  const auto found = assignments_.find(step.server);
  if (found == assignments_.end()) return;
  Assignment& assignment = found->second;
  if (step.sequence < assignment.sequence) return;  // delivered late; its answer was received
  if (step.sequence > assignment.sequence + 1) {
    say("Step {} came after Step {}: events are lost", step.sequence, assignment.sequence);
    outcome_ = Outcome::kFailed;
    return;
  }
  if (step.sequence > assignment.sequence) assignment.reply = reply_to(step, assignment);
  assignment.sequence = step.sequence;
  say_for_debugging("Step {}: {} events until {:.9f} s, {} actions", step.sequence,
                    step.events.size(), hal::to_seconds(step.until),
                    assignment.reply.actions.size());
  const auto sent = client_.reply(step.server, assignment.reply);
  if (!sent) say("{}", sent.error().message);
  if (!assignment.host) outcome_ = Outcome::kRefused;
  if (!is_running()) end_of_run();
}

hal::node::exchange::Reply ControllerProcess::reply_to(const hal::node::exchange::Step& step,
                                                       Assignment& assignment) {
  for (const hal::node::exchange::Event& event : step.events) {
    if (event.cause() == hal::node::exchange::Cause::kStop) assignment.running.erase(event.agent);
  }
  hal::node::exchange::Reply reply;
  if (assignment.host) {
    step_ = &step;
    host_ = assignment.host.get();
    reply = host_->answer(step);
    step_ = nullptr;
  } else if (!step.events.empty()) {
    reply.actions.push_back(
        {step.events.front().agent, 0, hal::node::exchange::ControllerFailed{assignment.failure}});
  }
  reply.run = step.run;
  reply.sequence = step.sequence;
  return reply;
}

/// Runs within exit(), with all locks that its thread holds; in a callback these are the locks of
/// answer() and of the client. The answer is sent on this thread, which therefore cannot wait for
/// its acknowledgement.
int ControllerProcess::on_exit_called(const runtime::ExitCall& call) {
  say("{}", call.text());
  if (step_ != nullptr) {
    const auto sent = client_.reply(step_->server, host_->broken_off(*step_, "it " + call.what()));
    if (sent) std::this_thread::sleep_for(kLinger);
  }
  return static_cast<int>(Outcome::kFailed);
}

void ControllerProcess::on(const ServerGone& departure) {
  const std::lock_guard lock(mutex_);
  const auto found = assignments_.find(departure.server);
  if (found == assignments_.end()) return;
  const bool was_running = !found->second.running.empty();
  assignments_.erase(found);
  if (!was_running) return;
  say("the server is gone in the middle of a run");
  if (!options_.stay) outcome_ = Outcome::kFailed;
}

void ControllerProcess::on(const Silence& silence) {
  (void)silence;
  const int domain = options_.domain.value_or(0);
  say("no server in DDS domain {} has agents for it after {} s{}", domain,
      hal::to_seconds(options_.wait), hint_of_users(domain));
  end(refusers_.empty() ? Outcome::kFailed : Outcome::kRefused);
}

void ControllerProcess::on(const Interrupted& interrupted) {
  (void)interrupted;
  end(Outcome::kInterrupted);
}

void ControllerProcess::end_of_run() {
  if (!outcome_ && !options_.stay) outcome_ = Outcome::kDone;
}

std::atomic<Client*> interrupted_client{nullptr};

void interrupt_client(int signal) {
  (void)signal;
  if (Client* client = interrupted_client) client->interrupt();
}

/// While this object exists, SIGINT and SIGTERM interrupt a client; the second signal kills the
/// process.
class Interruptible {
 public:
  explicit Interruptible(Client& client) {
    interrupted_client = &client;
    struct sigaction action {};
    action.sa_handler = interrupt_client;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigaction(SIGINT, &action, &interrupt_);
    sigaction(SIGTERM, &action, &terminate_);
  }
  ~Interruptible() {
    sigaction(SIGINT, &interrupt_, nullptr);
    sigaction(SIGTERM, &terminate_, nullptr);
    interrupted_client = nullptr;
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  struct sigaction interrupt_ {};
  struct sigaction terminate_ {};
};

}  // namespace

hal::node::exchange::Hello hello_of(const hal::ControllerKind& kind,
                                    const runtime::ControllerOptions& options) {
  hal::node::exchange::Hello hello;
  hello.process = options.name.empty() ? fmt::format("{}.{}", kind.name, getpid()) : options.name;
  hello.program = kind.name;
  hello.patterns = options.agents;
  hello.kind = kind.make_for_robot != nullptr ? hal::AgentKind::kRobot : hal::AgentKind::kMote;
  hello.both_kinds = kind.make_for_robot != nullptr && kind.make_for_mote != nullptr;
  hello.wants = kind.wants;
  return hello;
}

Outcome run_controllers(const hal::ControllerKind& kind, const runtime::ControllerOptions& options,
                        Client& client) {
  return ControllerProcess(kind, options, client).run();
}

Outcome run_controllers(const hal::ControllerKind& kind,
                        const runtime::ControllerOptions& options) {
  runtime::ControllerOptions resolved = options;
  resolved.domain = options.domain ? *options.domain : process::default_domain();
  hal::log::set_level(options.level);
  Client client(*resolved.domain, hello_of(kind, resolved));
  const Interruptible interruptible(client);
  return run_controllers(kind, resolved, client);
}

}  // namespace gateway::exchange
