#include "sim/agents/crossed_walls.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace sim::agents {

CrossedWalls::CrossedWalls(const SimulationConfig& config) : ceilings_(config.ceilings) {
  by_wall_.reserve(config.walls.size());
  for (const physics::StaticBox& wall : config.walls) {
    const auto known = std::ranges::find(materials_, wall.material, &Material::name);
    by_wall_.push_back(static_cast<std::uint32_t>(known - materials_.begin()));
    if (known != materials_.end()) continue;
    const auto material = find_material(wall.material, config.materials);
    if (!material) throw std::invalid_argument("unknown material '" + wall.material + "'");
    materials_.push_back(*material);
  }
}

void CrossedWalls::count(std::span<const sensing::LineOfSight::Wall> parts, hal::Metres gap,
                         WallCrossings& crossed) const {
  crossed.walls.assign(materials_.size(), 0);
  parts_.clear();
  for (const auto& part : parts)
    parts_.push_back({by_wall_[part.index], part.begin, part.begin + part.thickness});
  std::ranges::sort(parts_, {},
                    [](const Part& one) { return std::tuple(one.material, one.begin, one.end); });
  const Part* before = nullptr;
  double end = 0;
  for (const Part& part : parts_) {
    const bool is_same = before != nullptr && before->material == part.material;
    if (!is_same || part.begin > end + gap.value) {
      ++crossed.walls[part.material];
      end = part.end;
    }
    end = std::max(end, part.end);
    before = &part;
  }
}

void CrossedWalls::count_ceilings(double from, double to, WallCrossings& crossed) const {
  crossed.ceilings = 0;
  crossed.ceiling_loss = {};
  for (const Ceiling& ceiling : ceilings_) {
    const double height = ceiling.height.value;
    if (height <= std::min(from, to) || height >= std::max(from, to)) continue;
    ++crossed.ceilings;
    crossed.ceiling_loss.value += ceiling.loss.value;
  }
}

}  // namespace sim::agents
