#include "baraka/run/domain_range.h"

#include <gtest/gtest.h>

#include "gateway/process/exit_status.h"

namespace baraka::run {
namespace {

TEST(DomainRange, ASingleDomainIsTheFirstOfAsManyAsThereAreJobs) {
  EXPECT_EQ(domains_for("7", 3), (std::vector<int>{7, 8, 9}));
  EXPECT_EQ(domains_for("7-9", 2), (std::vector<int>{7, 8, 9}));
  EXPECT_TRUE(domains_for("", 3).empty());
}

TEST(DomainRange, TooFewAndTooHighOnesAreRefused) {
  EXPECT_THROW(domains_for("7-8", 3), gateway::process::UsageError);
  EXPECT_THROW(domains_for("230", 5), gateway::process::UsageError);
}

TEST(DomainRange, WhatIsNoRangeIsSeen) {
  for (const char* good : {"0", "7", "7-7", "7-9"}) EXPECT_TRUE(is_domain_range(good)) << good;
  for (const char* bad : {"", "-1", "x", "7-", "9-7", "7-9-11", "7 ", "1.5"}) {
    EXPECT_FALSE(is_domain_range(bad)) << bad;
  }
}

}  // namespace
}  // namespace baraka::run
