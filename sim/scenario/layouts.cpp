#include "sim/scenario/layouts.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "hal/types/agent_id.h"
#include "hal/types/math.h"
#include "hal/types/random.h"

namespace sim::scenario {
namespace {

constexpr std::int64_t kMostAgents = hal::kLastAddress;
constexpr Range kDistance{0, 1e6};  // m

void count_key(Fields& io, int& count) {
  io.needed_count({"count", "How many of them.", "10"}, 1, kMostAgents, count);
}

void yaw_key(Fields& io, double& yaw) {
  io.number({"yaw", "Heading of all of them, counter-clockwise from the x axis.", "90 deg"}, "rad",
            kAngle, yaw);
}

void origin_key(Fields& io, hal::Vec2& origin) {
  io.vec2({"origin", "Position of the first one, world frame.", "[0 m, 0 m]"}, "m", kCoordinate,
          origin);
}

void layout_keys(Fields& io, GridLayout& c) {
  io.needed_count({"columns", "How many along x.", "5"}, 1, kMostAgents, c.columns);
  io.needed_count({"rows", "How many along y.", "5"}, 1, kMostAgents, c.rows);
  io.needed({"spacing", "Distance between neighbours along x and along y.", "[125 m, 125 m]"}, "m",
            {0, kCoordinate.high}, c.spacing);
  origin_key(io, c.origin);
  yaw_key(io, c.yaw);
}

void layout_keys(Fields& io, CircleLayout& c) {
  count_key(io, c.count);
  io.needed({"radius", "Radius of the circle.", "5 m"}, "m", kDistance, c.radius);
  io.vec2({"centre", "Centre of the circle, world frame.", "[0 m, 0 m]"}, "m", kCoordinate,
          c.centre);
  yaw_key(io, c.yaw);
}

void layout_keys(Fields& io, LineLayout& c) {
  count_key(io, c.count);
  io.needed({"spacing", "Distance from one to the next.", "30 m"}, "m", kDistance, c.spacing);
  origin_key(io, c.origin);
  io.number({"heading", "Direction of the line, counter-clockwise from the x axis.", "90 deg"},
            "rad", kAngle, c.heading);
  yaw_key(io, c.yaw);
}

void layout_keys(Fields& io, UniformLayout& c) {
  count_key(io, c.count);
  io.needed({"from", "Corner of the rectangle, world frame.", "[0 m, 0 m]"}, "m", kCoordinate,
            c.from);
  io.needed({"to", "Opposite corner of the rectangle, world frame.", "[100 m, 100 m]"}, "m",
            kCoordinate, c.to);
  io.number({"spacing", "Smallest distance between any two of them.", "1 m"}, "m", kDistance,
            c.spacing);
  yaw_key(io, c.yaw);
}

const std::array kLayouts{
    alternative<Placement, GridLayout>({"grid", "Places them on a grid, row by row."}),
    alternative<Placement, CircleLayout>(
        {"circle", "Places them evenly on a circle, the first one in the direction of x."}),
    alternative<Placement, LineLayout>({"line", "Places them on a straight line."}),
    alternative<Placement, UniformLayout>(
        {"uniform",
         "Places them at random, uniformly in a rectangle; depends "
         "on the run's seed and the group's name."})};

/// Poses are not a mapping.
void layout_keys(Fields& /*io*/, std::vector<hal::Pose2>& /*poses*/) {}

/// Points of a plane that keep a minimum distance. Cells have that size, so only the surrounding
/// cells need to be checked.
class SpacedPoints {
 public:
  explicit SpacedPoints(double spacing) : spacing_(spacing) {}

  /// @return false if another point is too near.
  bool add(hal::Vec2 point) {
    if (spacing_ <= 0) return true;
    const auto [column, row] = cell_of(point);
    for (std::int64_t x = column - 1; x <= column + 1; ++x) {
      for (std::int64_t y = row - 1; y <= row + 1; ++y) {
        if (is_near(point, {x, y})) return false;
      }
    }
    cells_[{column, row}].push_back(point);
    return true;
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  Cell cell_of(hal::Vec2 point) const {
    return {static_cast<std::int64_t>(std::floor(point.x / spacing_)),
            static_cast<std::int64_t>(std::floor(point.y / spacing_))};
  }
  bool is_near(hal::Vec2 point, const Cell& cell) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return false;
    for (const hal::Vec2& other : found->second) {
      if (hal::dot(point - other, point - other) < spacing_ * spacing_) return true;
    }
    return false;
  }

  const double spacing_;  // m
  std::map<Cell, std::vector<hal::Vec2>> cells_;
};

using Poses = std::vector<hal::Pose2>;

struct Expand {
  std::uint64_t seed;
  const std::string& stream;
  LayoutMistake& mistake;

  Poses operator()(const Poses& poses) const { return poses; }
  Poses operator()(const GridLayout& c) const {
    Poses poses;
    const std::int64_t count = std::int64_t{c.columns} * c.rows;
    if (count > kMostAgents) {
      mistake.text = fmt::format(
          "{} x {} are {} agents; network addresses have 16 bits, which is enough for {}",
          c.columns, c.rows, count, kMostAgents);
      return poses;
    }
    poses.reserve(static_cast<std::size_t>(count));
    for (int row = 0; row < c.rows; ++row) {
      for (int column = 0; column < c.columns; ++column)
        poses.push_back({c.origin.x + c.spacing.x * column, c.origin.y + c.spacing.y * row, c.yaw});
    }
    return poses;
  }
  Poses operator()(const CircleLayout& c) const {
    Poses poses;
    poses.reserve(static_cast<std::size_t>(c.count));
    for (int i = 0; i < c.count; ++i) {
      const double angle = 2 * hal::math::kPi * i / c.count;
      poses.push_back({c.centre.x + c.radius * hal::math::cos(angle),
                       c.centre.y + c.radius * hal::math::sin(angle), c.yaw});
    }
    return poses;
  }
  Poses operator()(const LineLayout& c) const {
    const hal::Vec2 step =
        c.spacing * hal::Vec2{hal::math::cos(c.heading), hal::math::sin(c.heading)};
    Poses poses;
    poses.reserve(static_cast<std::size_t>(c.count));
    for (int i = 0; i < c.count; ++i) {
      const hal::Vec2 at = c.origin + static_cast<double>(i) * step;
      poses.push_back({at.x, at.y, c.yaw});
    }
    return poses;
  }
  Poses operator()(const UniformLayout& c) const {
    constexpr int kMostDraws = 1000;  // for one agent
    const auto count = static_cast<std::size_t>(c.count);
    hal::RandomStream random(seed, stream);
    SpacedPoints taken(c.spacing);
    Poses poses;
    poses.reserve(count);
    for (int draws = 0; poses.size() < count && draws < kMostDraws; ++draws) {
      const double x = random.uniform(), y = random.uniform();
      const hal::Vec2 at{c.from.x + x * (c.to.x - c.from.x), c.from.y + y * (c.to.y - c.from.y)};
      if (!taken.add(at)) continue;
      poses.push_back({at.x, at.y, c.yaw});
      draws = 0;
    }
    if (poses.size() < count) {
      mistake = {"spacing", fmt::format("{} m leave room for {} of {} agents", c.spacing,
                                        poses.size(), count)};
    }
    return poses;
  }
};

}  // namespace

bool layout_keys(Fields& io, Placement& placement, const std::function<void(Fields&)>& otherwise) {
  const auto keys = [](Fields& one, Placement& layout) {
    std::visit([&one](auto& c) { layout_keys(one, c); }, layout);
  };
  return io.one_of(kLayouts, placement, keys, otherwise);
}

std::string name_of(const Placement& placement) {
  return placement.index() == 0 ? "poses" : kLayouts[placement.index() - 1].key.name;
}

Poses poses_of(const Placement& placement, std::uint64_t seed, const std::string& stream,
               LayoutMistake& mistake) {
  return std::visit(Expand{seed, stream, mistake}, placement);
}

}  // namespace sim::scenario
