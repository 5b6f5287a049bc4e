#include "agentd/readiness.h"

#include <fmt/format.h>

#include <utility>

#include "agentd/service_notice.h"
#include "hal/types/log.h"

namespace agentd {
namespace {

using namespace std::chrono_literals;
using hal::robot::agent::SilentDevice;

constexpr hal::Duration kLookEvery = 20ms;
/// Devices that are present answer sooner, so that no message about waiting is needed.
constexpr hal::Duration kFirstWord = 1s;
constexpr hal::Duration kSayEvery = 5s;

}  // namespace

Readiness::Readiness(hal::robot::platform::EventLoop& loop, std::string agent, Silent silent,
                     std::function<void()> on_ready)
    : loop_(loop),
      agent_(std::move(agent)),
      silent_(std::move(silent)),
      on_ready_(std::move(on_ready)),
      say_at_(loop.now() + kFirstWord) {
  look();
}

void Readiness::look() {
  timer_ = 0;
  const std::vector<SilentDevice> silent = silent_();
  if (silent.empty()) return on_ready_();
  if (loop_.now() >= say_at_) {
    say(silent);
    say_at_ = loop_.now() + kSayEvery;
  }
  timer_ = loop_.schedule(loop_.now() + kLookEvery, [this] { look(); });
}

void Readiness::say(const std::vector<SilentDevice>& silent) const {
  std::string text = "waiting for";
  for (const SilentDevice& device : silent) {
    text += fmt::format("{} {} ({})", &device == &silent.front() ? "" : ",", device.name,
                        device.because);
  }
  hal::log::info(loop_.now(), agent_, "{}", text);
  notify_service_manager("STATUS=" + text);
}

}  // namespace agentd
