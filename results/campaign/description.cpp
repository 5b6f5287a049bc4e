#include "results/campaign/description.h"

#include <fmt/format.h>

#include <string_view>

#include "results/campaign/schema.h"

namespace results::campaign {
namespace {

constexpr const char* kIntroduction = R"(# What is in campaign.sqlite

<!-- Written by `baraka export DIR --describe`, DIR being a campaign's; the texts are in
     results/campaign/tables.cpp. -->

The file to which a campaign writes its results (docs/campaigns.md). It contains a run completely or
not at all, and can be read while the campaign runs.

    baraka export DIR                  lists the tables
    baraka export DIR runs             one table as CSV (RFC 4180); -o FILE writes it to a file
    sqlite3 DIR/campaign.sqlite .schema

One number per run with the values that were varied, here the delivery ratio:

    sqlite3 -csv -header DIR/campaign.sqlite "SELECT label, replication, seed, value FROM
      measurements JOIN observables USING (observable) JOIN runs USING (run) JOIN points USING (point)
      WHERE name = 'messages.delivery_ratio' ORDER BY point, replication"

)";

std::string cell_of(std::string_view text) { return std::string(text.empty() ? "-" : text); }

}  // namespace

std::string describe_campaign() {
  std::string text = kIntroduction;
  text += fmt::format("Version {} (`PRAGMA user_version`); readers accept this one only.\n",
                      kSchemaVersion);
  for (const record::Table& table : tables()) {
    text += fmt::format(
        "\n## {}\n\n{}{}.\n\n| column | type | unit | meaning |\n"
        "| --- | --- | --- | --- |\n",
        table.name, table.meaning,
        table.primary_key.empty() ? "" : fmt::format("; one row per ({})", table.primary_key));
    for (const record::Column& column : table.columns) {
      text += fmt::format("| `{}` | {} | {} | {} |\n", column.name, cell_of(column.type),
                          cell_of(column.unit), column.meaning);
    }
  }
  text += "\n## Keys of the table campaign\n\n| key | meaning |\n| --- | --- |\n";
  for (const record::RunKey& key : campaign_keys()) {
    text += fmt::format("| `{}` | {} |\n", key.name, key.meaning);
  }
  return text;
}

}  // namespace results::campaign
