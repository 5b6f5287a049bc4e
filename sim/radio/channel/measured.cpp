#include "sim/radio/channel/measured.h"

#include <algorithm>
#include <limits>

#include "hal/types/math.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

std::unique_ptr<const PathLoss> make(const MeasuredConfig& config, const PropagationConfig& air,
                                     const Ground& ground) {
  std::unique_ptr<const PathLoss> otherwise;
  if (config.otherwise) {
    otherwise =
        std::visit([&](const auto& law) { return make(law, air, ground); }, *config.otherwise);
  }
  return std::make_unique<Measured>(config, std::move(otherwise));
}

Measured::Measured(const MeasuredConfig& config, std::unique_ptr<const PathLoss> otherwise)
    : between_(config.between),
      has_times_(config.has_times),
      silence_(config.silence && config.has_times ? hal::to_seconds(*config.silence)
                                                  : std::numeric_limits<double>::infinity()),
      otherwise_(std::move(otherwise)) {
  if (config.rows == nullptr) return;
  std::map<std::string_view, hal::AgentId> agents;
  for (const auto& [agent, name] : config.stations) agents.emplace(name, agent);
  for (const MeasuredRow& row : *config.rows) {
    const auto from = agents.find(row.from), to = agents.find(row.to);
    if (from == agents.end() || to == agents.end()) continue;
    links_[{from->second, to->second}].push_back({row.at, row.loss});
  }
  for (auto& [link, rows] : links_) std::ranges::stable_sort(rows, {}, &Row::at);
}

const std::vector<Measured::Row>* Measured::rows_of(const Path& path) const {
  auto found = links_.find({path.from.agent, path.to.agent});
  if (found == links_.end()) found = links_.find({path.to.agent, path.from.agent});
  return found == links_.end() ? nullptr : &found->second;
}

std::optional<double> Measured::loss_at(const std::vector<Row>& rows, hal::Time time) const {
  const double now = hal::to_seconds(time);
  const auto later = std::ranges::upper_bound(rows, now, {}, &Row::at);
  const double since = later == rows.begin() ? 0 : (later - 1)->at;
  const double until = later == rows.end() ? now : later->at;
  if (until - since > silence_) return std::nullopt;
  if (later == rows.begin()) return later->loss;
  const Row& earlier = *(later - 1);
  if (later == rows.end() || between_ == MeasuredBetween::kHold) return earlier.loss;
  const double share = (now - earlier.at) / (later->at - earlier.at);
  return earlier.loss + share * (later->loss - earlier.loss);
}

hal::Milliwatts Measured::after(hal::Milliwatts power, const Path& path) const {
  const std::vector<Row>* const rows = rows_of(path);
  if (rows == nullptr)
    return otherwise_ == nullptr ? hal::Milliwatts{} : otherwise_->after(power, path);
  const std::optional<double> loss = loss_at(*rows, path.at);
  return loss ? hal::math::pow(10, -*loss / 10) * power : hal::Milliwatts{};
}

double Measured::reach(hal::Milliwatts /*power*/, hal::Milliwatts /*least*/) const {
  return std::numeric_limits<double>::infinity();
}

}  // namespace sim::radio
