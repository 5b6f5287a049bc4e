#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hal/exchange/ports.h"
#include "hal/runtime/controller_host.h"

namespace hal::runtime {

/// Controllers in this process: the exchange is a call.
class InProcessPort : public exchange::ControllerPort {
 public:
  InProcessPort(std::string name, std::unique_ptr<ControllerHost> host);

  const std::string& name() const override { return name_; }
  Result<void> begin(const exchange::Step& step) override;  ///< Computes the answer. Never fails.
  Result<exchange::Reply> finish() override;                ///< Hands it over. Never fails.
  Result<void> check_alive() override { return {}; }

 private:
  std::string name_;
  std::unique_ptr<ControllerHost> host_;
  std::optional<exchange::Reply> reply_;  ///< Empty: no Step is under way.
};

}  // namespace hal::runtime
