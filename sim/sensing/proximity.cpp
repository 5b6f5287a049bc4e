#include "sim/sensing/proximity.h"

#include <vector>

#include "sim/sensing/shape_tree.h"

namespace sim::sensing {
namespace {

using physics::Shape;

std::vector<std::size_t> select(std::span<const Shape> shapes, bool is_static) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (shapes[i].is_static() == is_static) chosen.push_back(i);
  return chosen;
}

}  // namespace

class Proximity::Implementation {
 public:
  explicit Implementation(const physics::World& given)
      : world(given),
        fixed(given.shapes(), select(given.shapes(), true)),
        moving(given.shapes(), select(given.shapes(), false)) {}

  const physics::World& world;
  ShapeTree fixed;   ///< Built once.
  ShapeTree moving;  ///< Refitted at every update.
  std::vector<std::size_t> candidates;
};

Proximity::Proximity(const physics::World& world)
    : implementation_(std::make_unique<Implementation>(world)) {}

Proximity::~Proximity() = default;

void Proximity::update() { implementation_->moving.update(implementation_->world.shapes()); }

std::span<const std::size_t> Proximity::within(const Region& region) const {
  auto& candidates = implementation_->candidates;
  candidates.clear();
  implementation_->fixed.overlapping(region, candidates);
  implementation_->moving.overlapping(region, candidates);
  return candidates;
}

std::optional<double> Proximity::nearest(const SectorQuery& query, hal::AgentId own,
                                         std::span<const std::size_t> candidates) const {
  const std::span<const Shape> shapes = implementation_->world.shapes();
  std::optional<double> smallest;
  for (const std::size_t index : candidates) {
    const Shape& shape = shapes[index];
    if (shape.owner == own && !shape.is_static()) continue;
    const std::optional<double> distance = query.nearest(shape);
    if (distance && (!smallest || *distance < *smallest)) smallest = distance;
  }
  return smallest;
}

}  // namespace sim::sensing
