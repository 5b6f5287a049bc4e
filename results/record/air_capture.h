#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

#include "hal/types/message.h"
#include "results/record/pcapng.h"
#include "sim/agents/observer.h"
#include "sim/radio/radio_config.h"

namespace results::record {

/// Writes the frames of a run as they are on the air to a capture file: all that are sent, as an
/// ear hears them that is everywhere and loses none, or what one station sends and receives.
///
/// The time of a packet is when the last bit of its frame was there: at its transmitter, or at the
/// station. So they are in order. Frames that are broken off, or still in the air at the end, are
/// not written; of a station, neither are those that it lost: all that are there have a right FCS.
/// Bytes are those of radio::encode(), also where `lengths: fixed` gives frames another length on
/// the air.
class AirCapture final : public sim::agents::Observer {
 public:
  /// Numbers of the stations that are not on the radio's own channel.
  using Channels = std::map<hal::AgentId, std::uint32_t>;
  struct Air {
    const sim::radio::RadioConfig& config;
    Channels others{};
  };
  /// @param heard_by  none: the ear, on all channels.  @param interface  its name in the file.
  /// @throws std::runtime_error  the file cannot be written; so does all that follows.
  AirCapture(const std::filesystem::path& file, const Air& air,
             std::optional<hal::AgentId> heard_by, std::string_view interface);

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;
  void on_frame_cut(hal::Time at, const sim::radio::Frame& frame) override;
  void on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;

  /// Makes what there is so far readable for others.
  void flush() { file_.flush(); }

  /// Writes what was sent and ended before, or at, the end of the run.
  void finish(hal::Time ended_at);

 private:
  /// Of the transmitter.
  struct InTheAir {
    std::uint64_t frame = 0;
    hal::Bytes packet;
  };

  void write_ended(hal::Time until);
  std::uint16_t frequency_of(const sim::radio::Frame& frame) const;

  std::optional<hal::AgentId> heard_by_;
  std::uint16_t frequency_;                            ///< MHz …
  std::map<hal::AgentId, std::uint16_t> of_stations_;  ///< … and of those on other channels.
  std::optional<double> noise_dbm_;
  PcapngFile file_;
  std::multimap<hal::Time, InTheAir> in_the_air_;  ///< By end; of equals the first to begin first.
};

}  // namespace results::record
