#include "gateway/commands/topic_domain.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "gateway/exit_status.h"
#include "hal/dds/domains.h"
#include "hal/dds/inspection/inspection_participant.h"
#include "tests/support/test_domain.h"

namespace gateway {
namespace {

TEST(TopicDomain, IsTheFirstThatIsTold) {
  DomainHints hints{.baraka = "3", .shown = {4}, .ros = "5"};
  EXPECT_EQ(chosen_domain(2, hints), 2);
  EXPECT_EQ(chosen_domain({}, hints), 3);
  hints.baraka.reset();
  EXPECT_EQ(chosen_domain({}, hints), 4);
  hints.shown.clear();
  EXPECT_EQ(chosen_domain({}, hints), 5);
  hints.ros.reset();
  EXPECT_EQ(chosen_domain({}, hints), 1);
}

TEST(TopicDomain, OfSeveralRunsIsAsked) {
  const DomainHints hints{.baraka = {}, .shown = {4, 9}, .ros = "5"};
  try {
    chosen_domain({}, hints);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "runs or daemons show topics in the domains 4, 9: choose one by --domain N");
  }
  EXPECT_EQ(chosen_domain(9, hints), 9);
}

TEST(TopicDomain, ThatAVariableHasWronglyIsNamed) {
  for (const char* wrong : {"x", "233", "-1", "1 ", ""}) {
    EXPECT_THROW(chosen_domain({}, {.baraka = wrong, .shown = {}, .ros = {}}),
                 hal::dds::NoSuchDomain);
    EXPECT_THROW(chosen_domain({}, {.baraka = {}, .shown = {}, .ros = wrong}),
                 hal::dds::NoSuchDomain);
  }
}

TEST(TopicDomain, IsFoundWhereTopicsAreShownAndNotWhereControllersMeet) {
  const int domain = test_domain();
  const auto is_found = [domain] {
    return std::ranges::count(hal::dds::domains_shown_by(::geteuid()), domain) == 1;
  };
  const auto hold = hal::dds::join_domain(domain);
  EXPECT_FALSE(is_found());
  {
    const hal::dds::InspectionParticipant participant({.domain = domain});
    EXPECT_TRUE(is_found());
    EXPECT_EQ(std::ranges::count(hal::dds::domains_shown_by(::geteuid() + 1), domain), 0);
  }
  EXPECT_FALSE(is_found());
}

}  // namespace
}  // namespace gateway
