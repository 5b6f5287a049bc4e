#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "results/record/database.h"
#include "sim/air/ledger.h"
#include "sim/scenario/detail.h"

namespace results::record {

/// The tables of what the air is used for: air_accounts, air_ends, air_writers, air_seconds,
/// dds_endpoints, sample_sums, sample_losses, sample_latencies and samples. It keeps the ledger.
class AirLog {
 public:
  /// @param samples  kNone: nothing of samples, kCounts: sums, kAll: these and each delivery.
  AirLog(Database& database, sim::scenario::Detail samples);
  AirLog(const AirLog&) = delete;
  AirLog& operator=(const AirLog&) = delete;

  sim::air::Ledger& ledger() { return ledger_; }
  const sim::air::Ledger& ledger() const { return ledger_; }

  /// About as many as write() would write, without those of samples.
  std::uint64_t rows() const { return ledger_.accounts().changes(); }

  /// Writes a row for each count that changed since the last call.
  void write();

  /// The run ended: all is settled and written.
  void finish(hal::Time now);

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
  std::vector<std::string> guids_;  ///< As texts, by EndpointIndex.
};

/// "0110a1b2.c3d4e5f6.00000001.000003c2", as tshark and Fast DDS have it but for their dots.
std::string guid_text(const hal::rtps::Guid& guid);

}  // namespace results::record
