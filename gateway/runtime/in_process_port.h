#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gateway/runtime/controller_host.h"
#include "hal/node/exchange/ports.h"

namespace gateway::runtime {

/// A port to controllers in this process: an exchange is a function call.
class InProcessPort : public hal::node::exchange::ControllerPort {
 public:
  InProcessPort(std::string name, std::unique_ptr<ControllerHost> host);

  const std::string& name() const override { return name_; }
  /// Computes the answer. Never fails.
  hal::Result<void> begin(const hal::node::exchange::Step& step) override;
  hal::Result<hal::node::exchange::Reply> finish() override;  ///< Returns the answer; never fails.
  hal::Result<void> check_alive() override { return {}; }

 private:
  std::string name_;
  std::unique_ptr<ControllerHost> host_;
  std::optional<hal::node::exchange::Reply> reply_;  ///< Empty: no Step is in progress.
};

}  // namespace gateway::runtime
