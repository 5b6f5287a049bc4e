#include "sim/air/sample_losses.h"

#include <algorithm>

namespace sim::air {

void SampleLosses::add(const SampleLoss& loss, Range range) {
  std::erase_if(all_, [&range](const Lost& one) { return one.range == range; });
  if (all_.size() >= kMost) all_.erase(all_.begin());
  all_.push_back({loss, range});
}

void SampleLosses::expect(const SampleLoss& loss, Range range, hal::Time over) {
  if (expected_) add(expected_->loss, expected_->range);
  expected_ = {loss, range};
  over_ = over;
}

void SampleLosses::on_heard(std::uint64_t frame) {
  if (expected_ && expected_->loss.frame == frame) expected_.reset();
  std::erase_if(all_, [frame](const Lost& one) { return one.loss.frame == frame; });
}

void SampleLosses::settle(hal::Time now) {
  if (!expected_ || over_ > now) return;
  add(expected_->loss, expected_->range);
  expected_.reset();
}

std::optional<SampleLoss> SampleLosses::last(const std::vector<bool>& got) const {
  const auto is_missing = [&got](const Lost& one) {
    const auto end = got.begin() + std::min<std::ptrdiff_t>(one.range.second, std::ssize(got));
    return std::find(got.begin() + one.range.first, end, false) != end;
  };
  const auto found = std::find_if(all_.rbegin(), all_.rend(), is_missing);
  if (found == all_.rend()) return std::nullopt;
  return found->loss;
}

void SampleLosses::clear() {
  std::vector<Lost>().swap(all_);
  expected_.reset();
}

}  // namespace sim::air
