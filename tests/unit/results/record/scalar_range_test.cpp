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
  EXPECT_EQ(range_of("dds.rt/r0/scan.latency.p95"), Range::kNotNegative);
  EXPECT_EQ(range_of("dds.rt/r0/scan.delivered_share"), Range::kShare);
  EXPECT_EQ(range_of("dds.rt/r0/scan.delivered_share.mean"), Range::kShare);
  EXPECT_EQ(range_of("dds.rt/r0/scan.lost.queue_full"), Range::kCount);
  EXPECT_EQ(range_of("dds.rt/r0/scan.age.max"), Range::kNotNegative);
  EXPECT_EQ(scalar_kind_of("dds.scan.lost.queue_full")->name, "dds.TOPIC.lost.VERDICT");
  EXPECT_EQ(scalar_kind_of("dds.scan.lost"), nullptr);
  EXPECT_EQ(scalar_kind_of("dds.scan.latency"), nullptr);
  EXPECT_EQ(trials_of("dds.rt/r0/scan.first_try_share"), "dds.rt/r0/scan.samples");
  EXPECT_EQ(trials_of("messages.delivery_ratio"), "messages.sent");
  EXPECT_EQ(trials_of("dds.rt/r0/scan.samples"), "");
  for (const ScalarKind& kind : scalar_kinds()) {
    if (kind.trials.empty()) continue;
    EXPECT_EQ(range_of(kind.trials), Range::kCount) << kind.name;
  }
}

}  // namespace
}  // namespace results::record
