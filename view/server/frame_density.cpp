#include "view/server/frame_density.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <unordered_map>

#include "view/server/row_times.h"

namespace view::server {
namespace {

using results::record::Statement;

constexpr int kPartLevel = 10;                                       // 1.07 s
constexpr std::int64_t kPart = std::int64_t{1} << (3 * kPartLevel);  // ns
constexpr std::int64_t kParts = 64;  // counted at a time by advance()
/// Upper limit of the time from a frame's begin to its end at all radios: the longest frame at 1
/// Mbit/s takes 20 ms.
constexpr std::int64_t kLongestFrame = 100'000'000;  // ns
constexpr std::int64_t kFirstGroup = 0xfffe;         // first group address

struct Begun {
  std::int64_t part;
  std::int64_t receiver;
};

/// Counts frames that begin in [from, to), in parts of equal width from `from` on.
FrameParts count_frames(Record& record, std::int64_t from, std::int64_t to, std::int64_t width) {
  FrameParts found;
  std::unordered_map<std::int64_t, Begun> begun;
  const Rows begin = rows_between(record, "frames", from, to);
  Statement frames = record.query(
      "SELECT frame, at_ns, receiver, class, rowid FROM frames WHERE rowid >= ? AND rowid < ?");
  frames.bind_all(begin.begin, begin.end);
  while (frames.next()) {
    const std::int64_t at = frames.integer(1);
    if (at < from || at >= to) frames.refuse(1, kOutOfOrder);
    const std::int64_t part = (at - from) / width;
    begun[frames.integer(0)] = {part, frames.integer(2)};
    ++found.counts[frames.text(3)][part];
  }
  if (begun.empty()) return found;
  const Rows over = rows_between(record, "frame_ends", from, to + kLongestFrame);
  Statement ends = record.query(
      "SELECT frame, agent FROM frame_ends WHERE rowid >= ? AND rowid < ? AND verdict <> "
      "'delivered'");
  ends.bind_all(over.begin, over.end);
  while (ends.next()) {
    const auto frame = begun.find(ends.integer(0));
    if (frame == begun.end()) continue;
    const std::int64_t receiver = frame->second.receiver;
    if (receiver >= kFirstGroup || receiver == ends.integer(1)) ++found.lost[frame->second.part];
  }
  return found;
}

/// The begin of the first frame that begins at or after a time; none if there is none.
std::optional<std::int64_t> next_begin(Record& record, std::int64_t from) {
  const Rows rest = rows_between(record, "frames", from, std::numeric_limits<std::int64_t>::max());
  Statement first =
      record.query("SELECT at_ns FROM frames WHERE rowid >= ? ORDER BY rowid LIMIT 1");
  first.bind_all(rest.begin);
  if (!first.next()) return std::nullopt;
  return first.integer(0);
}

/// Adds parts of equal width up to the 64 bins of a span. @param begin  of part 0, ns.
std::vector<std::int64_t> bins_of(const FrameParts::Counts& parts, std::int64_t begin,
                                  std::int64_t width, const Span& span) {
  std::vector<std::int64_t> bins(kBins);
  for (const auto& [part, count] : parts) {
    const std::int64_t at = begin + part * width;
    if (at >= span.from() && at < span.to()) bins[bin_of(span, at)] += count;
  }
  return bins;
}

/// Adds all classes and the losses.
void add(FrameBins& to, const FrameParts& parts, std::int64_t begin, std::int64_t width,
         const Span& span) {
  const auto add_to = [&](std::vector<std::int64_t>& sum, const FrameParts::Counts& counts) {
    const std::vector<std::int64_t> more = bins_of(counts, begin, width, span);
    sum.resize(more.size());
    for (std::size_t i = 0; i < more.size(); ++i) sum[i] += more[i];
  };
  for (const auto& [name, counts] : parts.counts) add_to(to.counts[name], counts);
  add_to(to.lost, parts.lost);
}

void append(FrameParts::Counts& to, std::int64_t before, const FrameParts::Counts& more) {
  for (const auto& [part, count] : more) to[before + part] += count;
}

}  // namespace

bool FrameDensity::advance(Record& record) {
  // While a run goes on, the ends of its latest frames are not known yet.
  const std::int64_t known =
      record.is_growing() ? record.until() - kLongestFrame : record.until() + kPart;
  if (known - counted_ < kPart) return false;
  // Skips the time without frames.
  const std::int64_t next = std::min(next_begin(record, counted_).value_or(known), known);
  counted_ = std::max(counted_, next / kPart * kPart);
  const std::int64_t parts = std::min((known - counted_) / kPart, kParts);
  if (parts <= 0) return false;
  const FrameParts more = count_frames(record, counted_, counted_ + parts * kPart, kPart);
  const std::int64_t before = counted_ / kPart;
  for (const auto& [name, counts] : more.counts) append(parts_.counts[name], before, counts);
  append(parts_.lost, before, more.lost);
  counted_ += parts * kPart;
  return true;
}

FrameBins FrameDensity::bins(Record& record, const Span& span) {
  const std::int64_t width = (span.to() - span.from()) / kBins;
  FrameBins found;
  if (width < kPart) {
    add(found, count_frames(record, span.from(), span.to(), width), span.from(), width, span);
    return found;
  }
  while (counted_ < span.to() && advance(record)) {
  }
  add(found, parts_, 0, kPart, span);
  if (counted_ >= span.to() || record.until() < counted_) return found;
  // The rest, which is not final yet: less than two parts.
  const FrameParts rest = count_frames(record, counted_, record.until() + 1, kPart);
  add(found, rest, counted_, kPart, span);
  return found;
}

}  // namespace view::server
