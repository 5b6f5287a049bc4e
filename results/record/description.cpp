#include "results/record/description.h"

#include <fmt/format.h>

#include "results/record/schema.h"

namespace results::record {
namespace {

constexpr const char* kFolder = R"(# Results

`baraka run` writes a folder: `results/<scenario>`, or what `--out` says, and names it at its end
(`results: DIR`).

| file | what it is |
| --- | --- |
| `run.sqlite` | the tables below |
| `scenario.resolved.yaml` | the scenario as it was run, includes and defaults written out; runs again by itself |
| `run.log` | log lines, stamped with simulated time |
| `<name>.pcapng` | frames as on the air, with `record: {air: <name>.pcapng}`; see below |
| `<process>.log` | what a controller process printed |
| `.baraka-result` | the marker: id of the run, and every file that it may write there |

Until a run has begun (all controllers are there), its folder is `DIR.not-started`; so it stays
called if the run never begins, with the error in the table `run` and the controllers' words in
their logs. A run that begins gets `DIR`, and an earlier result there is kept as `DIR.1`, then
`DIR.2` and so on, the oldest first; `--overwrite` removes it instead, once the new one has begun.
Folders are renamed as a whole, so whenever a run is killed, each is complete. A run moves and
removes only what the marker in a folder names: a folder with anything else in it, or without a
marker, is refused (exit status 2) and stays as it is. Beside the folder, `.DIR.lock` is held while
a run writes there; a second run is refused meanwhile. `DIR` must lie in a folder that can be
written, and no file system may be mounted on it.

A run that failed says so (`result`, `error` in the table `run`), also on a disk that has filled up:
`.reserve` keeps room for that and is gone afterwards. One that was killed still says `running`;
`baraka report` and `baraka export` call it unfinished.

A capture (pcapng, link type radiotap, times in nanoseconds since the start of the run) holds every
frame that is sent, once, as an ear would hear it that is everywhere and loses none; or, with
`air_heard_by: AGENT`, what that agent's radio sends and receives, addressed to it or not. The time
of a packet is when the last bit of its frame was there, radiotap's TSFT when the first bit of the
MPDU was there (us, rounded down). Frames broken off by a radio that is switched off, or in the air
at the end, are not in it, nor what the agent lost: every FCS is right. Bytes are those of the
frame (IEEE 802.11, LLC/SNAP, FCS), also where `lengths: fixed` makes it longer or shorter on the
air. Agent hhll has the MAC address 02:00:00:00:hh:ll. A second run writes the same bytes.

    tshark -r DIR/air.pcapng -Y 'wlan.fc.retry == 1'     the retries

With `--replications`, `DIR` holds `replications.yaml` (what was asked for), a folder like the above
for each, `replication-01` and so on, what each printed, `replication-01.log`, and all of them as
numbers, `campaign.sqlite` (campaign_tables.md).

)";

constexpr const char* kReading = R"(## Reading them

    baraka report DIR...              tables for people; -o PAGE.html draws figures
    baraka export DIR                 lists the tables of a result
    baraka view DIR...                world, network and time in a browser (view.md)
    baraka export DIR TABLE           one table as CSV (RFC 4180); -o FILE writes it to a file
    baraka export DIR --format csv -o FOLDER      all of them
    baraka export DIR --format mcap -o FILE       for Foxglove, PlotJuggler and RViz (viewers.md)
    baraka export --describe          this page
    sqlite3 DIR/run.sqlite .schema    the tables with these meanings as comments

The report pools runs only if their settings are the same but for the seed; it lists the settings in
which its columns differ. `compare: labella2009` of a scenario asks for the figures of that paper beside
those of the runs; they are shown if the runs are of its case study (equal in all settings but name,
seed, radio, record, expect and number of processes), else it says why not. Settings that were varied
make up an experiment: means over the runs of each with their intervals (docs/statistics.md), as
`report:` of the scenario asks, in tables, on the page, or with `--figure NAME -o FILE.svg` one of them.
Of a folder of results it takes all but those put aside: `NAME.1` beside `NAME`, `NAME.not-started`.

Which agent did something else first in another run, of what kind, and in which second:

    sqlite3 DIR/run.sqlite "ATTACH 'OTHER/run.sqlite' AS o; SELECT second, part, agent FROM (SELECT
      * FROM (SELECT * FROM fingerprints EXCEPT SELECT * FROM o.fingerprints) UNION SELECT * FROM
      (SELECT * FROM o.fingerprints EXCEPT SELECT * FROM fingerprints)) ORDER BY 1, 2, 3 LIMIT 1"

In CSV, the first line names the columns, a null is an empty field, an empty text is `""`, and
numbers are in the shortest form that reads back to the same bits. A text that a spreadsheet could
take for a formula has a `'` before it: it begins with `=`, `+`, `-`, `@`, a tab or a line end, and is
not made of numbers, `-` and units only, as `-85 dBm` is.

A result may come from somebody else. `baraka` reads it only if its tables are those of this version,
and of every cell that it takes from them it checks the type and the range: agents are in the table
`agents`, times are not after the end of the run, which is below 32 years, lengths are up to 1e12 m,
counts up to 2^53, names up to 64 KiB and other texts up to 16 MiB. What is not is refused with file,
table, row and column; of cells that are only summed, the sum is looked at. What is counted may still
be a lie: who can write the file can write any plausible number.

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

}  // namespace results::record
