#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <vector>

#include "hal/types/verdict.h"
#include "view/server/frame_density.h"
#include "view/server/row_times.h"
#include "view/server/row_values.h"
#include "view/server/tiles.h"

namespace view::server {
namespace {

using results::record::Statement;

/// A frame's number is its transmitter times 2^48 plus the transmitter's own count.
constexpr std::int64_t kCountOfFrame = (std::int64_t{1} << 48) - 1;
/// Upper limit of the propagation delay across any field.
constexpr std::int64_t kLongestWay = 1'000'000;  // ns
/// A tile with more ends than this is sent as a summary as well: hundreds of radios may sense each
/// frame.
constexpr std::int64_t kMostEnds = 100'000;

std::vector<std::string_view> verdict_names() {
  std::vector<std::string_view> names;
  names.reserve(hal::kVerdictCount);
  for (int i = 0; i < hal::kVerdictCount; ++i)
    names.push_back(hal::name(static_cast<hal::Verdict>(i)));
  return names;
}

struct ListedFrame {
  std::int64_t id, at, transmitter, receiver, sequence, retry, bits;
  std::int64_t airtime;  ///< Of its PPDU.
  std::string kind;
  std::optional<std::int64_t> nav, rate, sender, message;
  std::optional<std::string> packet;
  std::int64_t ampdu, msdus;
  std::optional<std::string> mode, category, block_ack;  ///< mode: of an MCS
  JsonArray ends;
};

std::vector<ListedFrame> frames_in(Record& record, const Rows& rows) {
  Statement row = record.query(
      "SELECT frame, at_ns, transmitter, receiver, sequence, retry, bits, ppdu_ns, class, "
      "duration_ns, rate_bps, sender, message, packet, ampdu, msdus, "
      "modulation || ' MCS ' || mcs || ', ' || streams || ' x ' || width_mhz || ' MHz, ' || "
      "guard_ns || ' ns', category, block_ack FROM frames WHERE rowid >= ? AND rowid < ? "
      "ORDER BY at_ns, transmitter, rowid");
  row.bind_all(rows.begin, rows.end);
  std::vector<ListedFrame> frames;
  while (row.next()) {
    frames.push_back(
        {row.integer(0),      row.integer(1),     row.integer(2),      row.integer(3),
         row.integer(4),      row.integer(5),     row.integer(6),      row.integer(7),
         row.text(8),         integer_at(row, 9), integer_at(row, 10), integer_at(row, 11),
         integer_at(row, 12), text_at(row, 13),   row.integer(14),     row.integer(15),
         text_at(row, 16),    text_at(row, 17),   text_at(row, 18),    {}});
  }
  return frames;
}

/// Adds how the frames ended at the radios, in order of time.
void add_ends(Record& record, std::vector<ListedFrame>& frames) {
  if (frames.empty()) return;
  std::unordered_map<std::int64_t, ListedFrame*> by_id;
  std::int64_t last = 0;
  for (ListedFrame& frame : frames) {
    by_id[frame.id] = &frame;
    last = std::max(last, frame.at + frame.airtime);
  }
  std::map<std::string, std::size_t, std::less<>> verdicts;
  for (const std::string_view name : verdict_names()) verdicts.emplace(name, verdicts.size());
  const Rows over = rows_between(record, "frame_ends", frames.front().at, last + kLongestWay + 1);
  Statement end = record.query(
      "SELECT frame, agent, at_ns, verdict, rssi_dbm, sinr_db, rowid FROM frame_ends"
      " WHERE rowid >= ? AND rowid < ? ORDER BY rowid");
  end.bind_all(over.begin, over.end);
  while (end.next()) {
    const auto frame = by_id.find(end.integer(0));
    if (frame == by_id.end()) continue;
    const auto verdict = verdicts.find(end.text(3));
    if (verdict == verdicts.end()) end.refuse(3, "no end of a frame");
    frame->second->ends.add(JsonArray()
                                .add(end.integer(1))
                                .add(end.integer(2))
                                .add(verdict->second)
                                .add(real_at(end, 4))
                                .add(real_at(end, 5))
                                .json());
  }
}

Json frame_bins_json(const FrameBins& bins) {
  JsonArray classes, counts;
  for (const auto& [name, of_class] : bins.counts) {
    classes.add(name);
    counts.add(json_array(of_class));
  }
  return JsonObject()
      .add("n", kBins)
      .add("classes", classes.json())
      .add("counts", counts.json())
      .add("lost", json_array(bins.lost))
      .json();
}

}  // namespace

std::string frames_tile(Record& record, FrameDensity& density, const Span& span) {
  Columns columns({"transmitter", "number",  "at",   "class",    "receiver",  "sequence", "retry",
                   "bits",        "airtime", "nav",  "rate",     "sender",    "message",  "packet",
                   "ampdu",       "msdus",   "mode", "category", "block_ack", "ends"});
  const Json verdicts = json_array(verdict_names());
  const Rows rows = rows_in(record, "frames", span);
  const bool is_full =
      rows.count() > kMostRows || rows_in(record, "frame_ends", span).count() > kMostEnds;
  if (is_full && span.level > Span::kFinest) {
    return tile_text(
        record, span, false, columns,
        {{"verdicts", verdicts}, {"bins", frame_bins_json(density.bins(record, span))}});
  }
  std::vector<ListedFrame> frames = frames_in(record, rows);
  add_ends(record, frames);
  for (const ListedFrame& frame : frames) {
    columns.add(frame.transmitter, frame.id & kCountOfFrame, frame.at, frame.kind, frame.receiver,
                frame.sequence, frame.retry, frame.bits, frame.airtime, frame.nav, frame.rate,
                frame.sender, frame.message, frame.packet, frame.ampdu, frame.msdus, frame.mode,
                frame.category, frame.block_ack, frame.ends.json());
  }
  return tile_text(record, span, true, columns, {{"verdicts", verdicts}});
}

}  // namespace view::server
