#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/node/exchange/ports.h"

namespace gateway::server {

/// Called for each answer of a controller when it is received.
using ReplyRecord = std::function<void(const hal::node::exchange::Reply&)>;

/// The port of a controller that runs inside its agent's network. It communicates with others
/// there, so its answers do not follow from what the run sends it: each is recorded.
class RecordedPort final : public hal::node::exchange::ControllerPort {
 public:
  RecordedPort(std::shared_ptr<hal::node::exchange::ControllerPort> port, ReplyRecord record)
      : port_(std::move(port)), record_(std::move(record)) {}

  const std::string& name() const override { return port_->name(); }
  hal::Result<void> begin(const hal::node::exchange::Step& step) override {
    return port_->begin(step);
  }
  hal::Result<hal::node::exchange::Reply> finish() override;
  hal::Result<std::optional<hal::node::exchange::Reply>> try_finish() override;
  std::vector<int> descriptors() const override { return port_->descriptors(); }
  hal::Result<void> check_alive() override { return port_->check_alive(); }

 private:
  std::shared_ptr<hal::node::exchange::ControllerPort> port_;
  ReplyRecord record_;
};

/// The port of such a controller in a repetition: returns the recorded answers, one after the
/// other.
class RepeatedPort final : public hal::node::exchange::ControllerPort {
 public:
  RepeatedPort(std::string name, std::deque<hal::node::exchange::Reply> replies, ReplyRecord record)
      : name_(std::move(name)), replies_(std::move(replies)), record_(std::move(record)) {}

  const std::string& name() const override { return name_; }
  hal::Result<void> begin(const hal::node::exchange::Step& step) override;
  /// Errors: kProtocol (the record has no more answers, or the next one answers another Step).
  hal::Result<hal::node::exchange::Reply> finish() override;
  hal::Result<void> check_alive() override { return {}; }

 private:
  std::string name_;
  std::deque<hal::node::exchange::Reply> replies_;
  ReplyRecord record_;
  std::vector<hal::AgentId> asked_;  ///< Agents of the events of the current Step.
  std::uint64_t run_ = 0, sequence_ = 0;
};

}  // namespace gateway::server
