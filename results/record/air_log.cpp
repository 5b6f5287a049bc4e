#include "results/record/air_log.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace results::record {
namespace {

using sim::air::AirAccount;
using sim::air::AirKind;

/// Null if the frames of that kind have no topic.
std::optional<std::string> topic_of(const sim::air::Ledger& ledger, const AirKind& kind) {
  if (kind.topic == 0) return std::nullopt;
  return ledger.endpoints().topics()[kind.topic];
}

std::optional<int> port_of(const AirKind& kind) {
  if (kind.port == 0) return std::nullopt;
  return kind.port;
}

std::optional<int> agent_in(const std::optional<hal::AgentId>& agent) {
  if (!agent) return std::nullopt;
  return agent->value;
}

std::optional<std::int64_t> time_in(const std::optional<hal::Time>& time) {
  if (!time) return std::nullopt;
  return hal::to_ns(*time);
}

std::string_view name_of_durability(std::uint32_t durability) {
  constexpr std::string_view kNames[] = {"volatile", "transient local", "transient", "persistent"};
  return durability < std::size(kNames) ? kNames[durability] : "unknown";
}

}  // namespace

std::string guid_text(const hal::rtps::Guid& guid) {
  std::string text;
  for (std::size_t i = 0; i < guid.prefix.octets.size(); ++i) {
    if (i > 0 && i % 4 == 0) text += '.';
    text += fmt::format("{:02x}", std::to_integer<unsigned>(guid.prefix.octets[i]));
  }
  return text + fmt::format(".{:08x}", guid.entity.value);
}

AirLog::AirLog(Database& database, sim::scenario::Detail samples)
    : put_account_(database,
                   "REPLACE INTO air_accounts VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      put_end_(database, "REPLACE INTO air_ends VALUES (?, ?, ?, ?, ?, ?)"),
      put_writer_(database, "REPLACE INTO air_writers VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      put_second_(database, "REPLACE INTO air_seconds VALUES (?, ?, ?, ?)"),
      put_endpoint_(database, "REPLACE INTO dds_endpoints VALUES (?, ?, ?, ?, ?, ?, ?, ?)"),
      put_sum_(database, "REPLACE INTO sample_sums VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      put_loss_(database, "REPLACE INTO sample_losses VALUES (?, ?, ?, ?, ?)"),
      put_latency_(database, "REPLACE INTO sample_latencies VALUES (?, ?, ?, ?)"),
      insert_sample_(database, "INSERT INTO samples VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      samples_(samples) {
  ledger_.set_second_sink([this](const sim::air::AirSecond& second) { write_second(second); });
  if (samples_ != sim::scenario::Detail::kAll) return;
  ledger_.samples().set_sink([this](const sim::air::SampleDelivery& one) { write_delivery(one); });
}

const std::string& AirLog::guid(sim::air::EndpointIndex endpoint) {
  if (endpoint >= guids_.size()) guids_.resize(endpoint + std::size_t{1});
  std::string& text = guids_[endpoint];
  if (text.empty()) text = guid_text(ledger_.endpoints().all()[endpoint].guid);
  return text;
}

void AirLog::write(hal::Time) {
  ledger_.accounts().reset_changes();
  write_accounts();
  write_writers();
  write_endpoints();
  if (samples_ != sim::scenario::Detail::kNone) write_samples();
}

void AirLog::write_accounts() {
  auto& accounts = ledger_.accounts().all();
  for (std::size_t i = 0; i < accounts.size(); ++i) {
    AirAccount& account = accounts[i];
    write_ends(i);
    if (!std::exchange(account.changed, false)) continue;
    put_account_.run(std::uint64_t{i}, account.transmitter.value,
                     sim::air::name(account.kind.purpose), sim::air::what_text(account.kind),
                     port_of(account.kind), topic_of(ledger_, account.kind), account.frames,
                     account.retries, account.submessages, account.repeated, account.bits,
                     account.airtime.count());
  }
}

void AirLog::write_ends(std::size_t account) {
  for (const auto& at : ledger_.accounts().all()[account].at) {
    if (!at || !std::exchange(at->changed, false)) continue;
    for (int addressed = 0; addressed < 2; ++addressed) {
      for (int verdict = 0; verdict < hal::kVerdictCount; ++verdict) {
        const sim::air::AirEnds& end =
            at->ends[static_cast<std::size_t>(addressed)][static_cast<std::size_t>(verdict)];
        if (end.parts == 0) continue;
        put_end_.run(std::uint64_t{account}, at->receiver.value, addressed,
                     hal::name(static_cast<hal::Verdict>(verdict)), end.frames, end.parts);
      }
    }
  }
}

void AirLog::write_writers() {
  for (sim::air::WriterAccount& one : ledger_.accounts().writers()) {
    if (one.writer == 0 || !std::exchange(one.changed, false)) continue;
    put_writer_.run(one.transmitter.value, guid(one.writer), sim::air::name(one.kind.purpose),
                    sim::air::what_text(one.kind), topic_of(ledger_, one.kind).value_or(""),
                    one.submessages, one.repeated, one.bits, one.airtime.count());
  }
}

void AirLog::write_endpoints() {
  for (const sim::air::EndpointIndex i : ledger_.endpoints().take_told()) {
    const sim::air::Endpoint& one = ledger_.endpoints().all()[i];
    put_endpoint_.run(guid(i), agent_in(one.agent),
                      one.guid.entity.is_writer() ? "writer" : "reader",
                      ledger_.endpoints().topics()[one.topic], one.type,
                      one.is_reliable ? "reliable" : "best effort",
                      name_of_durability(one.durability), time_in(one.told_at));
  }
}

void AirLog::write_samples() {
  for (auto& [key, sums] : ledger_.samples().sums()) {
    if (std::exchange(sums.changed, false)) write_sums(key, sums);
  }
}

void AirLog::write_sums(const sim::air::Samples::Key& key, sim::air::SampleSums& sums) {
  const std::string& writer = guid(key.first);
  const int receiver = key.second.value;
  put_sum_.run(writer, receiver, sums.samples, sums.delivered, sums.first_try, sums.under_way,
               sums.repairs, sums.fragments, sums.bytes, sums.latency_sum.count());
  for (const auto& [cause, count] : sums.lost)
    put_loss_.run(writer, receiver, sim::air::name(cause), cause.at.value, count);
  for (auto& [bin, count] : sums.latencies.counts()) {
    if (!std::exchange(count.changed, false)) continue;
    put_latency_.run(writer, receiver, sim::air::LatencyHistogram::edge(bin).count(), count.times);
  }
}

void AirLog::write_second(const sim::air::AirSecond& second) {
  for (const auto& [key, airtime] : second.airtime) {
    put_second_.run(second.second, sim::air::name(key.first),
                    sim::air::what_text({.purpose = key.first, .what = key.second}),
                    airtime.count());
  }
}

void AirLog::write_delivery(const sim::air::SampleDelivery& one) {
  std::optional<std::string_view> verdict;
  std::optional<int> lost_at;
  std::optional<std::uint64_t> frame;
  if (one.loss) {
    verdict = sim::air::name(one.loss->cause);
    if (one.loss->cause.at.value != 0) lost_at = one.loss->cause.at.value;
    if (one.loss->frame != 0) frame = one.loss->frame;
  }
  insert_sample_.run(guid(one.writer), one.sequence_number, one.receiver.value,
                     hal::to_ns(one.entered), time_in(one.left), std::uint64_t{one.bytes},
                     std::uint64_t{one.fragments}, std::uint64_t{one.repairs}, one.is_repaired,
                     verdict, frame, lost_at);
}

}  // namespace results::record
