#include "results/record/air_capture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/radio/mac/frame.h"

namespace results::record {
namespace {

/// Centre frequency of a channel. Radio models without waves are on channel 1.
std::uint16_t megahertz(std::uint32_t channel) {
  return static_cast<std::uint16_t>(sim::radio::centre_frequency(channel).value / 1e6);
}

std::uint16_t own_frequency(const sim::radio::RadioConfig& config) {
  const sim::radio::WavesConfig* const waves = sim::radio::waves_of(config);
  return megahertz(waves == nullptr ? 1 : waves->phy.channel);
}

std::optional<double> noise_of(const sim::radio::RadioConfig& config) {
  const sim::radio::WavesConfig* const waves = sim::radio::waves_of(config);
  if (waves == nullptr) return std::nullopt;
  return waves->receiver.noise_floor.value;
}

/// From the begin of the PPDU to its last bit, and to the first bit after its header.
hal::Duration until_last_bit(const sim::radio::Frame& frame) {
  return frame.ppdu_airtime() -
         (frame.mode == nullptr ? hal::Duration{} : frame.mode->signal_extension());
}
hal::Duration until_psdu(const sim::radio::Frame& frame) {
  return frame.mode == nullptr ? hal::Duration{} : frame.mode->preamble_and_header();
}

}  // namespace

AirCapture::AirCapture(const std::filesystem::path& file, const Air& air,
                       std::optional<hal::AgentId> heard_by, std::string_view interface)
    : heard_by_(heard_by),
      frequency_(own_frequency(air.config)),
      noise_dbm_(noise_of(air.config)),
      file_(file, interface) {
  for (const auto& [station, channel] : air.others) of_stations_[station] = megahertz(channel);
}

/// @param start  of the PPDU.
RadiotapFields AirCapture::fields_of(const sim::radio::Frame& frame, hal::Time start) {
  const auto other = of_stations_.find(frame.transmitter);
  return {.mpdu_start = start + until_psdu(frame),
          .frequency = other == of_stations_.end() ? frequency_ : other->second,
          .ampdu = number_of_ampdu(frame)};
}

std::uint32_t AirCapture::number_of_ampdu(const sim::radio::Frame& frame) {
  if (frame.ampdu == 0) return 0;
  const std::pair ampdu(frame.transmitter, frame.ampdu);
  if (std::exchange(last_ampdu_, ampdu) != ampdu) ++ampdus_;
  return ampdus_;
}

void AirCapture::on_frame_start(hal::Time at, const sim::radio::Frame& frame) {
  write_ended(at);
  if (heard_by_ && frame.transmitter != *heard_by_) return;
  in_the_air_.emplace(at + until_last_bit(frame),
                      InTheAir{frame.id, with_radiotap(frame, fields_of(frame, at))});
}

void AirCapture::on_frame_cut(hal::Time at, const sim::radio::Frame& frame) {
  write_ended(at);
  std::erase_if(in_the_air_, [&](const auto& entry) { return entry.second.frame == frame.id; });
}

void AirCapture::on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                              hal::Verdict verdict, double rssi_dbm) {
  if (heard_by_ != receiver || verdict != hal::Verdict::kDelivered) return;
  write_ended(at);
  const hal::Time start = at - frame.ppdu_airtime();
  RadiotapFields fields = fields_of(frame, start);
  if (noise_dbm_) fields.signal_dbm = rssi_dbm;
  fields.noise_dbm = noise_dbm_;
  file_.add(start + until_last_bit(frame), PcapngFile::Direction::kInbound,
            with_radiotap(frame, fields));
}

void AirCapture::finish(hal::Time ended_at) {
  write_ended(ended_at);
  flush();
}

void AirCapture::write_ended(hal::Time until) {
  const auto direction =
      heard_by_ ? PcapngFile::Direction::kOutbound : PcapngFile::Direction::kUnknown;
  while (!in_the_air_.empty() && in_the_air_.begin()->first <= until) {
    const auto ended = in_the_air_.extract(in_the_air_.begin());
    file_.add(ended.key(), direction, ended.mapped().packet);
  }
}

}  // namespace results::record
