#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/random.h"
#include "sim/core/event_queue.h"
#include "sim/radio/mac/backoff.h"
#include "sim/radio/mac/dcf_timing.h"
#include "sim/radio/mac/edca_config.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Number of a station's contention function: 0 is the DCF's; with EDCA it is the access category,
/// and higher ones precede lower ones.
using ContentionFunction = std::size_t;

/// Is called when a contention function may access the medium.
class ChannelAccessListener {
 public:
  virtual ~ChannelAccessListener() = default;
  virtual void on_access(ContentionFunction function) = 0;
  /// The function could have accessed the medium, but a higher one of the same station does: to be
  /// treated like a collision (IEEE Std 802.11-2020, 10.23.2.4).
  virtual void on_internal_collision(ContentionFunction function) = 0;
};

/// Channel access of one station: its contention functions, each with a backoff and a contention
/// window, on one medium (IEEE Std 802.11-2020, 10.3.4 and 10.23.2).
class ChannelAccess {
 public:
  struct Rules {
    const DcfConfig& config;
    const DcfTiming& timing;
  };
  /// @param listener  outlives this object.
  ChannelAccess(EventQueue& events, hal::AgentId agent, const Rules& rules,
                const hal::RandomStream& random, ChannelAccessListener& listener);

  std::size_t functions() const { return 1 + others_.size(); }
  /// Longest time for which the function may hold the medium; 0: one frame exchange.
  hal::Duration txop_limit(ContentionFunction function) { return at(function).txop_limit; }

  /// Replaces the parameters of all access categories; no effect on the DCF.
  void set(const EdcaConfig& edca, const DcfTiming& timing);

  /// As in Backoff.
  void request(ContentionFunction function);
  void draw(ContentionFunction function);
  void reset_window(ContentionFunction function) { at(function).window.reset(); }
  void grow_window(ContentionFunction function) { at(function).window.grow(); }

  /// Report the state of the medium, by physical and virtual carrier sense, to all functions.
  void on_busy();
  void on_idle();
  void hold_until(hal::Time until);
  /// Resets all state when the radio is switched off. @param busy  state of the medium.
  void reset(bool busy);

 private:
  class Function final : private AccessListener {
   public:
    struct Settings {
      ContentionFunction number = 0;
      AccessParameters parameters{};
      AccessTiming timing{};
    };
    Function(ChannelAccess& all, EventQueue& events, hal::AgentId agent, const Settings& settings)
        : number(settings.number),
          txop_limit(settings.parameters.txop_limit),
          window(settings.parameters.cw_min, settings.parameters.cw_max),
          backoff(events, agent, settings.timing, all.random_, *this),
          all_(all) {}

    ContentionFunction number;
    hal::Duration txop_limit;
    ContentionWindow window;
    Backoff backoff;

   private:
    void on_access() override { all_.on_access(number); }
    ChannelAccess& all_;
  };

  void add(const AccessParameters& parameters, const DcfTiming& timing, bool counts_first);
  void on_access(ContentionFunction function);
  void arbitrate();

  EventQueue& events_;
  hal::AgentId agent_;
  hal::RandomStream random_;
  ChannelAccessListener& listener_;
  /// Calls `act` with each function.
  template <class Act>
  void each(Act act) {
    act(*first_);
    for (const auto& other : others_) act(*other);
  }
  Function& at(ContentionFunction function) {
    return function == 0 ? *first_ : *others_[function - 1];
  }

  std::optional<Function> first_;                  ///< In place, for the cache.
  std::vector<std::unique_ptr<Function>> others_;  ///< With EDCA.
  std::vector<ContentionFunction> ready_;          ///< Those whose backoffs end now.
};

}  // namespace sim::radio
