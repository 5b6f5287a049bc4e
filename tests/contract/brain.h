#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "gateway/exchange/client.h"
#include "hal/node/exchange/ports.h"

namespace contract {

/// What a controller process does, however it is reached: as a rule says about each event. It
/// remembers all. answer() is called on one thread at a time, the rest on any.
class Brain {
 public:
  /// What is done about an event; agent and event of the actions are filled in, unless they say.
  using Rule =
      std::function<std::vector<hal::node::exchange::Action>(const hal::node::exchange::Event&)>;

  explicit Brain(Rule rule) : rule_(std::move(rule)) {}
  virtual ~Brain() = default;
  Brain(const Brain&) = delete;
  Brain& operator=(const Brain&) = delete;

  /// @param server  who asks.
  hal::node::exchange::Reply answer(const hal::node::exchange::Step& step,
                                    const std::string& server);

  std::vector<hal::node::exchange::Event> seen(hal::AgentId agent) const;
  std::vector<hal::node::exchange::Event> seen(hal::AgentId agent,
                                               hal::node::exchange::Cause cause) const;
  std::uint64_t steps() const;
  /// Steps that did not come in the order of their numbers, by server from 1 without a gap.
  std::uint64_t gaps() const;

 protected:
  mutable std::mutex mutex_;

 private:
  Rule rule_;
  std::map<std::string, std::uint64_t> last_;  ///< Number of the last Step, by server.
  std::vector<hal::node::exchange::Event> seen_;
  std::uint64_t steps_ = 0, gaps_ = 0;
};

/// One that is asked over DDS, on a thread of its own.
class RemoteBrain final : public Brain {
 public:
  RemoteBrain(int domain, const std::string& process, std::vector<std::string> agents, Rule rule,
              const hal::Wants& wants,
              std::uint32_t version = hal::node::exchange::kProtocolVersion);
  ~RemoteBrain() override;

  /// Answers nobody until it is released.
  void hold(bool held) { held_ = held; }
  std::string refusal() const;
  /// Who is who, as each server that granted agents told.
  std::vector<std::vector<hal::node::exchange::AgentName>> directories() const;

 private:
  void run();
  void on(const hal::node::exchange::Session& session);
  void on(const hal::node::exchange::Step& step);

  gateway::exchange::Client client_;
  std::map<std::string, hal::node::exchange::Reply> replies_;  ///< The last one to each server.
  std::atomic<bool> held_ = false, stop_ = false;
  std::string refusal_;
  std::vector<std::vector<hal::node::exchange::AgentName>> directories_;
  std::thread thread_;
};

/// One that is asked by a call.
class BrainPort final : public hal::node::exchange::ControllerPort {
 public:
  /// @param brain  outlives the port.   @param name  another one for each port of a brain.
  BrainPort(Brain& brain, std::string name) : brain_(brain), name_(std::move(name)) {}

  const std::string& name() const override { return name_; }
  hal::Result<void> begin(const hal::node::exchange::Step& step) override {
    reply_ = brain_.answer(step, name_);
    return {};
  }
  hal::Result<hal::node::exchange::Reply> finish() override { return std::move(reply_); }
  hal::Result<void> check_alive() override { return {}; }

 private:
  Brain& brain_;
  std::string name_;
  hal::node::exchange::Reply reply_;
};

}  // namespace contract
