#include "gateway/exchange/dds_client.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "gateway/exchange/link_parts.h"
#include "gateway/guard/socket_table.h"
#include "gateway/guard/speaker_check.h"
#include "hal/types/log.h"

namespace gateway::exchange {
namespace {

hal::node::exchange::Hello completed(hal::node::exchange::Hello hello) {
  static std::atomic<int> next{1};
  const process::ProcessIdentity identity = process::this_process();
  hello.host = identity.host;
  hello.pid = identity.pid;
  hello.pid_start_time = identity.start_time;
  hello.instance =
      fmt::format("{}/{}/{}/{}", identity.host, identity.pid, identity.start_time, next++);
  return hello;
}

std::set<std::string> names_in(const hal::node::exchange::Session& session) {
  std::set<std::string> names;
  for (const hal::node::exchange::AgentSession& agent : session.agents) names.insert(agent.name);
  return names;
}

}  // namespace

class DdsClient final : public ClientEnd {
 public:
  DdsClient(int domain, hal::node::exchange::Hello hello)
      : hello_(completed(std::move(hello))),
        handed_(guard::take_handed_sockets()),
        participant_(domain::Participant::controller(domain, handed_ ? &*handed_ : nullptr)),
        sessions_(participant_, kSessionTopic, signal_),
        hellos_(participant_, kHelloTopic) {
    if (handed_) handed_->announce(hello_.instance);
    wire::Hello sample = to_wire(hello_);
    if (!hellos_.write(sample)) throw std::runtime_error("Fast DDS refuses a Hello");
  }

  const hal::node::exchange::Hello& hello() const override { return hello_; }
  int servers() const override { return sessions_.presence().writers(); }
  Arrival next(hal::Duration timeout) override;
  hal::Result<void> reply(const std::string& server,
                          const hal::node::exchange::Reply& reply) override;
  void answer(const std::string& server, Client::Answerer answerer) override;
  void withdraw() override;
  void flush(hal::Duration timeout) override {
    if (replies_) replies_->flush(timeout);
  }
  void interrupt() noexcept override {
    interrupted_ = true;
    signal_.raise();
  }

 private:
  hal::node::exchange::Hello hello_;
  process::Signal signal_;
  std::atomic<bool> interrupted_{false};
  std::atomic<bool> woken_{false};
  std::optional<guard::HandedSockets> handed_;
  domain::Participant participant_;
  Reader<wire::Session> sessions_;
  Writer<wire::Hello> hellos_;
  std::optional<Writer<wire::Reply>> replies_;

  /// A server that has granted agents.
  struct Granted {
    std::uint64_t run = 0;
    Origin origin;
    std::set<std::string> agents;  ///< Names of the agents.
    std::unique_ptr<process::ProcessWatch> watch;
    bool gone = false;
    Client::Answerer answerer{};
  };

  std::optional<Arrival> arrived();
  std::optional<hal::node::exchange::Session> take_session();
  std::optional<hal::node::exchange::Step> take_step();
  std::unique_ptr<process::ProcessWatch> watch_of(const wire::Session& session) const;
  bool is_good(const hal::node::exchange::Session& session, const process::ProcessIdentity& server);
  bool is_of_rival(const hal::node::exchange::Session& session) const;
  bool speaks(const Granted& server) const;
  void take_in(const wire::Step& sample, const Origin& origin);
  void complain(const std::string& what, const Origin& origin);
  void hand_over(const Client::Answerer& answerer, const hal::node::exchange::Step& step);
  std::optional<ServerGone> take_departure();
  void forget_reply_to(const std::string& server);
  bool is_gone(const Granted& server, const std::vector<Origin>& left,
               const std::vector<Origin>& silent) const;
  bool wait(hal::Duration timeout);

  /// Guards what the thread that receives Steps reads. That thread holds locks of DDS when it takes
  /// this mutex, so no function of DDS is called with it except to write Replies.
  std::mutex mutex_;
  std::map<std::string, Granted> granted_;         ///< Changed only by the thread of next().
  std::deque<hal::node::exchange::Step> waiting_;  ///< Steps for next().
  hal::node::exchange::Step step_;                 ///< The latest Step; its memory is reused.
  /// Guards the latest Reply, whose memory is reused.
  std::mutex reply_mutex_;
  wire::Reply reply_;
  std::mutex strangers_mutex_;
  std::set<hal::rtps::GuidPrefix> strangers_;  ///< Participants that were complained about.
  std::optional<HandlingReader<wire::Step>> steps_;
};

Arrival DdsClient::next(hal::Duration timeout) {
  const process::Deadline deadline(timeout);
  while (true) {
    if (interrupted_) return Interrupted{};
    signal_.lower();
    if (auto arrival = arrived()) return std::move(*arrival);
    if (woken_.exchange(false)) return Woken{};
    if (deadline.has_passed()) return Silence{};
    wait(deadline.left());
  }
}

std::optional<Arrival> DdsClient::arrived() {
  if (auto session = take_session()) return Arrival(std::move(*session));
  if (auto step = take_step()) return Arrival(std::move(*step));
  if (auto departure = take_departure()) return Arrival(std::move(*departure));
  return std::nullopt;
}

bool DdsClient::wait(hal::Duration timeout) {
  std::vector<int> descriptors{signal_.descriptor()};
  for (const auto& [name, server] : granted_) descriptors.push_back(server.watch->descriptor());
  return process::wait_readable(descriptors, timeout);
}

std::optional<hal::node::exchange::Session> DdsClient::take_session() {
  while (const wire::Session* sample = sessions_.take()) {
    if (sample->instance() != hello_.instance) continue;
    hal::Result<hal::node::exchange::Session> session = from_wire(*sample);
    if (!session || !is_good(*session, from_wire(sample->identity()))) continue;
    if (!session->refusal.empty()) return std::move(*session);
    const auto known = granted_.find(session->server);
    if (known != granted_.end() && known->second.run == session->run) continue;  // sent twice
    // Not earlier: until a server has granted agents, another process may use these topics.
    if (!replies_) replies_.emplace(participant_, reply_topic(hello_.process));
    auto watch = watch_of(*sample);
    {
      const std::lock_guard lock(mutex_);
      granted_[session->server] = {session->run, sessions_.origin(), names_in(*session),
                                   std::move(watch)};
    }
    if (!steps_) {
      steps_.emplace(
          participant_, step_topic(hello_.process),
          [this](const wire::Step& step, const Origin& origin) { take_in(step, origin); });
    }
    return std::move(*session);
  }
  return std::nullopt;
}

/// A watch of the server's process. A guest does not know the server's pid.
std::unique_ptr<process::ProcessWatch> DdsClient::watch_of(const wire::Session& session) const {
  if (handed_) return std::make_unique<process::ProcessWatch>(handed_->channel.number());
  return std::make_unique<process::ProcessWatch>(from_wire(session.identity()));
}

std::optional<hal::node::exchange::Step> DdsClient::take_step() {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return std::nullopt;
  std::optional<hal::node::exchange::Step> step(std::move(waiting_.front()));
  waiting_.pop_front();
  return step;
}

/// Whether a Session comes from the server that it names, as far as this can be checked.
bool DdsClient::is_good(const hal::node::exchange::Session& session,
                        const process::ProcessIdentity& server) {
  const Origin& origin = sessions_.origin();
  const auto known = granted_.find(session.server);
  if (known != granted_.end() && known->second.origin != origin) {
    complain("sends a Session of another server", origin);
    return false;
  }
  const auto sender = participant_.filter().sender_of(participant_of(origin));
  const auto checked = guard::check_speaker(server, sender, participant_.filter().trust());
  if (!checked) {
    complain("sends a Session: " + checked.error().message, origin);
    return false;
  }
  if (!is_of_rival(session)) return true;
  complain("sends a Session for agents of another server", origin);
  return false;
}

/// Whether another server, which is still present, has granted one of the Session's agents.
/// Different agents may have different servers.
bool DdsClient::is_of_rival(const hal::node::exchange::Session& session) const {
  const std::set<std::string> names = names_in(session);
  return std::ranges::any_of(granted_, [&](const auto& entry) {
    const Granted& server = entry.second;
    // A server that ended and was started again in the same process is the same participant.
    return participant_of(server.origin) != participant_of(sessions_.origin()) &&
           std::ranges::any_of(names, [&](const auto& n) { return server.agents.contains(n); }) &&
           speaks(server);
  });
}

/// Whether a server still owns the port from which it was heard. A killed server does not, which is
/// known here earlier than by other means.
bool DdsClient::speaks(const Granted& server) const {
  if (server.gone || server.watch->is_dead()) return false;
  const auto sender = participant_.filter().sender_of(participant_of(server.origin));
  const auto sockets = sender ? guard::sockets_behind(*sender) : std::nullopt;
  return sockets && !sockets->empty();
}

/// Reports each participant only once.
void DdsClient::complain(const std::string& what, const Origin& origin) {
  constexpr std::size_t kMost = 100;
  const hal::rtps::GuidPrefix participant = participant_of(origin);
  const std::lock_guard lock(strangers_mutex_);
  if (strangers_.size() == kMost || !strangers_.insert(participant).second) return;
  hal::log::warning(hal::Time{}, hello_.process, "participant {} {}; it is not listened to",
                    text_of(participant), what);
}

void DdsClient::take_in(const wire::Step& sample, const Origin& origin) {
  const std::lock_guard lock(mutex_);
  const auto server = granted_.find(sample.server());
  if (server == granted_.end() || server->second.run != sample.run()) return;
  if (participant_of(origin) != participant_of(server->second.origin)) {
    return complain("sends a Step of another server", origin);
  }
  if (const auto good = from_wire(sample, step_); !good) {
    hal::log::warning(step_.until, hello_.process, "Step {} of server '{}' on {} is dropped: {}",
                      step_.sequence, sample.server(), step_topic(hello_.process),
                      good.error().message);
    return;
  }
  if (server->second.answerer) return hand_over(server->second.answerer, step_);
  // As in DDS itself, the oldest Steps are dropped if next() cannot keep up.
  if (waiting_.size() == domain::kMaxInstances) waiting_.pop_front();
  waiting_.push_back(step_);
  signal_.raise();
}

void DdsClient::hand_over(const Client::Answerer& answerer, const hal::node::exchange::Step& step) {
  if (!answerer(step)) return;
  woken_ = true;
  signal_.raise();
}

void DdsClient::answer(const std::string& server, Client::Answerer answerer) {
  const std::lock_guard lock(mutex_);
  const auto granted = granted_.find(server);
  if (granted == granted_.end()) return;
  granted->second.answerer = std::move(answerer);
  if (!granted->second.answerer) return;
  const auto is_its = [&](const hal::node::exchange::Step& step) { return step.server == server; };
  for (const hal::node::exchange::Step& step : waiting_) {
    if (is_its(step)) hand_over(granted->second.answerer, step);
  }
  std::erase_if(waiting_, is_its);
}

std::optional<ServerGone> DdsClient::take_departure() {
  const std::vector<Origin> left = sessions_.presence().take_left();
  const std::vector<Origin> silent = sessions_.presence().take_silent();
  for (auto& [name, server] : granted_) server.gone = server.gone || is_gone(server, left, silent);
  const auto first =
      std::ranges::find_if(granted_, [](const auto& entry) { return entry.second.gone; });
  if (first == granted_.end()) return std::nullopt;
  ServerGone departure{first->first};
  forget_reply_to(departure.server);
  const std::lock_guard lock(mutex_);
  granted_.erase(first);
  return departure;
}

/// Disposes of the last Reply to a server that is gone; nobody needs it.
void DdsClient::forget_reply_to(const std::string& server) {
  if (!replies_) return;
  wire::Reply key;
  key.server(server);
  // It does not exist if no Step came.
  [[maybe_unused]] const bool was_there = replies_->dispose(key);
}

bool DdsClient::is_gone(const Granted& server, const std::vector<Origin>& left,
                        const std::vector<Origin>& silent) const {
  if (server.watch->is_dead()) return true;
  if (std::ranges::find(left, server.origin) != left.end()) return true;
  return !server.watch->is_local() && std::ranges::find(silent, server.origin) != silent.end();
}

hal::Result<void> DdsClient::reply(const std::string& server,
                                   const hal::node::exchange::Reply& reply) {
  const std::lock_guard lock(reply_mutex_);
  to_wire(reply, server, reply_);
  reply_.process(hello_.process);
  if (replies_ && replies_->write(reply_)) return {};
  return hal::fail(hal::Errc::kNotConnected, "Fast DDS refuses a Reply");
}

void DdsClient::withdraw() {
  wire::Hello sample = to_wire(hello_);
  // The process ends in any case.
  [[maybe_unused]] const bool is_disposed = hellos_.dispose(sample);
}

std::unique_ptr<ClientEnd> make_dds_client(int domain, hal::node::exchange::Hello hello) {
  return std::make_unique<DdsClient>(domain, std::move(hello));
}

}  // namespace gateway::exchange
