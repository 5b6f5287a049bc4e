#include "view/server/series.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>

#include "view/server/row_times.h"
#include "view/server/tiles.h"

namespace view::server {
namespace {

using results::record::Statement;

/// Indices: observables keep their numbers; a value of a controller has the rowid of its first row
/// plus this offset.
constexpr std::int64_t kOfControllers = std::int64_t{1} << 32;
constexpr std::size_t kMostKept = 4'000'000;  // samples, 16 bytes each
constexpr std::size_t kSeriesBins = 256;

struct Bin {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  double sum = 0;
  std::int64_t count = 0;
};

Json series_bins(const auto& samples, const Span& span) {
  std::array<Bin, kSeriesBins> bins;
  const std::int64_t width = (span.to() - span.from()) / static_cast<std::int64_t>(kSeriesBins);
  for (const auto& [at, value] : samples) {
    Bin& bin = bins.at(static_cast<std::size_t>((at - span.from()) / width));
    bin.min = std::min(bin.min, value);
    bin.max = std::max(bin.max, value);
    bin.sum += value;
    ++bin.count;
  }
  JsonArray min, max, mean;
  for (const Bin& bin : bins) {  // infinite values are written as null
    min.add(bin.min);
    max.add(bin.max);
    mean.add(bin.count == 0 ? bin.min : bin.sum / static_cast<double>(bin.count));
  }
  return JsonObject()
      .add("n", kSeriesBins)
      .add("min", min.json())
      .add("max", max.json())
      .add("mean", mean.json())
      .json();
}

/// @param with  called with the index and a row of number, name, agent and unit.
void each_series(Record& record, const auto& with) {
  Statement observable = record.query(
      "SELECT observable, name, agent, unit FROM observables WHERE keeps = 'samples' ORDER BY 1");
  while (observable.next()) with(observable.integer(0), observable);
  Statement recorded = record.query(
      "SELECT MIN(r.rowid) AS rowid, r.name, r.agent, IFNULL(u.unit, '') FROM recorded r"
      " LEFT JOIN agents a ON a.agent = r.agent"
      " LEFT JOIN recorded_units u ON u.program = a.program AND u.name = r.name"
      " GROUP BY r.agent, r.name ORDER BY 1");
  while (recorded.next()) {
    if (recorded.integer(0) >= kOfControllers) recorded.refuse(0, "a row that no table comes to");
    with(recorded.integer(0) + kOfControllers, recorded);
  }
}

}  // namespace

std::vector<std::int64_t> SeriesStore::indices(Record& record) {
  std::vector<std::int64_t> indices;
  each_series(record, [&](std::int64_t index, const Statement&) { indices.push_back(index); });
  return indices;
}

Json SeriesStore::list(Record& record) {
  JsonArray all;
  each_series(record, [&](std::int64_t index, const Statement& row) {
    all.add(JsonObject()
                .add("index", index)
                .add("name", row.text(1))
                .add("agent", row.integer(2))
                .add("unit", row.text(3))
                .json());
  });
  return all.json();
}

const SeriesStore::Series* SeriesStore::find(Record& record, std::int64_t index) {
  const bool is_of_controller = index >= kOfControllers;
  Statement exists = record.query(
      is_of_controller ? "SELECT 1 FROM recorded WHERE rowid = ?"
                       : "SELECT 1 FROM observables WHERE observable = ? AND keeps = 'samples'");
  exists.bind_all(is_of_controller ? index - kOfControllers : index);
  if (!exists.next()) return nullptr;
  if (samples_ > kMostKept) kept_.clear();
  if (kept_.empty()) samples_ = 0;
  Series& series = kept_[index];
  Statement rows = record.query(
      is_of_controller
          ? "SELECT r.rowid AS rowid, r.at_ns, r.value FROM recorded r, recorded f"
            " WHERE f.rowid = ? AND r.agent = f.agent AND r.name = f.name AND r.rowid > ?"
            " ORDER BY r.rowid"
          : "SELECT rowid, at_ns, value FROM observable_samples WHERE observable = ? AND rowid > ? "
            "ORDER BY rowid");
  rows.bind_all(is_of_controller ? index - kOfControllers : index, series.read);
  while (rows.next()) {
    series.read = rows.integer(0);
    const std::int64_t at = rows.integer(1);
    if (!series.samples.empty() && at < series.samples.back().first) rows.refuse(1, kOutOfOrder);
    series.samples.emplace_back(at, rows.real(2));
    ++samples_;
  }
  return &series;
}

std::string SeriesStore::tile(Record& record, std::int64_t index, const Span& span) {
  const Series* const series = find(record, index);
  if (series == nullptr) return "";
  const auto at = [](const auto& sample) { return sample.first; };
  const auto& all = series->samples;
  const std::span inside(std::ranges::lower_bound(all, span.from(), {}, at),
                         std::ranges::lower_bound(all, span.to(), {}, at));
  Columns columns({"at", "value"});
  if (static_cast<std::int64_t>(inside.size()) > kMostRows) {
    return tile_text(record, span, false, columns, {{"bins", series_bins(inside, span)}});
  }
  for (const auto& [time, value] : inside) columns.add(time, value);
  return tile_text(record, span, true, columns);
}

}  // namespace view::server
