#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "hal/types/message.h"
#include "results/record/pcapng.h"
#include "results/record/radiotap.h"
#include "sim/agents/observer.h"
#include "sim/radio/radio_config.h"

namespace results::record {

/// Writes the frames of a run to a capture file: either all frames that are sent, as an ideal
/// monitor would capture them that hears every station and loses nothing, or the frames that one
/// station sends and receives.
///
/// The time stamp of a packet is the time of the last bit of its PPDU, at the transmitter or at the
/// receiving station, so packets are in order of time. Each MPDU of an A-MPDU is one packet. Frames
/// that are aborted, or still in the air at the end, are not written; nor, in the capture of one
/// station, are frames that it failed to receive: every packet has a correct FCS. The bytes are
/// those of radio::encode(), also where `lengths: fixed` gives frames another length on the air.
class AirCapture final : public sim::agents::Observer {
 public:
  /// Channel numbers of the stations that are not on the radio's own channel.
  using Channels = std::map<hal::AgentId, std::uint32_t>;
  struct Air {
    const sim::radio::RadioConfig& config;
    Channels others{};
  };
  /// @param heard_by  the station whose frames are captured; none: all frames, on all channels.
  /// @param interface  name of the interface in the file.
  /// @throws std::runtime_error  the file cannot be written; the other members throw it as well.
  AirCapture(const std::filesystem::path& file, const Air& air,
             std::optional<hal::AgentId> heard_by, std::string_view interface);

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;
  void on_frame_cut(hal::Time at, const sim::radio::Frame& frame) override;
  void on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;

  /// Flushes what has been captured so far, so that others can read it.
  void flush() { file_.flush(); }

  /// Writes the frames whose transmission ended before or at the end of the run.
  void finish(hal::Time ended_at);

 private:
  /// A frame that is being transmitted.
  struct InTheAir {
    std::uint64_t frame = 0;
    hal::Bytes packet;
  };

  void write_ended(hal::Time until);
  RadiotapFields fields_of(const sim::radio::Frame& frame, hal::Time start);
  std::uint32_t number_of_ampdu(const sim::radio::Frame& frame);

  std::optional<hal::AgentId> heard_by_;
  std::uint16_t frequency_;                            ///< MHz, of the radio's own channel.
  std::map<hal::AgentId, std::uint16_t> of_stations_;  ///< MHz, of stations on other channels.
  std::optional<double> noise_dbm_;
  PcapngFile file_;
  /// Number of A-MPDUs so far, and the last one. The MPDUs of one are reported one after another.
  std::uint32_t ampdus_ = 0;
  std::pair<hal::AgentId, std::uint32_t> last_ampdu_{};
  /// By end of the transmission; ties are in order of begin.
  std::multimap<hal::Time, InTheAir> in_the_air_;
};

}  // namespace results::record
