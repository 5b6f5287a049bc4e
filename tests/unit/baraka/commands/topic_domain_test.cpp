#include "baraka/commands/topic_domain.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "gateway/inspection/inspection_participant.h"
#include "gateway/process/domains.h"
#include "gateway/process/exit_status.h"
#include "tests/support/test_domain.h"

namespace baraka::commands {
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
  } catch (const gateway::process::UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "runs or daemons show topics in the domains 4, 9: choose one by --domain N");
  }
  EXPECT_EQ(chosen_domain(9, hints), 9);
}

TEST(TopicDomain, ThatAVariableHasWronglyIsNamed) {
  for (const char* wrong : {"x", "233", "-1", "1 ", ""}) {
    EXPECT_THROW(chosen_domain({}, {.baraka = wrong, .shown = {}, .ros = {}}),
                 gateway::process::NoSuchDomain);
    EXPECT_THROW(chosen_domain({}, {.baraka = {}, .shown = {}, .ros = wrong}),
                 gateway::process::NoSuchDomain);
  }
}

TEST(TopicDomain, IsFoundWhereTopicsAreShownAndNotWhereControllersMeet) {
  const int domain = test_domain();
  const auto is_found = [domain] {
    return std::ranges::count(gateway::process::domains_shown_by(::geteuid()), domain) == 1;
  };
  const auto hold = gateway::process::join_domain(domain);
  EXPECT_FALSE(is_found());
  {
    const gateway::inspection::InspectionParticipant participant({.domain = domain});
    EXPECT_TRUE(is_found());
    EXPECT_EQ(std::ranges::count(gateway::process::domains_shown_by(::geteuid() + 1), domain), 0);
  }
  EXPECT_FALSE(is_found());
}

}  // namespace
}  // namespace baraka::commands
