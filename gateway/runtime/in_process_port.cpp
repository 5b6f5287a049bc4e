#include "gateway/runtime/in_process_port.h"

#include <utility>

#include "hal/types/check.h"

namespace gateway::runtime {

InProcessPort::InProcessPort(std::string name, std::unique_ptr<ControllerHost> host)
    : name_(std::move(name)), host_(std::move(host)) {}

hal::Result<void> InProcessPort::begin(const hal::node::exchange::Step& step) {
  BARAKA_CHECK(!reply_);
  reply_ = host_->answer(step);
  reply_->process = name_;
  return {};
}

hal::Result<hal::node::exchange::Reply> InProcessPort::finish() {
  BARAKA_CHECK(reply_);
  return *std::exchange(reply_, std::nullopt);
}

}  // namespace gateway::runtime
