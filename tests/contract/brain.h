#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "hal/dds/client.h"

namespace contract {

/// A controller process in a thread: does what a rule says about each event, and remembers all.
class Brain {
 public:
  /// What is done about an event; agent and event of the actions are filled in.
  using Rule = std::function<std::vector<hal::exchange::Action>(const hal::exchange::Event&)>;

  Brain(int domain, const std::string& process, std::vector<std::string> agents, Rule rule = {},
        std::uint32_t version = hal::exchange::kProtocolVersion);
  ~Brain();
  Brain(const Brain&) = delete;
  Brain& operator=(const Brain&) = delete;

  /// Answers nobody until it is released.
  void hold(bool held) { held_ = held; }

  std::vector<hal::exchange::Event> seen(hal::AgentId agent) const;
  std::vector<hal::exchange::Event> seen(hal::AgentId agent, hal::exchange::Cause cause) const;
  std::string refusal() const;
  std::uint64_t steps() const;
  /// Steps that did not come in the order of their numbers, by server without a gap.
  std::uint64_t gaps() const;

 private:
  void run();
  void on(const hal::exchange::Session& session);
  void on(const hal::exchange::Step& step);

  Rule rule_;
  hal::dds::Client client_;
  std::map<std::string, hal::exchange::Reply> replies_;  ///< The last one to each server.
  std::atomic<bool> held_ = false, stop_ = false;
  mutable std::mutex mutex_;  ///< Of what follows.
  std::vector<hal::exchange::Event> seen_;
  std::uint64_t steps_ = 0, gaps_ = 0;
  std::string refusal_;
  std::thread thread_;
};

}  // namespace contract
