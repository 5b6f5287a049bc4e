#include "sim/scenario/layouts.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "hal/types/agent_id.h"
#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

constexpr std::int64_t kMostAgents = hal::kLastAddress;
constexpr Range kDistance{0, 1e6};  // m

std::int64_t read_count(Mapping& in) {
  return in.integer({"count", "Of the agents.", "10"}, 1, kMostAgents);
}

double read_yaw(Mapping& in) {
  return in.number({"yaw", "Heading of all of them.", "90 deg"}, "rad", kAngle, 0);
}

/// Points of a plane that keep a distance. Cells of that size: only the cells around are looked at.
class SpacedPoints {
 public:
  explicit SpacedPoints(double spacing) : spacing_(spacing) {}

  /// @return false: there is one too near.
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
      if (dot(point - other, point - other) < spacing_ * spacing_) return true;
    }
    return false;
  }

  const double spacing_;  // m
  std::map<Cell, std::vector<hal::Vec2>> cells_;
};

}  // namespace

/// Row by row from the origin: x first, then y.
std::vector<hal::Pose2> read_grid(Mapping in) {
  const std::int64_t columns =
      in.integer({"columns", "Agents side by side along x.", "5"}, 1, kMostAgents);
  const std::int64_t rows =
      in.integer({"rows", "Agents side by side along y.", "5"}, 1, kMostAgents);
  const hal::Vec2 spacing =
      in.vec2({"spacing", "Between neighbours along x and y.", "[125 m, 125 m]"}, "m",
              {0, kCoordinate.high});
  const hal::Vec2 origin = in.vec2(
      {"origin", "Where the first one stands, world frame.", "[0 m, 0 m]"}, "m", kCoordinate, {});
  const double yaw = in.number({"yaw", "Heading of all of them.", "90 deg"}, "rad", kAngle, 0);
  in.finish();
  std::vector<hal::Pose2> poses;
  if (columns * rows > kMostAgents) {
    in.mistake("", fmt::format("{} x {} are {} agents; network addresses have 16 bits, which is "
                               "enough for {}",
                               columns, rows, columns * rows, kMostAgents));
    return poses;
  }
  for (std::int64_t row = 0; row < rows; ++row) {
    for (std::int64_t column = 0; column < columns; ++column) {
      poses.push_back({origin.x + spacing.x * static_cast<double>(column),
                       origin.y + spacing.y * static_cast<double>(row), yaw});
    }
  }
  return poses;
}

std::vector<hal::Pose2> read_circle_layout(Mapping in) {
  const std::int64_t count = read_count(in);
  const double radius = in.number({"radius", "Of the circle.", "5 m"}, "m", kDistance);
  const hal::Vec2 centre =
      in.vec2({"centre", "Of the circle, world frame.", "[0 m, 0 m]"}, "m", kCoordinate, {});
  const double yaw = read_yaw(in);
  in.finish();
  std::vector<hal::Pose2> poses;
  for (std::int64_t i = 0; i < count; ++i) {
    const double angle = 2 * hal::math::kPi * static_cast<double>(i) / static_cast<double>(count);
    poses.push_back({centre.x + radius * hal::math::cos(angle),
                     centre.y + radius * hal::math::sin(angle), yaw});
  }
  return poses;
}

std::vector<hal::Pose2> read_line_layout(Mapping in) {
  const std::int64_t count = read_count(in);
  const double spacing = in.number({"spacing", "From one to the next.", "30 m"}, "m", kDistance);
  const hal::Vec2 origin = in.vec2(
      {"origin", "Where the first one stands, world frame.", "[0 m, 0 m]"}, "m", kCoordinate, {});
  const double heading =
      in.number({"heading", "Of the line, from x towards y.", "90 deg"}, "rad", kAngle, 0);
  const double yaw = read_yaw(in);
  in.finish();
  const hal::Vec2 step = spacing * hal::Vec2{hal::math::cos(heading), hal::math::sin(heading)};
  std::vector<hal::Pose2> poses;
  for (std::int64_t i = 0; i < count; ++i) {
    const hal::Vec2 at = origin + static_cast<double>(i) * step;
    poses.push_back({at.x, at.y, yaw});
  }
  return poses;
}

std::vector<hal::Pose2> read_uniform(Mapping in, std::uint64_t seed, const std::string& stream) {
  constexpr int kMostDraws = 1000;  // for one agent
  const auto count = static_cast<std::size_t>(read_count(in));
  const hal::Vec2 from =
      in.vec2({"from", "A corner of the area, world frame.", "[0 m, 0 m]"}, "m", kCoordinate);
  const hal::Vec2 to = in.vec2({"to", "The opposite corner.", "[100 m, 100 m]"}, "m", kCoordinate);
  const double spacing =
      in.number({"spacing", "Least distance of any two of the group.", "1 m"}, "m", kDistance, 0);
  const double yaw = read_yaw(in);
  in.finish();
  hal::RandomStream random(seed, stream);
  SpacedPoints taken(spacing);
  std::vector<hal::Pose2> poses;
  for (int draws = 0; poses.size() < count && draws < kMostDraws; ++draws) {
    const double x = random.uniform(), y = random.uniform();
    const hal::Vec2 at{from.x + x * (to.x - from.x), from.y + y * (to.y - from.y)};
    if (!taken.add(at)) continue;
    poses.push_back({at.x, at.y, yaw});
    draws = 0;
  }
  if (poses.size() < count) {
    in.mistake("spacing",
               fmt::format("{} m leave room for {} of {} agents", spacing, poses.size(), count));
  }
  return poses;
}

}  // namespace sim::scenario
