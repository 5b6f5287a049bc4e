#include "hal/dds/server.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <utility>

#include "hal/dds/link_parts.h"

namespace hal::dds {
namespace {

/// A server of this process is told from the others by a number, from all others by its process.
std::string unique_name(const ProcessIdentity& identity) {
  static std::atomic<int> next{1};
  return fmt::format("{}/{}/{}/{}", identity.host, identity.pid, identity.start_time, next++);
}

}  // namespace

class Server::Implementation {
 public:
  explicit Implementation(DomainHold hold)
      : hold_(std::move(hold)),
        identity_(this_process()),
        name_(unique_name(identity_)),
        participant_(Participant::server(hold_.domain(), hold_.place())),
        hellos_(participant_, kHelloTopic, signal_),
        sessions_(participant_, kSessionTopic) {}

  std::vector<exchange::Hello> take_hellos() {
    std::vector<exchange::Hello> hellos;
    while (const wire::Hello* sample = hellos_.take()) {
      // What cannot be understood cannot be refused by name either; its sender runs out of
      // patience.
      auto hello = from_wire(*sample);
      if (!hello) continue;
      origins_[hello->instance] = hellos_.origin();
      hellos.push_back(std::move(*hello));
    }
    return hellos;
  }

  bool is_silent(const std::string& instance) {
    for (const Origin& origin : hellos_.presence().take_left()) silent_.push_back(origin);
    for (const Origin& origin : hellos_.presence().take_silent()) silent_.push_back(origin);
    return std::ranges::find(silent_, origins_[instance]) != silent_.end();
  }

  DomainHold hold_;
  ProcessIdentity identity_;
  std::string name_;
  Signal signal_;
  Participant participant_;
  Reader<wire::Hello> hellos_;
  Writer<wire::Session> sessions_;
  std::map<std::string, Origin> origins_;  ///< Of Hellos, by instance.
  std::vector<Origin> silent_;             ///< Everyone who ever was.
};

Server::Server(DomainHold hold)
    : implementation_(std::make_unique<Implementation>(std::move(hold))) {}
Server::~Server() = default;

int Server::domain() const { return implementation_->hold_.domain(); }
const std::string& Server::name() const { return implementation_->name_; }

std::vector<exchange::Hello> Server::hellos(Duration timeout, const std::vector<int>& watched) {
  implementation_->signal_.lower();
  std::vector<exchange::Hello> hellos = implementation_->take_hellos();
  if (!hellos.empty()) return hellos;
  std::vector<int> descriptors = watched;
  descriptors.push_back(implementation_->signal_.descriptor());
  wait_readable(descriptors, timeout);
  return implementation_->take_hellos();
}

int Server::descriptor() const { return implementation_->signal_.descriptor(); }

bool Server::has_hellos() const { return !implementation_->hellos_.is_empty(); }

Result<void> Server::answer(exchange::Session session) {
  session.server = implementation_->name_;
  wire::Session sample = to_wire(session, implementation_->identity_);
  if (implementation_->sessions_.write(sample)) return {};
  return fail(Errc::kNotConnected,
              fmt::format("Fast DDS refuses a Session for {}", session.instance));
}

std::unique_ptr<ProcessLink> Server::link(const exchange::Hello& hello, std::uint64_t run,
                                          std::optional<Duration> reply_timeout) {
  const auto is_silent = [parts = implementation_.get(), instance = hello.instance] {
    return parts->is_silent(instance);
  };
  LinkSettings settings{implementation_->name_, hello, run, reply_timeout, is_silent};
  auto parts = std::make_unique<ProcessLink::Implementation>(implementation_->participant_,
                                                             std::move(settings));
  return std::unique_ptr<ProcessLink>(new ProcessLink(std::move(parts)));
}

}  // namespace hal::dds
