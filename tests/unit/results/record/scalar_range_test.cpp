#include <gtest/gtest.h>

#include "results/record/scalars.h"

namespace results::record {
namespace {

TEST(ScalarRange, IsToldByTheName) {
  EXPECT_EQ(range_of("requests.retry_limit"), Range::kCount);
  EXPECT_EQ(range_of("topics.help.sent"), Range::kCount);
  EXPECT_EQ(range_of("topics.help.delay.mean"), Range::kNotNegative);
  EXPECT_EQ(range_of("messages.delivery_ratio"), Range::kShare);
  EXPECT_EQ(range_of("use.off"), Range::kShare);
  EXPECT_EQ(range_of("messages.transmissions.mean"), Range::kNotNegative);
  EXPECT_EQ(range_of("controllers.gap.mean"), Range::kAny);
  EXPECT_EQ(range_of("controllers.gap.count"), Range::kCount);
  EXPECT_EQ(range_of("agents.x.mean"), Range::kAny);
  EXPECT_EQ(range_of("agents.x.sd"), Range::kNotNegative);
  EXPECT_EQ(range_of("agents.battery.last"), Range::kShare);
  EXPECT_EQ(range_of("radio.queue"), Range::kNotNegative);
  EXPECT_EQ(range_of("radio.rssi.mean"), Range::kAny);
  EXPECT_EQ(scalar_kind_of("frames.sent")->name, "frames.sent");
  EXPECT_EQ(scalar_kind_of("frames.ack")->name, "frames.CLASS");
  EXPECT_EQ(scalar_kind_of("frames.ack.mean"), nullptr);
  EXPECT_TRUE(scalar_kind_of("topics.help.sent")->is_open);
  for (const ScalarKind& kind : scalar_kinds()) {
    if (kind.trials.empty()) continue;
    EXPECT_EQ(range_of(kind.trials), Range::kCount) << kind.name;
  }
}

}  // namespace
}  // namespace results::record
