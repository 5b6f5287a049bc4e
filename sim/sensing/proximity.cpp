#include "sim/sensing/proximity.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "sim/core/cell_grid.h"
#include "sim/sensing/shape_tree.h"

namespace sim::sensing {
namespace {

using physics::Shape;

/// m, edge of the cells for moving shapes: about what a sensor sees and what a robot measures.
constexpr double kCell = 1;

std::vector<std::size_t> select(std::span<const Shape> shapes, bool is_static) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (shapes[i].is_static() == is_static) chosen.push_back(i);
  return chosen;
}

/// m, of a circle around the centre that holds the shape, seen from above.
double radius_of(const Shape& shape) {
  if (shape.kind == Shape::Kind::kCylinder) return shape.radius;
  return std::sqrt(dot(shape.half, shape.half));
}

}  // namespace

class Proximity::Implementation {
 public:
  explicit Implementation(const physics::World& given)
      : world(given), fixed(given.shapes(), select(given.shapes(), true)) {
    follow_all();
  }

  void follow(std::size_t shape) {
    const Shape& now = world.shapes()[shape];
    largest = std::max(largest, radius_of(now));
    moving.put(static_cast<CellGrid::Member>(shape), now.centre);
  }
  void follow_all() {
    for (const std::size_t shape : select(world.shapes(), false)) follow(shape);
    followed = world.steps();
  }
  void follow_moved() {
    for (const hal::AgentId agent : world.moved()) {
      const auto first = world.shapes_of(agent).data() - world.shapes().data();
      for (std::size_t i = 0; i < world.shapes_of(agent).size(); ++i)
        follow(static_cast<std::size_t>(first) + i);
    }
    followed = world.steps();
  }

  const physics::World& world;
  ShapeTree fixed;  ///< Built once.
  CellGrid moving{kCell};
  double largest = 0;          ///< m, radius of the moving shapes.
  std::uint64_t followed = 0;  ///< Step of the world that `moving` is of.
  std::vector<std::size_t> candidates;
  std::vector<CellGrid::Member> found;
};

Proximity::Proximity(const physics::World& world)
    : implementation_(std::make_unique<Implementation>(world)) {}

Proximity::~Proximity() = default;

void Proximity::update() {
  Implementation& i = *implementation_;
  if (i.followed + 1 == i.world.steps())
    i.follow_moved();
  else if (i.followed != i.world.steps())
    i.follow_all();
}

std::span<const std::size_t> Proximity::within(const Region& region) const {
  Implementation& i = *implementation_;
  i.candidates.clear();
  i.found.clear();
  i.fixed.overlapping(region, i.candidates);
  i.moving.within({region.low.x - i.largest, region.low.y - i.largest},
                  {region.high.x + i.largest, region.high.y + i.largest}, i.found);
  i.candidates.insert(i.candidates.end(), i.found.begin(), i.found.end());
  std::sort(i.candidates.begin(), i.candidates.end());
  return i.candidates;
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
