#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hal/node/exchange/ports.h"
#include "python/simulator/episode.h"

namespace python::simulator {

/// The port of robots that are driven from outside: shows their readings at each control instant
/// and sends the answers. All of them have their control instants at the same times.
class DrivenPort final : public hal::node::exchange::ControllerPort {
 public:
  /// What to do with a situation; nullopt: nothing, the run is about to end.
  using Ask = std::function<std::optional<std::vector<hal::Twist2>>(Situation)>;

  DrivenPort(const std::vector<hal::node::exchange::AgentSession>& sessions, Ask ask);

  const std::string& name() const override { return name_; }
  hal::Result<void> begin(const hal::node::exchange::Step& step) override;
  hal::Result<hal::node::exchange::Reply> finish() override { return std::move(reply_); }
  hal::Result<void> check_alive() override { return {}; }

  /// Readings as they are held now.
  const std::vector<AgentView>& views() const { return views_; }

 private:
  void take_in(const hal::node::exchange::Event& event);
  void answer(const hal::node::exchange::Step& step, hal::Time at,
              const std::vector<std::uint32_t>& due);

  const std::string name_ = "environment";
  Ask ask_;
  std::map<hal::AgentId, std::size_t> places_;
  /// Names of channels, by agent and number.
  std::vector<std::map<std::uint16_t, std::string>> channels_;
  std::vector<AgentView> views_;
  hal::node::exchange::Reply reply_;
};

}  // namespace python::simulator
