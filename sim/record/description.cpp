#include "sim/record/description.h"

#include <fmt/format.h>

#include "sim/record/schema.h"

namespace sim::record {
namespace {

constexpr const char* kFolder = R"(# Results

`baraka run` writes a folder: `results/<scenario>`, or what `--out` says, and names it at its end
(`results: DIR`).

| file | what it is |
| --- | --- |
| `run.sqlite` | the tables below |
| `scenario.resolved.yaml` | the scenario as it was run, includes and defaults written out; runs again by itself |
| `run.log` | log lines, stamped with simulated time |
| `<process>.log` | what a controller process printed |
| `.baraka-result` | the marker: id of the run, and every file that it writes there |

)";

constexpr const char* kReading = R"(## Reading them

    baraka report DIR...              tables for people; -o PAGE.html draws figures
    baraka export DIR                 lists the tables of a result
    baraka export DIR TABLE           one table as CSV (RFC 4180); -o FILE writes it to a file
    baraka export --describe          this page
    sqlite3 DIR/run.sqlite .schema    the tables with these meanings as comments

In CSV, the first line names the columns, a null is an empty field, an empty text is `""`, and
numbers are in the shortest form that reads back to the same bits.

)";

std::string cell(std::string_view text) { return std::string(text.empty() ? "-" : text); }

}  // namespace

std::string describe_results() {
  std::string text = kFolder;
  text += kReading;
  text += fmt::format(
      "## Tables\n\nVersion {} (`PRAGMA user_version`); readers accept this one only.\n\n{}\n",
      kSchemaVersion, conventions());
  for (const Table& table : tables()) {
    text += fmt::format(
        "\n### {}\n\n{}{}.\n\n| column | type | unit | meaning |\n"
        "| --- | --- | --- | --- |\n",
        table.name, table.meaning,
        table.primary_key.empty() ? "" : fmt::format("; one row per ({})", table.primary_key));
    for (const Column& column : table.columns) {
      text += fmt::format("| `{}` | {} | {} | {} |\n", column.name, cell(column.type),
                          cell(column.unit), column.meaning);
    }
  }
  text += "\n## Keys of the table run\n\n| key | unit | meaning |\n| --- | --- | --- |\n";
  for (const RunKey& key : run_keys()) {
    text += fmt::format("| `{}` | {} | {} |\n", key.name, cell(key.unit), key.meaning);
  }
  return text;
}

}  // namespace sim::record
