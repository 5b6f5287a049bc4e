#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "sim/core/cell_grid.h"
#include "sim/core/event_queue.h"
#include "sim/radio/channel/antenna.h"
#include "sim/radio/channel/links.h"
#include "sim/radio/channel/ports.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/channel/station_index.h"

namespace sim::radio {

/// A frame as it leaves its antenna.
struct Departure {
  Site site;
  hal::Milliwatts radiated{};  ///< Times the gain of the antenna.
  hal::Time at{};
  StationIndex station = 0;
};

/// Links between stations: which stations can sense each other's frames, and with which power.
/// Positions are read when a frame starts; links of stations that have not moved since, or turned
/// with an antenna that is not equal in all directions, are not computed again. Moving stations are
/// assigned to their new cell by an event: a station is checked again before it can have left its
/// cell by more than a margin, and links are kept to all stations whose cells are nearer than the
/// range plus twice the margin. A station that changes its cell collects its links again; it is
/// removed from the links of stations that it leaves and added to those of stations that it
/// approaches.
class Neighbourhood {
 public:
  struct Antenna {
    hal::AgentId agent;
    hal::Milliwatts tx_power;
    double height = 0;             ///< m above the agent's position.
    std::uint64_t name = 0;        ///< As in Site::name.
    double gain = 1;               ///< Ratio, for transmission and reception.
    hal::Milliwatts most_power{};  ///< Largest power for set_tx_power(), if above `tx_power`.
    std::shared_ptr<const AntennaPattern> pattern{};  ///< Times `gain`. Null: 1 in all directions.
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

  /// What a station sends now. @pre links_from() has been called for it now.
  Departure departure(StationIndex station, hal::Time now) const {
    return {stations_[station].site, stations_[station].radiated, now, station};
  }

  /// Whether mean_arrival() can tell what arrives at a station; its links then are `asked` in place
  /// of `faint`. It must stand still or have its positions remembered, and power must depend on
  /// nothing but the distance.
  bool is_asking(StationIndex receiver) const { return stations_[receiver].is_asking; }

  /// What arrives of a frame, where the receiver was when it was sent. The means of frames do not
  /// change. @pre is_asking(receiver), and the receiver has not jumped since
  Propagation::Arrival mean_arrival(const Departure& frame, StationIndex receiver) const;

  /// At no greater distance, m, in the plane.
  struct Circle {
    double x = 0, y = 0;
    double radius = 0;
  };
  /// Prefetches what is known of a station.
  void prefetch(StationIndex station) const {
    const char* const bytes = reinterpret_cast<const char*>(&stations_[station]);
    __builtin_prefetch(bytes);
    __builtin_prefetch(bytes + sizeof(Station) - 1);
  }

  /// Prefetches what links_from() will look at in search of what has moved; nothing where neither
  /// the transmitter nor a station in range can move.
  void prefetch_links(StationIndex transmitter) const;

  /// Contains all antennas of whose present frames a station may notice anything.
  Circle around(StationIndex receiver) const;
  hal::Duration longest_delay() const { return longest_delay_; }

  /// Frees the memory that links_from() took for a station; use it for stations that may never
  /// transmit.
  void forget(StationIndex transmitter);

 private:
  /// Cells along the distance up to which links are kept. More: fewer pairs out of range are kept,
  /// but stations change cells more often.
  static constexpr int kCellsInReach = 4;

  struct Station {
    Site site;
    hal::Milliwatts radiated;
    double gain = 1;
    double max_speed = 0;  ///< m/s
    hal::Time valid_until{};
    std::uint32_t moves = 1;
    bool is_out_of_date = true;  ///< Its links are: its neighbourhood has changed.
    bool is_asking = false;
    std::unique_ptr<DirectedAntenna> directed{};  ///< Null: equal in all directions.
  };

  void add(const Antenna& antenna);
  AudibleLink link(StationIndex from, StationIndex to) const;
  void refresh(Station& station);
  void collect(StationIndex transmitter);
  void follow(StationIndex transmitter);
  /// @return whether any link has changed.
  template <class OneLink>
  bool follow(StationIndex from, std::vector<OneLink>& links, Propagation::Strength strength);
  void follow_asked(StationIndex from, CertainLinks<AskedLink>& links);
  void follow_distant(StationIndex from, CertainLinks<DistantLink>& links);
  void follow_time(StationIndex transmitter);
  struct Certainty {
    float most;
    Tick until;
  };
  Certainty certainty(StationIndex from, const AudibleLink& link);
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
  bool may_ask_;   ///< Power depends on nothing but the distance.
  hal::Duration longest_delay_;
  CellGrid grid_;
  std::vector<Station> stations_;
  std::vector<Links> links_;  ///< One per transmitter.
  /// While links are updated: those that move to another list.
  std::vector<AudibleLink> changed_;
  Propagation::FaintRange faint_{};  ///< Of the last certainty().
};

}  // namespace sim::radio
