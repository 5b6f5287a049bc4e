#include "results/record/description.h"

#include <fmt/format.h>

#include "results/record/schema.h"

namespace results::record {
namespace {

constexpr const char* kFolder = R"(# Results

`baraka run` writes a folder, `results/<scenario>` unless `--out` names another one, and prints its
name at the end (`results: DIR`).

| file | what it is |
| --- | --- |
| `run.sqlite` | the tables below |
| `scenario.resolved.yaml` | the scenario that was run, with includes and defaults written out; it can be run by itself |
| `run.log` | log lines with simulated time |
| `<name>.pcapng` | the frames on the air, with `record: {air: <name>.pcapng}`; see below |
| `<process>.log` | the output of a controller process |
| `.baraka-result` | the marker: the id of the run and the names of the files it may write here |

Until all controllers are connected and the run begins, its folder is called `DIR.not-started`. If
the run never begins, the folder keeps that name; the reason is in the table `run` and in the
controllers' logs. A run that begins is renamed to `DIR`. Earlier results there are kept as `DIR.1`,
`DIR.2` and so on, the oldest first; with `--overwrite` the earlier result is deleted as soon as the
new run has begun. Folders are renamed as a whole, so each of them is complete whenever a run is
killed. A run moves and deletes only files that the marker in a folder names. A folder that contains
anything else, or has no marker, is refused (exit status 2) and left as it is. While a run writes,
it holds the lock `.DIR.lock` beside the folder; a second run is refused. The parent folder of `DIR`
must be writable, and `DIR` must not be a mount point.

A failed run is recorded as such (`result` and `error` in the table `run`), even on a full disk: the
file `.reserve` keeps space for this and is deleted afterwards. In the result of a run that was
killed, `result` is still `running`; `baraka report` and `baraka export` call it unfinished.

A capture (pcapng, link type radiotap, time stamps in ns since the start of the run) contains every
frame on the air once, as an ideal receiver that hears everything would record it. With
`air_heard_by: AGENT` it contains what the radio of that agent sends and receives, whether addressed
to it or not. The time stamp of a packet is that of the last bit of its PPDU; the TSFT of radiotap
is that of the first bit after the PPDU's header (us, rounded down). Each MPDU of an A-MPDU is one
packet, with the time of the A-MPDU and its number in the file; HT, VHT and HE have their MCS,
streams, width and guard interval. The capture does not contain frames that were cut off because a radio was switched off, frames still in the air at the end, or frames that
the agent did not receive: the FCS of every packet is correct. The bytes are those of the frame
(IEEE 802.11, LLC/SNAP, FCS), even where `lengths: fixed` gives it another length on the air. Agent
hhll has the MAC address 02:00:00:00:hh:ll. Repeating the run writes the same bytes.

    tshark -r DIR/air.pcapng -Y 'wlan.fc.retry == 1'     the retries

With `--replications`, `DIR` contains `replications.yaml` (the request), one folder as above for each
replication (`replication-01` and so on) with its output in `replication-01.log`, and
`campaign.sqlite` with the numbers of all replications (campaign_tables.md).

)";

constexpr const char* kReading = R"(## Reading them

    baraka report DIR...              summary tables; -o PAGE.html draws figures
    baraka diff DIR OTHER             whether the same happened in two runs; the first difference
    baraka export DIR                 lists the tables of a result
    baraka view DIR...                world, network and time in a browser (view.md)
    baraka export DIR TABLE           one table as CSV (RFC 4180); -o FILE writes it to a file
    baraka export DIR --format csv -o FOLDER      all of them
    baraka export DIR --format mcap -o FILE       for Foxglove, PlotJuggler and RViz (viewers.md)
    baraka export DIR --format links -o FILE      received powers, for `propagation: [{model: measured}]`
    baraka export --describe          this page
    sqlite3 DIR/run.sqlite .schema    the tables with these meanings as comments

The report pools runs only if all their settings but the seed are equal; otherwise it prints one
column per group of runs and lists the settings that differ. If the scenario says `compare:
labella2009`, the report prints the figures of that paper beside those of the runs, provided that
the runs are of the paper's case study (equal in all settings but name, seed, radio, record, expect
and number of processes); otherwise it says why not. Settings that were varied make up an
experiment: the report prints the mean over the runs of each setting with its confidence interval
(docs/statistics.md) as requested by `report:` in the scenario, as tables, as figures on the page,
or as a single figure with `--figure NAME -o FILE.svg`. Given a folder of results, the report takes
all of them except earlier ones (`NAME.1` beside `NAME`) and those that never began
(`NAME.not-started`).

`baraka diff` compares the tables `arrivals`, `frames` and `frame_ends` row by row and prints the
first difference in time: stations, protocol, and the value or byte that differs (determinism.md).
With `record: {frames: sample}`, `counts` or `none` it names the second, the part and the agent of
the first difference in the table `fingerprints`, and says what to record.

In CSV the first line names the columns, null is an empty field, an empty text is `""`, and a number
is written in the shortest form that reads back to the same bits. A text that a spreadsheet could
take for a formula is preceded by `'`: one that begins with `=`, `+`, `-`, `@`, a tab or a line end,
unless it consists only of numbers, `-` and units, as `-85 dBm` does.

Results may come from people you do not know, so `baraka` checks what it reads. The tables must be
those of this version. Each cell is checked for its type and range: agents are in the table
`agents`, times are not after the end of the run, which is below 32 years, lengths are at most
1e12 m, counts at most 2^53, names at most 64 KiB and other texts at most 16 MiB. A value outside is
refused with file, table, row and column; where cells are only summed, the sum is checked. This does
not make the numbers true: whoever can write the file can write any plausible number.

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
