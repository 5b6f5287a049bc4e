#include "gateway/view/frame_density.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "gateway/view/row_times.h"

namespace gateway::view {
namespace {

using sim::record::Statement;

constexpr int kPartLevel = 10;                                       // 1.07 s
constexpr std::int64_t kPart = std::int64_t{1} << (3 * kPartLevel);  // ns
constexpr std::int64_t kParts = 64;                                  // counted at a time
/// A frame is over so long after its begin, everywhere: the longest at 1 Mbit/s takes 20 ms.
constexpr std::int64_t kLongestFrame = 100'000'000;  // ns
constexpr std::int64_t kFirstGroup = 0xfffe;         // destinations that are several agents

struct Begun {
  std::size_t bin;
  std::int64_t receiver;
};

/// Into bins of one width from a time on; those that begin before another.
FrameBins count_frames(Record& record, std::int64_t from, std::int64_t to, std::int64_t width) {
  const auto bins = static_cast<std::size_t>((to - from + width - 1) / width);
  FrameBins found{{}, std::vector<std::int64_t>(bins)};
  std::unordered_map<std::int64_t, Begun> begun;
  const Rows begin = rows_between(record, "frames", from, to);
  Statement frames = record.query(
      "SELECT frame, at_ns, receiver, class FROM frames WHERE rowid >= ? AND rowid < ?");
  frames.bind_all(begin.begin, begin.end);
  while (frames.next()) {
    const auto bin = static_cast<std::size_t>((frames.integer(1) - from) / width);
    begun[frames.integer(0)] = {bin, frames.integer(2)};
    auto& counts = found.counts[frames.text(3)];
    counts.resize(bins);
    ++counts[bin];
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
    if (receiver >= kFirstGroup || receiver == ends.integer(1)) ++found.lost[frame->second.bin];
  }
  return found;
}

void append(std::vector<std::int64_t>& to, std::size_t before,
            const std::vector<std::int64_t>& more) {
  to.resize(before);
  to.insert(to.end(), more.begin(), more.end());
}

/// Sums of parts over the 64 bins of a span. @param begin  of the first part, ns
std::vector<std::int64_t> sums(const std::vector<std::int64_t>& parts, std::int64_t begin,
                               const Span& span) {
  std::vector<std::int64_t> bins(kBins);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::int64_t at = begin + static_cast<std::int64_t>(i) * kPart;
    if (at >= span.from() && at < span.to()) bins[bin_of(span, at)] += parts[i];
  }
  return bins;
}

/// Adds parts to the bins of a span.
void add(FrameBins& to, const FrameBins& parts, std::int64_t begin, const Span& span) {
  const auto add_to = [](std::vector<std::int64_t>& sum, const std::vector<std::int64_t>& more) {
    sum.resize(more.size());
    for (std::size_t i = 0; i < more.size(); ++i) sum[i] += more[i];
  };
  for (const auto& [name, counts] : parts.counts) {
    add_to(to.counts[name], sums(counts, begin, span));
  }
  add_to(to.lost, sums(parts.lost, begin, span));
}

}  // namespace

bool FrameDensity::advance(Record& record) {
  // Of the latest frames of a run that goes on it is not known how they end.
  const std::int64_t known =
      record.is_growing() ? record.until() - kLongestFrame : record.until() + kPart;
  const std::int64_t parts = std::min((known - counted_) / kPart, kParts);
  if (parts <= 0) return false;
  const std::int64_t to = counted_ + parts * kPart;
  const FrameBins more = count_frames(record, counted_, to, kPart);
  const std::size_t before = parts_.lost.size();
  for (const auto& [name, counts] : more.counts) append(parts_.counts[name], before, counts);
  for (auto& [name, counts] : parts_.counts) counts.resize(before + more.lost.size());
  append(parts_.lost, before, more.lost);
  counted_ = to;
  return true;
}

FrameBins FrameDensity::bins(Record& record, const Span& span) {
  const std::int64_t width = (span.to() - span.from()) / kBins;
  if (width < kPart) return count_frames(record, span.from(), span.to(), width);
  while (counted_ < span.to() && advance(record)) {
  }
  FrameBins found;
  add(found, parts_, 0, span);
  if (counted_ >= span.to() || record.until() < counted_) return found;
  // What is not known for good yet: less than two parts.
  add(found, count_frames(record, counted_, record.until() + 1, kPart), counted_, span);
  return found;
}

}  // namespace gateway::view
