#include "hal/types/payload.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

namespace {

using namespace std::chrono_literals;
using hal::Bytes;
using hal::PayloadReader;
using hal::PayloadWriter;

enum class Doing : std::uint16_t { kDriving = 0x0102 };

TEST(Payload, HasTheLeastSignificantOctetFirstAndNoPadding) {
  EXPECT_EQ(PayloadWriter()
                .put(std::uint8_t{0xff})
                .put(std::uint32_t{0x01020304})
                .put(Doing::kDriving)
                .put(hal::AgentId{0xabcd})
                .put(true)
                .bytes(),
            (Bytes{0xff, 4, 3, 2, 1, 2, 1, 0xcd, 0xab, 1}));
  // 1.5 = 0x3ff8000000000000, IEEE 754.
  EXPECT_EQ(PayloadWriter().put(1.5).bytes(), (Bytes{0, 0, 0, 0, 0, 0, 0xf8, 0x3f}));
  EXPECT_EQ(PayloadWriter().put("hi").bytes(), (Bytes{2, 0, 'h', 'i'}));
}

TEST(Payload, GivesBackWhatWasPut) {
  const Bytes bytes = hal::PayloadWriter()
                          .put(std::numeric_limits<std::int64_t>::min())
                          .put(std::int8_t{-1})
                          .put(-0.0)
                          .put(std::numeric_limits<float>::denorm_min())
                          .put(hal::Time{5s})
                          .put(hal::Duration{-7ns})
                          .put("")
                          .put(false)
                          .bytes();
  PayloadReader in(bytes);
  EXPECT_EQ(in.get<std::int64_t>(), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(in.get<std::int8_t>(), -1);
  EXPECT_TRUE(std::signbit(in.get<double>()));
  EXPECT_EQ(in.get<float>(), std::numeric_limits<float>::denorm_min());
  EXPECT_EQ(in.get<hal::Time>(), hal::Time{5s});
  EXPECT_EQ(in.get<hal::Duration>(), -7ns);
  EXPECT_EQ(in.text(), "");
  EXPECT_FALSE(in.ended_well()) << "one octet is left";
  EXPECT_FALSE(in.get<bool>());
  EXPECT_TRUE(in.ended_well());
}

TEST(Payload, TellsWhenTheBytesAreAnotherMessages) {
  const Bytes three{1, 2, 3};
  PayloadReader shorter(three);
  EXPECT_EQ(shorter.get<std::uint32_t>(), 0x030201U);
  EXPECT_FALSE(shorter.ended_well());
  const Bytes announces_more{9, 0, 'h', 'i'};
  PayloadReader text(announces_more);
  EXPECT_EQ(text.text(), "hi");
  EXPECT_FALSE(text.ended_well());
  const Bytes no_bool{2};
  PayloadReader flag(no_bool);
  EXPECT_FALSE(flag.get<bool>());
  EXPECT_FALSE(flag.ended_well());
}

}  // namespace
