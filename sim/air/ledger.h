#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "sim/air/air_accounts.h"
#include "sim/air/content.h"
#include "sim/air/endpoints.h"
#include "sim/air/samples.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/mac/observer.h"

namespace sim::air {

/// Air time of one simulated second by purpose; frames count in the second in which they begin.
struct AirSecond {
  std::int64_t second = 0;
  /// Keys: AirKind::purpose, AirKind::what.
  std::map<std::pair<Purpose, std::uint16_t>, hal::Duration> airtime{};
};

/// Accounts of air time by submessages, protocols and frames with their results, and of DDS
/// samples: whether they are delivered at first try, delivered after repair, or lost. It only
/// observes.
///
///   Ledger ledger;
///   RadioNetwork network(config, stations, {…, ledger, …});   // or beside other observers
///    …on_entered() and on_left() for frames that pass programs' interfaces…
///   ledger.finish(now);
///
/// Payloads are read once: when they enter or, if that is not reported, at their first
/// transmission.
class Ledger final : public radio::RadioObserver {
 public:
  Ledger();

  void on_frame_start(hal::Time at, const radio::Frame& frame) override;
  void on_frame_cut(hal::Time at, const radio::Frame& frame) override;
  void on_reception(hal::Time at, const radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;
  void on_msdu_end(hal::Time at, const radio::Msdu& msdu, const radio::MsduEnd& end) override;
  void on_association(hal::Time, hal::AgentId station,
                      std::optional<hal::AgentId> access_point) override {
    if (access_point) samples_.on_association(station, *access_point);
  }

  /// A frame from the agent's interface was accepted as this request.
  void on_entered(hal::Time at, hal::AgentId agent, const radio::MacRequest& request);
  /// A frame that the agent received was passed to its interface.
  void on_left(hal::Time at, hal::AgentId agent, const radio::MacIndication& indication);

  /// Ends the run: frames on the air count up to `now`, open samples are settled.
  void finish(hal::Time now);

  /// Settles samples that are old enough; call it before reading the counts.
  void settle(hal::Time now) { samples_.settle(now); }

  Endpoints& endpoints() { return endpoints_; }
  const Endpoints& endpoints() const { return endpoints_; }
  AirAccounts& accounts() { return accounts_; }
  const AirAccounts& accounts() const { return accounts_; }
  Samples& samples() { return samples_; }
  const Samples& samples() const { return samples_; }

  /// @param sink  called with each second when it is over, and with the last one in finish().
  void set_second_sink(std::function<void(const AirSecond&)> sink) { on_second_ = std::move(sink); }
  /// The current second.
  const AirSecond& this_second() const { return second_; }

 private:
  /// A frame that may still be on the air. A station can begin its next frame a SIFS later, when
  /// this one may still be propagating.
  struct Sent {
    std::uint64_t frame = 0;
    std::uint32_t ampdu = 0;
    hal::Time start{};        ///< Of its PPDU.
    hal::Duration before{};   ///< Airtime of the MPDUs before it in its A-MPDU.
    hal::Duration airtime{};  ///< Its own.
    ContentPtr content;
    AirAccounts::Shares shares;
  };
  /// A transmission with an answer.
  struct Attempt {
    std::uint64_t frame = 0;  ///< 0: none.
    hal::AgentId receiver{};
    /// At its receiver; nullopt: its radio did not detect it.
    std::optional<hal::Verdict> verdict{};
  };
  /// The transmissions so far of a unicast MSDU.
  struct Attempts {
    const hal::Bytes* payload = nullptr;
    Attempt last{};
    bool has_arrived = false;  ///< A transmission was received.
  };
  static constexpr std::size_t kRemembered = 8;
  /// Number of unfinished MSDUs that a station can have; only invalid data can cause more.
  static constexpr std::size_t kMostUnfinished = 1U << 16U;
  struct Station {
    /// A ring, which grows until it has room for the MPDUs of two A-MPDUs. Its size is a power
    /// of 2.
    std::vector<Sent> sent = std::vector<Sent>(kRemembered);
    std::size_t last = 0;
    std::vector<Attempts> unfinished;  ///< MSDUs that were sent, in the order of their first time.
    std::size_t last_end = 0;          ///< Index of the one whose frame ended last.
    Attempt rts;                       ///< The last one.

    Sent& place_for(const radio::Frame& frame);
    Sent* find(std::uint64_t frame);
    void on_attempt(const radio::Frame& frame, const hal::Bytes* payload);
    void on_attempt_end(const radio::Frame& frame, hal::Verdict verdict);
    /// Removes what is known of an MSDU that has ended. @param was_served  it was its turn.
    Attempts take(const hal::Bytes* payload, bool was_served);
  };
  /// A fragmented datagram at one receiver.
  struct Arriving {
    std::shared_ptr<const Datagram> datagram;
    std::vector<std::uint32_t> begins;  ///< Offsets of the fragments received.
    std::uint32_t octets = 0;
  };

  ContentPtr content_of(hal::Time at, const radio::Frame& frame);
  ContentPtr content_of(hal::Time at, const radio::AmsduPart& msdu);
  ContentPtr content_of_amsdu(hal::Time at, const std::vector<radio::AmsduPart>& msdus);
  ContentPtr read(hal::Time at, hal::AgentId source, hal::AgentId destination,
                  const radio::Payload& payload, radio::Ethertype type);
  Sent* find(const radio::Frame& frame);
  void shorten(Sent& sent, hal::Time end);
  void on_group_frame(hal::Time at, const radio::Frame& frame, const Sent& sent);
  void on_group_frame_end(const radio::Frame& frame, const Sent& sent, hal::AgentId receiver,
                          hal::Verdict verdict);
  Attempts take_attempts(const radio::Msdu& msdu, const radio::MsduEnd& end);
  void count_second(hal::Time at, const Sent& sent, int sign);
  void on_whole(hal::Time at, hal::AgentId agent, const Datagram& datagram);
  bool complete(hal::AgentId agent, const DatagramPlace& place);

  Endpoints endpoints_;
  Contents contents_{endpoints_};
  AirAccounts accounts_;
  Samples samples_{endpoints_};
  std::vector<Station> stations_;  ///< By address.
  /// By radio::FrameType; the entry of data is for routing frames.
  std::vector<ContentPtr> of_types_;
  std::map<hal::AgentId, std::vector<Arriving>> arriving_;
  AirSecond second_;
  std::function<void(const AirSecond&)> on_second_;
};

}  // namespace sim::air
