#include "hal/dds/client.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "hal/dds/link_parts.h"

namespace hal::dds {
namespace {

exchange::Hello completed(exchange::Hello hello) {
  static std::atomic<int> next{1};
  const ProcessIdentity identity = this_process();
  hello.host = identity.host;
  hello.pid = identity.pid;
  hello.pid_start_time = identity.start_time;
  hello.instance =
      fmt::format("{}/{}/{}/{}", identity.host, identity.pid, identity.start_time, next++);
  return hello;
}

}  // namespace

class Client::Implementation {
 public:
  Implementation(int domain, exchange::Hello hello)
      : hello_(completed(std::move(hello))),
        participant_(Participant::controller(domain)),
        sessions_(participant_, kSessionTopic, signal_),
        hellos_(participant_, kHelloTopic) {
    wire::Hello sample = to_wire(hello_);
    if (!hellos_.write(sample)) throw std::runtime_error("Fast DDS refuses a Hello");
  }

  Arrival next(Duration timeout);
  Result<void> reply(const std::string& server, exchange::Reply reply);

  exchange::Hello hello_;
  Signal signal_;
  std::atomic<bool> interrupted_{false};
  Participant participant_;
  Reader<wire::Session> sessions_;
  Writer<wire::Hello> hellos_;
  std::optional<Writer<wire::Reply>> replies_;

 private:
  /// A server that granted agents.
  struct Granted {
    std::uint64_t run = 0;
    Origin origin;
    std::unique_ptr<ProcessWatch> watch;
    bool gone = false;
  };

  std::optional<Arrival> arrived();
  std::optional<exchange::Session> take_session();
  std::optional<exchange::Step> take_step();
  std::optional<ServerGone> take_departure();
  bool is_gone(const Granted& server, const std::vector<Origin>& left,
               const std::vector<Origin>& silent) const;
  bool wait(Duration timeout);

  std::map<std::string, Granted> granted_;
  std::optional<Reader<wire::Step>> steps_;
};

Arrival Client::Implementation::next(Duration timeout) {
  const Deadline deadline(timeout);
  while (true) {
    if (interrupted_) return Interrupted{};
    signal_.lower();
    if (auto arrival = arrived()) return std::move(*arrival);
    if (deadline.has_passed()) return Silence{};
    wait(deadline.left());
  }
}

std::optional<Arrival> Client::Implementation::arrived() {
  if (auto session = take_session()) return Arrival(std::move(*session));
  if (auto step = take_step()) return Arrival(std::move(*step));
  if (auto departure = take_departure()) return Arrival(std::move(*departure));
  return std::nullopt;
}

bool Client::Implementation::wait(Duration timeout) {
  std::vector<int> descriptors{signal_.descriptor()};
  for (const auto& [name, server] : granted_) descriptors.push_back(server.watch->descriptor());
  return wait_readable(descriptors, timeout);
}

std::optional<exchange::Session> Client::Implementation::take_session() {
  while (const wire::Session* sample = sessions_.take()) {
    if (sample->instance() != hello_.instance) continue;
    Result<exchange::Session> session = from_wire(*sample);
    if (!session) continue;
    if (!session->refusal.empty()) return std::move(*session);
    const auto known = granted_.find(session->server);
    if (known != granted_.end() && known->second.run == session->run) continue;  // Sent twice.
    // Only now: until a server has agreed to it, another process may use these topics.
    if (!replies_) replies_.emplace(participant_, reply_topic(hello_.process));
    if (!steps_) steps_.emplace(participant_, step_topic(hello_.process), signal_);
    granted_[session->server] = {session->run, sessions_.origin(),
                                 std::make_unique<ProcessWatch>(from_wire(sample->identity())),
                                 false};
    return std::move(*session);
  }
  return std::nullopt;
}

std::optional<exchange::Step> Client::Implementation::take_step() {
  if (!steps_) return std::nullopt;
  while (const wire::Step* sample = steps_->take()) {
    const auto server = granted_.find(sample->server());
    if (server == granted_.end() || server->second.run != sample->run()) continue;
    if (auto step = from_wire(*sample)) return std::move(*step);
  }
  return std::nullopt;
}

std::optional<ServerGone> Client::Implementation::take_departure() {
  const std::vector<Origin> left = sessions_.presence().take_left();
  const std::vector<Origin> silent = sessions_.presence().take_silent();
  for (auto& [name, server] : granted_) server.gone = server.gone || is_gone(server, left, silent);
  const auto first =
      std::ranges::find_if(granted_, [](const auto& entry) { return entry.second.gone; });
  if (first == granted_.end()) return std::nullopt;
  ServerGone departure{first->first};
  granted_.erase(first);
  return departure;
}

bool Client::Implementation::is_gone(const Granted& server, const std::vector<Origin>& left,
                                     const std::vector<Origin>& silent) const {
  if (server.watch->is_dead()) return true;
  if (std::ranges::find(left, server.origin) != left.end()) return true;
  return !server.watch->is_local() && std::ranges::find(silent, server.origin) != silent.end();
}

Result<void> Client::Implementation::reply(const std::string& server, exchange::Reply reply) {
  reply.process = hello_.process;
  wire::Reply sample = to_wire(reply, server);
  if (replies_ && replies_->write(sample)) return {};
  return fail(Errc::kNotConnected, "Fast DDS refuses a Reply");
}

Client::Client(int domain, exchange::Hello hello)
    : implementation_(std::make_unique<Implementation>(domain, std::move(hello))) {}
Client::~Client() = default;

const exchange::Hello& Client::hello() const { return implementation_->hello_; }
int Client::servers() const { return implementation_->sessions_.presence().writers(); }
Arrival Client::next(Duration timeout) { return implementation_->next(timeout); }

Result<void> Client::reply(const std::string& server, exchange::Reply reply) {
  return implementation_->reply(server, std::move(reply));
}

void Client::flush(Duration timeout) {
  if (implementation_->replies_) implementation_->replies_->flush(timeout);
}

void Client::interrupt() noexcept {
  implementation_->interrupted_ = true;
  implementation_->signal_.raise();
}

}  // namespace hal::dds
