#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/core/cell_grid.h"
#include "sim/core/event_queue.h"
#include "sim/radio/ports.h"
#include "sim/radio/propagation.h"
#include "sim/radio/station_index.h"

namespace sim::radio {

/// Power and delay of a station's frames at one other station, while neither of them moves.
struct AudibleLink {
  StationIndex receiver = 0;
  std::uint32_t moves = 0;  ///< Of both together when this was computed.
  Propagation::Arrival arrival;
  Propagation::Steady steady;  ///< Of which `arrival` is the value at the last look.
};

/// The same where the frames are interference only.
struct FaintLink {
  double power = 0;  ///< mW
  StationIndex receiver = 0;
  std::uint32_t moves = 0;
  std::uint32_t delay = 0;  ///< ns
};

/// A pair that is out of reach, and near enough to come into it before cells change.
struct DistantLink {
  StationIndex receiver = 0;
  std::uint32_t moves = 0;
  hal::Time out_of_reach_until{};  ///< However fast the two move.
};

/// From one station to all that it matters to, each list of links by receiver.
struct Links {
  std::vector<AudibleLink> audible;
  std::vector<FaintLink> faint;
  std::vector<DistantLink> distant;
  std::vector<std::uint32_t> by_arrival;  ///< Indices into `audible` by (delay, receiver).
  bool is_fixed = true;  ///< The transmitter stands for ever, and so do all in reach.
};

/// Links between stations: which can sense each other's frames, and with which power. Positions are
/// read when a frame starts; links of stations that have not moved since are not computed again.
/// Moving stations are assigned to their new cell by an event: a station is checked again before it
/// can have left its cell by more than a margin, and links are kept to all stations whose cells are
/// nearer than the range plus twice the margin. A station that changes its cell collects its links
/// again, and is removed from the links of stations that it leaves and added to those that it
/// approaches.
class Neighbourhood {
 public:
  struct Antenna {
    hal::AgentId agent;
    hal::Milliwatts tx_power;
    double height = 0;             ///< m above the agent's position.
    std::uint64_t name = 0;        ///< As Site::name.
    double gain = 1;               ///< A ratio; when sending and when receiving.
    hal::Milliwatts most_power{};  ///< That set_tx_power() may ask for, if more than `tx_power`.
  };
  /// @param antennas  in ascending order of agents; the index into it is the StationIndex.
  Neighbourhood(EventQueue& events, const Positions& positions, const Propagation& propagation,
                const std::vector<Antenna>& antennas);

  /// Up-to-date links from this station to all that notice it. Valid until the next call for it.
  const Links& links_from(StationIndex transmitter);

  /// The station is somewhere else now, without having moved there.
  void displace(StationIndex station);

  /// What the station sends with from its next frame on. @param power  at most the greater one of
  /// its antenna's `tx_power` and `most_power`.
  void set_tx_power(StationIndex station, hal::Milliwatts power);

  /// What comes of a power that is sent at a place where no station is. Frames keep their mean.
  Propagation::Arrival arrival(hal::Milliwatts sent, const Site& from, StationIndex to);

  /// Gives back the memory that links_from() took for a station, which may never transmit.
  void forget(StationIndex transmitter);

 private:
  struct Station {
    Site site;
    hal::Milliwatts radiated;
    double gain = 1;
    double max_speed = 0;  ///< m/s
    hal::Time valid_until{};
    std::uint32_t moves = 1;
    bool is_out_of_date = true;  ///< Its links: who is near has changed.
  };

  void add(const Antenna& antenna);
  AudibleLink link(StationIndex from, StationIndex to) const;
  void refresh(Station& station);
  void collect(StationIndex transmitter);
  void follow(StationIndex transmitter);
  /// @return whether any link has changed.
  template <class OneLink>
  bool follow(StationIndex from, std::vector<OneLink>& links, Propagation::Strength strength);
  void follow_time(StationIndex transmitter);
  static void sort_by_arrival(Links& links);
  hal::Time out_of_reach_until(StationIndex from, const AudibleLink& link) const;
  void put(StationIndex from, Links& links, const AudibleLink& link);
  void watch_cell(StationIndex station);
  void change_cell(StationIndex station);
  void part(StationIndex from, StationIndex to);
  void meet(StationIndex from, StationIndex to);

  EventQueue& events_;
  const Positions& positions_;
  const Propagation& propagation_;
  double reach_;   ///< Of the strongest transmitter, m.
  double margin_;  ///< m
  CellGrid grid_;
  std::vector<Station> stations_;
  std::vector<Links> links_;  ///< By transmitter.
  /// While links are followed: those that belong into another list.
  std::vector<AudibleLink> changed_;
};

}  // namespace sim::radio
