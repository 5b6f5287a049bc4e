#include "sim/radio/mac/recipient_agreement.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

ReceivedMpdu mpdu(std::uint16_t sequence) {
  auto frame = std::make_shared<Frame>();
  frame->sequence = sequence;
  return {std::move(frame), {}, {}, hal::Time{}};
}

std::string numbers(const std::vector<ReceivedMpdu>& released) {
  std::string text;
  for (const ReceivedMpdu& one : released) {
    text += (text.empty() ? "" : " ") + std::to_string(one.frame->sequence);
  }
  return text;
}

// IEEE Std 802.11-2020, 10.25.6.6.
TEST(RecipientAgreement, PassesOnInOrderAndDropsDuplicates) {
  RecipientAgreement agreement(4094, 4);
  EXPECT_EQ(numbers(agreement.accept(mpdu(4095))), "");
  EXPECT_TRUE(agreement.waiting_since());
  EXPECT_EQ(numbers(agreement.accept(mpdu(4095))), "") << "twice";
  EXPECT_EQ(numbers(agreement.accept(mpdu(4094))), "4094 4095");
  EXPECT_EQ(numbers(agreement.accept(mpdu(4094))), "") << "old";
  EXPECT_EQ(numbers(agreement.accept(mpdu(0))), "0");
  EXPECT_FALSE(agreement.waiting_since());
}

TEST(RecipientAgreement, MovesItsWindowByWhatLiesBeyondIt) {
  RecipientAgreement agreement(10, 4);
  EXPECT_EQ(numbers(agreement.accept(mpdu(11))), "");
  EXPECT_EQ(numbers(agreement.accept(mpdu(15))), "11") << "12 .. 15 is the window now";
  EXPECT_EQ(numbers(agreement.accept(mpdu(10))), "") << "given up";
  EXPECT_EQ(numbers(agreement.move_to(14)), "") << "a BlockAckReq";
  EXPECT_EQ(numbers(agreement.accept(mpdu(14))), "14 15");
}

TEST(RecipientAgreement, SkipsAGap) {
  RecipientAgreement agreement(0, 64);
  (void)agreement.accept(mpdu(2));
  (void)agreement.accept(mpdu(3));
  (void)agreement.accept(mpdu(5));
  EXPECT_EQ(numbers(agreement.skip_gap()), "2 3");
  EXPECT_EQ(numbers(agreement.skip_gap()), "5");
}

TEST(RecipientAgreement, ScoresWhatItHasReceived) {
  RecipientAgreement agreement(4000, 64);
  for (const int number : {4000, 4002, 4070}) agreement.score(static_cast<std::uint16_t>(number));
  const BlockAckFields said = agreement.block_ack(5);
  EXPECT_EQ(said.tid, 5);
  EXPECT_EQ(said.start, 4070 - 63);
  EXPECT_EQ(said.length, 64U);
  EXPECT_EQ(said.received.count(), 1U);
  EXPECT_TRUE(said.received[63]);
  RecipientAgreement large(0, 256);
  EXPECT_EQ(large.block_ack(0).length, 256U);
}

/// When the third of three MPDUs is passed on, whose second is never sent again.
hal::Duration third_after(hal::Duration timeout) {
  Air air(Profile::kIeee80211n);
  dcf_of(air.config)->aggregation.reorder_timeout = timeout;
  air.add_line(2, 30);
  air.build();
  air.send(1, 2, 100);
  air.at(100ms, [&air] {
    for (int i = 0; i < 3; ++i) air.send(1, 2, 100);
  });
  air.at(100ms + 60us, [&air] {  // during the second
    air.network->interfere({{30, 1, 0}, hal::Milliwatts{100}, std::nullopt, 5us});
  });
  air.at(100ms + 150us, [&air] { air.sap(1).set_radio(false); });  // after the BlockAck
  air.run(2s);
  const auto& received = air.inbox(2).received;
  EXPECT_EQ(received.size(), 3U);
  return received.back().at - received.at(1).at;
}

TEST(Recipient, WaitsForAMissingMpduAsLongAsItsTimeout) {
  EXPECT_EQ(third_after(100ms), 100ms);
  EXPECT_EQ(third_after(7ms), 7ms);
}

std::vector<hal::Verdict> verdicts_of(Air& air) {
  std::vector<hal::Verdict> all;
  for (const Inbox::Ended& one : air.inbox(1).ended) all.push_back(one.verdict);
  return all;
}

/// The receiver goes off after an agreement; then three MSDUs are sent.
std::vector<hal::Verdict> to_one_that_is_off(std::optional<hal::Duration> lifetime) {
  Air air(Profile::kIeee80211n);
  dcf_of(air.config)->msdu_lifetime = lifetime;
  air.add_line(2, 30);
  air.build();
  air.send(1, 2, 100);
  air.at(100ms, [&air] {
    air.sap(2).set_radio(false);
    for (int i = 0; i < 3; ++i) air.send(1, 2, 100);
  });
  air.run(2s);
  return verdicts_of(air);
}

TEST(Originator, GivesUpWhatNobodyAcknowledges) {
  using enum hal::Verdict;
  EXPECT_EQ(to_one_that_is_off({}),
            (std::vector{kDelivered, kRetryLimit, kRetryLimit, kRetryLimit}));
  EXPECT_EQ(to_one_that_is_off(1ms), (std::vector{kDelivered, kExpired, kExpired, kExpired}));
}

// The receiver's radio was off: it has forgotten the agreement and says so by a DELBA.
TEST(Originator, SendsOneByOneWhenTheAgreementIsForgotten) {
  Air air(Profile::kIeee80211n);
  air.add_line(2, 30);
  air.build();
  air.send(1, 2, 100);
  air.at(50ms, [&air] { air.sap(2).set_radio(false); });
  air.at(51ms, [&air] { air.sap(2).set_radio(true); });
  air.at(100ms, [&air] {
    for (int i = 0; i < 3; ++i) air.send(1, 2, 100);
  });
  air.at(400ms, [&air] {
    for (int i = 0; i < 3; ++i) air.send(1, 2, 100);
  });
  air.run(2s);
  EXPECT_EQ(verdicts_of(air), std::vector(7, hal::Verdict::kDelivered));
  EXPECT_EQ(air.inbox(2).received.size(), 7U);
  EXPECT_EQ(air.log.starts.back().frame.type, FrameType::kBlockAck) << "they have agreed again";
}

// The answer to the first request is lost, as station 2 goes off; the next request comes with the
// first data after 200 ms.
TEST(Originator, AsksAgainAfter200ms) {
  Air air(Profile::kIeee80211n);
  air.add_line(2, 30);
  air.build();
  std::vector<hal::Duration> asked;
  for (int i = 0; i < 40; ++i) air.at(i * 10ms, [&air] { air.send(1, 2, 100); });
  air.at(160us, [&air] { air.sap(2).set_radio(false); });
  air.at(5ms, [&air] { air.sap(2).set_radio(true); });
  air.run(1s);
  for (const Log::Start& one : air.log.starts) {
    const Frame& frame = one.frame;
    if (frame.type == FrameType::kAction && frame.transmitter.value == 1 && !frame.retry) {
      asked.push_back(one.at.time_since_epoch());
    }
  }
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_LT(asked[0], 1ms);
  EXPECT_GE(asked[1] - asked[0], 200ms);
  EXPECT_LT(asked[1] - asked[0], 215ms);
}

/// How long after the end of a frame of station 1 that nobody answers a station sends, whose own
/// broadcast came during the frame. It is 250 m away: below the energy thresholds, above that of
/// carrier sense.
hal::Duration waits_after(Standard standard) {
  Air air(Profile::kIeee80211n);
  DcfConfig& dcf = *dcf_of(air.config);
  dcf.propagation.propagation_delay = false;
  dcf.aggregation.max_ampdu = 0;
  dcf.protection = ProtectionKind::kNone;
  dcf.contention.short_retry_limit = 1;
  dcf.contention.cw_min = 0;
  dcf.contention.cw_max = 0;
  for (AccessParameters& one : dcf.edca.categories) one.cw_min = one.cw_max = 0;
  air.add_line(2, 5);
  air.add({250, 0, 0});
  air.station_config(3).standard = standard;
  air.build();
  air.sap(2).set_radio(false);
  air.send(1, 2, 1000);
  air.at(50us, [&air] { air.broadcast(3, 10); });
  air.run(10ms);
  EXPECT_EQ(air.log.starts.size(), 2U);
  const Log::Start& data = air.log.starts.at(0);
  EXPECT_EQ(data.frame.mode->modulation_class(), ModulationClass::kHt);
  return air.log.starts.at(1).at - (data.at + data.frame.airtime);
}

// A station of 802.11g hears preamble and L-SIG of an HT frame: it keeps quiet to the end and then
// waits for EIFS: SIFS, an ACK at 1 Mb/s, DIFS. One of 802.11b hears no such frame, and sends in
// it.
TEST(Capabilities, OlderStationsDeferToFramesWhosePreambleTheyHear) {
  EXPECT_EQ(waits_after(Standard::kIeee80211g), 10us + 304us + 28us);
  EXPECT_LT(waits_after(Standard::kIeee80211b), 0us);
}

// Table 10-1 and table 9-155: from the end of a frame to that of SIFS, AIFSN slots and no backoff.
TEST(Edca, EachUserPriorityWaitsForTheAifsOfItsCategory) {
  constexpr std::array<int, 8> kAifsn{3, 7, 7, 3, 2, 2, 2, 2};
  constexpr hal::Duration kSifsOfG = 10us, kSlotOfG = 20us;
  for (std::uint8_t priority = 0; priority < 8; ++priority) {
    Air air(Profile::kIeee80211g);
    DcfConfig& dcf = *dcf_of(air.config);
    dcf.propagation.propagation_delay = false;
    dcf.qos = true;
    for (AccessParameters& one : dcf.edca.categories) one.cw_min = one.cw_max = 0;
    air.add_line(2, 30);
    air.build();
    air.broadcast(2, 100);
    air.at(50us, [&air, priority] {
      air.sap(1).transmit({.destination = hal::AgentId{2},
                           .priority = priority,
                           .payload = std::make_shared<const hal::Bytes>(100)});
    });
    air.run(10ms);
    const hal::Duration end =
        air.log.starts.at(0).at.time_since_epoch() + air.log.starts.at(0).frame.airtime;
    EXPECT_EQ(air.log.starts.at(1).at.time_since_epoch() - end,
              kSifsOfG + kAifsn.at(priority) * kSlotOfG)
        << int{priority};
    EXPECT_EQ(air.log.starts.at(1).frame.priority, priority);
  }
}

}  // namespace
}  // namespace sim::radio::test
