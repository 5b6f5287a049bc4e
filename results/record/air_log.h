#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/record/database.h"
#include "results/record/topic_writer.h"
#include "sim/air/ledger.h"
#include "sim/scenario/detail.h"

namespace results::record {

/// Writes the tables about the use of the air: air_accounts, air_ends, air_writers, air_seconds,
/// dds_endpoints, sample_sums, sample_losses, sample_latencies and samples. Owns the ledger.
class AirLog final : public TopicWriter {
 public:
  /// @param samples  DDS samples: kNone records nothing, kCounts sums, kAll sums and each delivery.
  AirLog(Database& database, sim::scenario::Detail samples);
  AirLog(const AirLog&) = delete;
  AirLog& operator=(const AirLog&) = delete;

  sim::air::Ledger& ledger() { return ledger_; }
  const sim::air::Ledger& ledger() const { return ledger_; }

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override {
    ledger_.on_frame_start(at, frame);
  }
  void on_frame_cut(hal::Time at, const sim::radio::Frame& frame) override {
    ledger_.on_frame_cut(at, frame);
  }
  void on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override {
    ledger_.on_reception(at, frame, receiver, verdict, rssi_dbm);
  }
  void on_msdu_end(hal::Time at, const sim::radio::Msdu& msdu,
                   const sim::radio::MsduEnd& end) override {
    ledger_.on_msdu_end(at, msdu, end);
  }
  void on_association(hal::Time at, hal::AgentId station,
                      std::optional<hal::AgentId> access_point) override {
    ledger_.on_association(at, station, access_point);
  }
  void on_air_entered(hal::Time at, hal::AgentId agent,
                      const sim::radio::MacRequest& request) override {
    ledger_.on_entered(at, agent, request);
  }
  void on_air_left(hal::Time at, hal::AgentId agent,
                   const sim::radio::MacIndication& indication) override {
    ledger_.on_left(at, agent, indication);
  }

  void write(hal::Time now) override;
  /// Without the tables of samples.
  Pending pending() const override { return {.rows = ledger_.accounts().changes()}; }
  void finish(hal::Time ended_at) override { ledger_.finish(ended_at); }

 private:
  void write_accounts();
  void write_ends(std::size_t account);
  void write_writers();
  void write_endpoints();
  void write_samples();
  void write_sums(const sim::air::Samples::Key& key, sim::air::SampleSums& sums);
  void write_second(const sim::air::AirSecond& second);
  void write_delivery(const sim::air::SampleDelivery& delivery);
  const std::string& guid(sim::air::EndpointIndex endpoint);

  Statement put_account_, put_end_, put_writer_, put_second_, put_endpoint_, put_sum_, put_loss_,
      put_latency_, insert_sample_;
  sim::scenario::Detail samples_;
  sim::air::Ledger ledger_;
  std::vector<std::string> guids_;  ///< Text forms, by EndpointIndex.
};

/// Format: "0110a1b2.c3d4e5f6.00000001.000003c2", as tshark and Fast DDS print it except for the
/// places of the dots.
std::string guid_text(const hal::rtps::Guid& guid);

}  // namespace results::record
