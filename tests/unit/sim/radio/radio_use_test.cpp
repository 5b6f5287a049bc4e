#include "sim/radio/phy/radio_use.h"

#include <gtest/gtest.h>

#include "tests/unit/sim/radio/dcf.h"

namespace sim::radio::test {
namespace {

class RadioUseTest : public Ieee80211MacTest {
 protected:
  /// Of stations 1, 2, ... at a time.
  std::vector<RadioUse> use_at(hal::Duration time) {
    std::vector<RadioUse> use;
    air.at(time, [this, &use] {
      for (std::uint16_t station = 1; station <= air.size(); ++station)
        use.push_back(air.sap(station).use());
    });
    air.run();
    return use;
  }
};

void expect_use(const RadioUse& use, const RadioUse& expected) {
  EXPECT_EQ(use.transmitting, expected.transmitting);
  EXPECT_EQ(use.receiving, expected.receiving);
  EXPECT_EQ(use.listening, expected.listening);
  EXPECT_EQ(use.off, expected.off);
}

// The third hears the second only.
TEST_F(RadioUseTest, IsTheAirtimeOfTheFramesOfAnExchange) {
  build_line(3);
  air.at(5ms, [this] { air.send(1, 2, kPayload); });
  const auto use = use_at(900ms);
  ASSERT_EQ(air.log.story(), "DATA1 ACK2");
  ASSERT_EQ(use.size(), 3u);
  const hal::Duration data = kData, ack = kAck;
  expect_use(use[0], {data, ack, 900ms - data - ack, 0ms});
  expect_use(use[1], {ack, data, 900ms - data - ack, 0ms});
  expect_use(use[2], {0ms, ack, 900ms - ack, 0ms});
}

TEST_F(RadioUseTest, ARadioThatIsOffNeitherListensNorReceives) {
  build_line(2);
  air.at(100ms, [this] { air.sap(2).set_radio(false); });
  air.at(200ms, [this] { air.broadcast(1, kPayload); });
  air.at(400ms, [this] { air.sap(2).set_radio(true); });
  const auto use = use_at(900ms);
  EXPECT_GT(use[0].transmitting, 0ms);
  expect_use(use[1], {0ms, 0ms, 600ms, 300ms});
}

TEST_F(RadioUseTest, AFrameThatIsCutCountsAsFarAsItCame) {
  build_line(1);
  air.at(100ms, [this] { air.broadcast(1, kPayload); });
  air.at(100ms + 50us, [this] { air.sap(1).set_radio(false); });
  const auto use = use_at(900ms);
  expect_use(use[0], {50us, 0ms, 100ms, 800ms - 50us});
}

/// What a radio does from when on.
class Activities final : public RadioUseListener {
 public:
  explicit Activities(const EventQueue& events) : events_(events) {}
  void on_activity(RadioActivity activity) override { seen.emplace_back(events_.now(), activity); }

  std::vector<std::pair<hal::Time, RadioActivity>> seen;

 private:
  const EventQueue& events_;
};

TEST_F(RadioUseTest, IsToldToAListenerAtEachChange) {
  build_line(2);
  Activities sender(air.events), receiver(air.events);
  air.sap(1).set_use_listener(&sender);
  air.sap(2).set_use_listener(&receiver);
  air.at(5ms, [this] { air.send(1, 2, kPayload); });
  air.at(100ms, [this] { air.sap(2).set_radio(false); });
  air.at(200ms, [this] { air.sap(1).set_use_listener(nullptr); });
  air.at(300ms, [this] { air.sap(1).set_radio(false); });
  const auto use = use_at(900ms);
  air.sap(2).set_use_listener(nullptr);
  using enum RadioActivity;
  ASSERT_EQ(sender.seen.size(), 5u);
  EXPECT_EQ(sender.seen[0], std::pair(hal::Time{}, kListening));
  EXPECT_EQ(sender.seen[1].second, kTransmitting);
  EXPECT_EQ(sender.seen[2], std::pair(sender.seen[1].first + test::kData, kListening));
  EXPECT_EQ(sender.seen[3].second, kReceiving);
  EXPECT_EQ(sender.seen[4], std::pair(sender.seen[3].first + test::kAck, kListening));
  ASSERT_EQ(receiver.seen.size(), 6u);
  EXPECT_EQ(receiver.seen[1].second, kReceiving);
  EXPECT_EQ(receiver.seen[3].second, kTransmitting);
  EXPECT_EQ(receiver.seen[5], std::pair(hal::Time{100ms}, kOff));
}

// 64 bytes of payload + 36 of headers at 1 Mb/s: 800 us.
TEST(RadioUseOfADisk, IsTheAirtimeOfItsOwnFrames) {
  Air air(Profile::kDisk);
  std::get<DiskConfig>(air.config).data_rate = hal::BitsPerSecond{1e6};
  air.add_line(2, 200);
  air.build();
  air.send(1, 2, 64);
  air.send(1, 2, 64);
  air.at(500ms, [&air] { air.sap(2).set_radio(false); });
  std::vector<RadioUse> use;
  air.at(900ms, [&] { use = {air.sap(1).use(), air.sap(2).use()}; });
  air.run();
  expect_use(use.at(0), {1600us, 0ms, 900ms - 1600us, 0ms});
  expect_use(use.at(1), {0ms, 0ms, 500ms, 400ms});
}

}  // namespace
}  // namespace sim::radio::test
