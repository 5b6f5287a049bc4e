#include "view/server/export.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "tests/unit/view/server/small_result.h"

namespace view::server::test {
namespace {

constexpr const char* kEmptyPage =
    "<html><head><meta charset=\"utf-8\"></head><script>page()</script></html>";

class Export : public testing::Test {
 protected:
  Export() : result(testing::UnitTest::GetInstance()->current_test_info()->name()) {
    result.recorder->on_state(Time{1s}, AgentId{1}, "</script><b>");
    result.end(100'000'000'000);
    // So many that only tiles of 8.6 s have them all.
    result.execute(
        "WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL SELECT i + 1 FROM n WHERE i < 19999)"
        " INSERT INTO queues SELECT 1, i * 5000000, i % 7 FROM n");
  }

  ExportedPage page(std::size_t most) const {
    std::vector<std::unique_ptr<server::Run>> runs;
    runs.push_back(std::make_unique<server::Run>(result.path()));
    return export_page(ViewApi(std::move(runs), ViewApi::Mode::kReplay, false), kEmptyPage, most);
  }

  static json tiles_of(const std::string& html) {
    const std::string begin = "<script>window.BARAKA_TILES = ";
    const std::size_t at = html.find(begin) + begin.size();
    return json::parse(html.substr(at, html.find(";</script>", at) - at));
  }

  SmallResult result;
};

TEST_F(Export, HasAllAnswersThatThePageAsksFor) {
  const ExportedPage exported = page(64'000'000);
  EXPECT_EQ(exported.finest, 0);
  const json tiles = tiles_of(exported.html);
  for (const char* address :
       {"/api/view", "/api/runs/0/world", "/api/runs/0/coverage", "/api/runs/0/routes/3",
        "/api/runs/0/totals/1", "/api/runs/0/poses/13/0", "/api/runs/0/states/13/0"}) {
    EXPECT_TRUE(tiles.contains(address)) << address;
  }
  EXPECT_EQ(tiles["/api/runs/0/states/13/0"]["columns"]["state"][0], "</script><b>");
  // From the tile of 550 s that holds the run to those that have every row.
  EXPECT_FALSE(tiles["/api/runs/0/queues/13/0"]["complete"]);
  EXPECT_FALSE(tiles["/api/runs/0/queues/12/1"]["columns"]["at"].empty());
  std::size_t rows = 0;
  for (const auto& [address, tile] : tiles.items()) {
    if (!address.starts_with("/api/runs/0/queues/") || !tile["complete"]) continue;
    for (const json& at : tile["columns"]["at"]) rows += at >= tile["from"] ? 1 : 0;
  }
  EXPECT_EQ(rows, 20'000U);
}

TEST_F(Export, StandsBeforeThePagesOwnScriptAndEndsItNowhereElse) {
  const std::string html = page(64'000'000).html;
  EXPECT_LT(html.find("charset"), html.find("BARAKA_TILES"));
  EXPECT_LT(html.find("BARAKA_TILES"), html.find("page()"));
  std::size_t ends = 0;
  for (std::size_t at = html.find("</script>"); at != std::string::npos;
       at = html.find("</script>", at + 1)) {
    ++ends;
  }
  EXPECT_EQ(ends, 2U);
}

TEST_F(Export, LeavesTheFinestOutAndSaysSo) {
  const ExportedPage exported = page(20'000);
  EXPECT_EQ(exported.finest, std::int64_t{1} << 36);  // what is in 68.7 s is a summary
  const json tiles = tiles_of(exported.html);
  EXPECT_TRUE(tiles.contains("/api/runs/0/queues/12/0"));
  EXPECT_FALSE(tiles.contains("/api/runs/0/queues/11/0"));
  EXPECT_THROW(page(100), std::runtime_error);
}

}  // namespace
}  // namespace view::server::test
