#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/core/cell_grid.h"
#include "sim/core/event_queue.h"
#include "sim/radio/channel/ports.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/channel/station_index.h"

namespace sim::radio {

/// Received power and delay of one station's frames at another, valid while neither of them moves.
struct AudibleLink {
  StationIndex receiver = 0;
  std::uint32_t moves = 0;  ///< Sum of both stations' `moves` when this was computed.
  Propagation::Arrival arrival;
  Propagation::Steady steady;  ///< Basis from which `arrival` was last evaluated.
};

/// A link whose frames are only interference.
struct FaintLink {
  double power = 0;  ///< mW
  StationIndex receiver = 0;
  std::uint32_t moves = 0;
  std::uint32_t delay = 0;  ///< ns
};

/// A pair that is out of range, but close enough to come into range before a cell changes.
struct DistantLink {
  StationIndex receiver = 0;
  std::uint32_t moves = 0;
  hal::Time out_of_reach_until{};  ///< Whatever the movement of the two.
};

/// Links from one station to all stations that its frames can affect, each list in order of
/// receivers.
struct Links {
  std::vector<AudibleLink> audible;
  std::vector<FaintLink> faint;
  std::vector<DistantLink> distant;
  std::vector<std::uint32_t> by_arrival;  ///< Indices into `audible`, ordered by (delay, receiver).
  bool is_fixed = true;                   ///< The transmitter and all stations in range never move.
};

/// Links between stations: which stations can sense each other's frames, and with which power.
/// Positions are read when a frame starts; links of stations that have not moved since are not
/// computed again. Moving stations are assigned to their new cell by an event: a station is checked
/// again before it can have left its cell by more than a margin, and links are kept to all stations
/// whose cells are nearer than the range plus twice the margin. A station that changes its cell
/// collects its links again; it is removed from the links of stations that it leaves and added to
/// those of stations that it approaches.
class Neighbourhood {
 public:
  struct Antenna {
    hal::AgentId agent;
    hal::Milliwatts tx_power;
    double height = 0;             ///< m above the agent's position.
    std::uint64_t name = 0;        ///< As in Site::name.
    double gain = 1;               ///< Ratio, for transmission and reception.
    hal::Milliwatts most_power{};  ///< Largest power for set_tx_power(), if above `tx_power`.
  };
  /// @param antennas  in ascending order of agents; the index into it is the StationIndex.
  Neighbourhood(EventQueue& events, const Positions& positions, const Propagation& propagation,
                const std::vector<Antenna>& antennas);

  /// Up-to-date links from this station to all stations that its frames can affect. Valid until the
  /// next call for this station.
  const Links& links_from(StationIndex transmitter);

  /// Reports that the station jumped to another position.
  void displace(StationIndex station);

  /// Sets the transmit power of a station from its next frame on. @param power  at most the greater
  /// of its antenna's `tx_power` and `most_power`.
  void set_tx_power(StationIndex station, hal::Milliwatts power);

  /// Received power and delay of a signal sent from a place without a station. The means of frames
  /// do not change.
  Propagation::Arrival arrival(hal::Milliwatts sent, const Site& from, StationIndex to);

  /// Frees the memory that links_from() took for a station; use it for stations that may never
  /// transmit.
  void forget(StationIndex transmitter);

 private:
  struct Station {
    Site site;
    hal::Milliwatts radiated;
    double gain = 1;
    double max_speed = 0;  ///< m/s
    hal::Time valid_until{};
    std::uint32_t moves = 1;
    bool is_out_of_date = true;  ///< Its links are: its neighbourhood has changed.
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
  double reach_;   ///< Range of the strongest transmitter [m].
  double margin_;  ///< m
  CellGrid grid_;
  std::vector<Station> stations_;
  std::vector<Links> links_;  ///< One per transmitter.
  /// While links are updated: those that move to another list.
  std::vector<AudibleLink> changed_;
};

}  // namespace sim::radio
