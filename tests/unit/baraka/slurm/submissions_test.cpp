#include "baraka/slurm/submissions.h"

#include <gtest/gtest.h>

#include <map>

namespace baraka::slurm {
namespace {

using Table = std::map<std::string, std::string, std::less<>>;

Notes notes_in(Table& table) {
  return {.value =
              [&table](std::string_view key) {
                const auto found = table.find(key);
                return found == table.end() ? std::string{} : found->second;
              },
          .set = [&table](std::string_view key,
                          std::string_view value) { table[std::string(key)] = value; }};
}

TEST(SlurmSubmissions, AreFoundAgainByWhoeverComesAfter) {
  Table table;
  {
    Submissions first(notes_in(table));
    EXPECT_TRUE(first.names().empty());
    first.add(1);
    first.set_job(12);
    first.add(1001);  // and killed before sbatch answered
  }
  const Submissions second(notes_in(table));
  ASSERT_EQ(second.all().size(), 2U);
  EXPECT_EQ(second.all()[0].job, 12);
  EXPECT_EQ(second.all()[1].job, std::nullopt);
  EXPECT_EQ(second.all()[1].first, 1001);
  EXPECT_EQ(second.names().size(), 2U);
  EXPECT_EQ(second.named(second.all()[1].name)->first, 1001);
  EXPECT_EQ(second.named("baraka-x-1"), nullptr);
}

TEST(SlurmSubmissions, NamesOfTwoCampaignsDiffer) {
  Table one, other;
  Submissions first(notes_in(one)), second(notes_in(other));
  EXPECT_NE(first.add(1).name, second.add(1).name);
}

TEST(SlurmSubmissions, AStrangeNoteIsAnErrorThatShowsIt) {
  Table table{{"slurm.1", "what"}};
  try {
    const Submissions submissions(notes_in(table));
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "slurm.1: 'what' notes no job of Slurm");
  }
}

}  // namespace
}  // namespace baraka::slurm
