#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/node/exchange/ports.h"
#include "hal/types/time.h"

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
  bool shares_time() const override { return port_->shares_time(); }
  std::vector<int> descriptors() const override { return port_->descriptors(); }
  hal::Result<void> check_alive() override { return port_->check_alive(); }

 private:
  std::shared_ptr<hal::node::exchange::ControllerPort> port_;
  ReplyRecord record_;
};

/// An answer in the record of a run.
struct RecordedReply {
  hal::Time at{};  ///< When it was received.
  hal::node::exchange::Reply reply;
};

/// The time of a repetition of a run in lock-step.
struct RepeatedTime {
  std::function<hal::Time()> now;
  /// Makes the repetition have an instant at this time, after which it asks for answers.
  std::function<void(hal::Time)> stop_at;
};

/// The port of such a controller in a repetition: returns the recorded answers, one after the
/// other; those of a run in lock-step when the run received them.
class RepeatedPort final : public hal::node::exchange::ControllerPort {
 public:
  /// @param time  none: the run was not in lock-step.
  RepeatedPort(std::string name, std::deque<RecordedReply> replies, ReplyRecord record,
               std::optional<RepeatedTime> time = std::nullopt)
      : name_(std::move(name)),
        replies_(std::move(replies)),
        record_(std::move(record)),
        time_(std::move(time)) {}

  const std::string& name() const override { return name_; }
  hal::Result<void> begin(const hal::node::exchange::Step& step) override;
  /// Errors: kProtocol (the record has no more answers, or the next one answers another Step).
  hal::Result<hal::node::exchange::Reply> finish() override;
  hal::Result<std::optional<hal::node::exchange::Reply>> try_finish() override;
  bool shares_time() const override { return time_.has_value(); }
  hal::Result<void> check_alive() override { return {}; }

 private:
  std::string name_;
  std::deque<RecordedReply> replies_;
  ReplyRecord record_;
  std::optional<RepeatedTime> time_;
  std::vector<hal::AgentId> asked_;  ///< Agents of the events of the current Step.
  std::uint64_t run_ = 0, sequence_ = 0;
};

}  // namespace gateway::server
