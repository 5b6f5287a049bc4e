#include "hal/runtime/in_process_port.h"

#include <utility>

#include "hal/types/check.h"

namespace hal::runtime {

InProcessPort::InProcessPort(std::string name, std::unique_ptr<ControllerHost> host)
    : name_(std::move(name)), host_(std::move(host)) {}

Result<void> InProcessPort::begin(const exchange::Step& step) {
  BARAKA_CHECK(!reply_);
  reply_ = host_->answer(step);
  reply_->process = name_;
  return {};
}

Result<exchange::Reply> InProcessPort::finish() {
  BARAKA_CHECK(reply_);
  return *std::exchange(reply_, std::nullopt);
}

}  // namespace hal::runtime
