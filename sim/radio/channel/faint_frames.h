#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/channel/neighbourhood.h"
#include "sim/radio/channel/station_index.h"

namespace sim::radio {

/// A frame, or a burst, as it arrives where it is faint.
struct FaintSignal {
  hal::Time start{};
  double power = 0;           ///< mW
  std::uint32_t airtime = 0;  ///< ns
  std::uint32_t delay = 0;    ///< ns
  std::uint32_t order = 0;    ///< Among all of a FaintFrames, in the order of transmission.
  std::uint16_t from = 0;     ///< StationIndex, fewer than 2^16 - 1; that one is no station.
  bool is_added = false;      ///< Whether it stays until it is over, without being asked for.

  hal::Time end() const { return start + hal::Duration{airtime}; }
};

/// Frames on the air, whose power at a receiver is computed when the receiver asks for it. For each
/// receiver it keeps a bound of what their powers add up to, so that hardly any has to ask in order
/// to know that the sum is far below the energy that it senses.
class FaintFrames {
 public:
  /// @param neighbourhood  outlives this.
  explicit FaintFrames(const Neighbourhood& neighbourhood) : neighbourhood_(neighbourhood) {}

  /// At a receiver, mW. A receiver whose bound reaches its alarm is told of each frame.
  struct Level {
    double bound = 0;  ///< Not less than the sum of all frames that are present or on their way.
    double alarm = 0;
    std::uint32_t first = 0;  ///< Order of the first frame that collect() appends.
    std::uint32_t asked = 0;  ///< next() when it last asked.
  };
  /// Adds the next receiver.
  void add_receiver() { levels_.emplace_back(); }
  Level& level(StationIndex receiver) { return levels_[receiver]; }

  /// Adds the last frame to the bounds at the receivers of its links. @param tell  called with each
  /// receiver whose bound reaches its alarm.
  template <class Tell>
  void raise(std::span<const AskedLink> links, Tell&& tell) {
    Level* const levels = levels_.data();
    for (const AskedLink link : links) {
      Level& level = levels[link.receiver];
      level.bound += link.most;
      if (level.bound >= level.alarm) tell(link.receiver);
    }
  }

  /// A frame of a station begins now. Its links are up to date.
  void start(StationIndex from, hal::Time now, hal::Duration airtime);
  /// The frame that the station began at `sent` ends there at `cut`.
  void cut(StationIndex from, hal::Time sent, hal::Time cut);

  /// A burst begins; it is not kept here. @return its order.
  std::uint32_t pass() { return next_++; }
  /// Order of the next frame; changes with each of them.
  std::uint32_t next() const { return next_; }

  /// Appends those frames that are faint at the receiver and not over there at `now`, in order.
  void collect(StationIndex receiver, hal::Time now, std::vector<FaintSignal>& signals) const;
  /// Appends the last frame. @pre it is faint at the receiver.
  void collect_last(StationIndex receiver, std::vector<FaintSignal>& signals) const {
    append(frames_.back(), receiver, signals);
  }

  /// Prefetches what collect() reads of a receiver.
  void prefetch(StationIndex receiver) const {
    __builtin_prefetch(&levels_[receiver]);
    neighbourhood_.prefetch(receiver);
  }

  /// From now on collect() leaves out earlier frames at this receiver.
  void leave_to(StationIndex receiver) { levels_[receiver].first = next_; }
  /// Whether collect() can tell what arrives at the receiver. If not, it must be told of each frame
  /// in time.
  bool answers(StationIndex receiver) const { return neighbourhood_.is_asking(receiver); }

  /// In the order of transmission. The numbers may begin again from 0.
  static bool precedes(std::uint32_t one, std::uint32_t other) {
    return static_cast<std::int32_t>(one - other) < 0;
  }

 private:
  struct Frame {
    Departure departure;
    std::uint32_t airtime = 0;  ///< ns
    std::uint32_t order = 0;
  };
  /// The part of some Frames that is looked at for all of them, rounded so that no frame that
  /// matters is left out.
  struct Glance {
    static constexpr std::size_t kFrames = 16;
    std::array<float, kFrames> x{}, y{};      ///< m
    std::array<std::int32_t, kFrames> end{};  ///< At the transmitter, steps since `begin_`.
  };
  /// 2^8 ns, so that nine minutes are told apart.
  static constexpr int kStep = 8;
  std::int32_t steps(hal::Time time) const {
    return static_cast<std::int32_t>((time - begin_).count() >> kStep);
  }
  std::int32_t& end_of(std::size_t frame) {
    return glances_[frame / Glance::kFrames].end[frame % Glance::kFrames];
  }
  void look(std::size_t frame);
  void append(const Frame& frame, StationIndex receiver, std::vector<FaintSignal>& signals) const;
  void collect_one(const Frame& frame, StationIndex receiver, hal::Time now,
                   std::vector<FaintSignal>& signals) const;
  void forget(hal::Time over);

  const Neighbourhood& neighbourhood_;
  std::vector<Level> levels_;
  std::vector<Frame> frames_;  ///< In the order of transmission, like the next.
  std::vector<Glance> glances_;
  hal::Time begin_{};      ///< When frames were last forgotten.
  std::size_t first_ = 0;  ///< Those before it are over.
  std::size_t most_ = 0;   ///< With so many frames, those that are over are forgotten.
  std::uint32_t next_ = 0;
};

}  // namespace sim::radio
