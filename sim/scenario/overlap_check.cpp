#include "sim/scenario/overlap_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "sim/agents/populated_world.h"
#include "sim/physics/overlap.h"

namespace sim::scenario {
namespace {

using physics::Shape;

/// m; depth that rounding may give to bodies that only touch.
constexpr double kRounding = 1e-6;

/// One wall or movable, or all shapes of one agent.
struct Body {
  std::span<const Shape> shapes;
  hal::Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  hal::Vec2 high{-std::numeric_limits<double>::infinity(),
                 -std::numeric_limits<double>::infinity()};

  bool is_static() const { return shapes.front().is_static(); }
};

void enclose(Body& body, const Shape& shape) {
  const bool box = shape.kind == Shape::Kind::kBox;
  const hal::Vec2 axis{std::abs(shape.axis.x), std::abs(shape.axis.y)};
  const double x = box ? axis.x * shape.half.x + axis.y * shape.half.y : shape.radius;
  const double y = box ? axis.y * shape.half.x + axis.x * shape.half.y : shape.radius;
  body.low = {std::min(body.low.x, shape.centre.x - x), std::min(body.low.y, shape.centre.y - y)};
  body.high = {std::max(body.high.x, shape.centre.x + x),
               std::max(body.high.y, shape.centre.y + y)};
}

/// Walls first, then agents, then movables, in order of declaration, which is that of the shapes.
std::vector<Body> bodies_of(std::span<const Shape> shapes) {
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const bool same = i > 0 && shapes[i].is_of_body(shapes[i - 1]);
    if (!same) bodies.push_back({.shapes = shapes.subspan(i, 0)});
    Body& body = bodies.back();
    body.shapes = shapes.subspan(i - body.shapes.size(), body.shapes.size() + 1);
    enclose(body, shapes[i]);
  }
  return bodies;
}

/// Depth of the deepest horizontal overlap, m; 0 if they only touch.
/// @param touching  m, permitted depth.
double deepest(const Body& a, const Body& b, double touching) {
  double depth = 0;
  for (const Shape& of_a : a.shapes) {
    for (const Shape& of_b : b.shapes) {
      const physics::Overlap overlap = physics::overlap(of_a, of_b);
      if (overlap.is_deeper_than(touching)) depth = std::max(depth, overlap.level);
    }
  }
  return depth;
}

struct Meeting {
  std::size_t body, other;  ///< The body declared later, and the one declared earlier.
  double depth;             ///< m
};

/// For each body, finds one overlap with an earlier one. Sweeps along x, so that only neighbours
/// are compared (M. C. Lin, D. Manocha, M. Ponamgi and J. D. Cohen, "I-COLLIDE", 1995).
class Sweep {
 public:
  Sweep(const std::vector<Body>& bodies, double touching)
      : bodies_(bodies), touching_(touching), found_(bodies.size(), false) {}

  std::vector<Meeting> run() {
    std::vector<std::size_t> order(bodies_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return bodies_[a].low.x < bodies_[b].low.x;
    });
    std::vector<std::size_t> reached;  // bodies whose extent the sweep is in
    for (const std::size_t next : order) {
      std::erase_if(reached,
                    [&](std::size_t b) { return bodies_[b].high.x < bodies_[next].low.x; });
      for (const std::size_t other : reached) compare(next, other);
      reached.push_back(next);
    }
    std::sort(meetings_.begin(), meetings_.end(),
              [](const Meeting& a, const Meeting& b) { return a.body < b.body; });
    return std::move(meetings_);
  }

 private:
  void compare(std::size_t a, std::size_t b) {
    const auto [other, body] = std::minmax(a, b);
    if (found_[body] || bodies_[body].is_static()) return;
    if (bodies_[a].high.y < bodies_[b].low.y || bodies_[b].high.y < bodies_[a].low.y) return;
    const double depth = deepest(bodies_[a], bodies_[b], touching_);
    if (depth <= 0) return;
    found_[body] = true;
    meetings_.push_back({body, other, depth});
  }

  const std::vector<Body>& bodies_;
  double touching_;
  std::vector<bool> found_;  ///< Per body.
  std::vector<Meeting> meetings_;
};

/// Names and places of what may move.
class Directory {
 public:
  explicit Directory(const Scenario& scenario) {
    for (const agents::AgentConfig& agent : scenario.simulation.agents)
      entries_[agent.id] = {agent.name, {agent.pose.x, agent.pose.y}, ""};
    for (const Group& group : scenario.groups) {
      for (std::size_t i = 0; i < group.agents.size(); ++i) {
        entries_[group.agents[i]].prefix =
            fmt::format("{}: agents.{}", group.places[i], group.name);
      }
    }
    const auto& places = scenario.movable_places;
    for (const physics::Movable& movable : scenario.simulation.movables) {
      const std::size_t i = movables_.size();
      const std::string place = i < places.size() ? places[i] + ": " : "";
      movables_.push_back(
          {movable.name, {movable.pose.x, movable.pose.y}, place + "world.movables"});
    }
  }

  struct Entry {
    std::string name;
    hal::Vec2 at;        ///< m
    std::string prefix;  ///< Of messages.
  };
  /// @param body  not static. @param bodies  all.
  const Entry& entry(const Body& body, const std::vector<Body>& bodies) const {
    const Shape& shape = body.shapes.front();
    if (!shape.is_movable) return entries_.at(shape.owner);
    const auto behind = static_cast<std::size_t>(&bodies.back() - &body);
    return movables_[movables_.size() - 1 - behind];
  }

 private:
  std::map<hal::AgentId, Entry> entries_;
  std::vector<Entry> movables_;
};

std::string told(const Meeting& meeting, const std::vector<Body>& bodies, const Scenario& scenario,
                 const Directory& directory) {
  const Directory::Entry& later = directory.entry(bodies[meeting.body], bodies);
  const std::string start = fmt::format("{}: at the start {}", later.prefix, later.name);
  const Body& other = bodies[meeting.other];
  if (other.is_static()) {
    return fmt::format("{} is {:.3g} m deep in '{}'", start, meeting.depth,
                       scenario.simulation.walls[meeting.other].name);
  }
  const Directory::Entry& earlier = directory.entry(other, bodies);
  const hal::Vec2 apart = later.at - earlier.at;
  return fmt::format("{} overlaps {} by {:.3g} m; they are {:.3g} m apart", start, earlier.name,
                     meeting.depth, std::sqrt(hal::dot(apart, apart)));
}

}  // namespace

std::vector<std::string> overlaps(const Scenario& scenario) {
  const auto world = agents::populated_world(scenario.simulation);
  const std::vector<Body> bodies = bodies_of(world->shapes());
  const double touching = std::max(scenario.simulation.world.surface_layer, kRounding);
  const std::vector<Meeting> found = Sweep(bodies, touching).run();
  const Directory directory(scenario);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < std::min(found.size(), kMostLines); ++i)
    lines.push_back(told(found[i], bodies, scenario, directory));
  if (found.size() > kMostLines) {
    const Body& next = bodies[found[kMostLines].body];
    lines.push_back(fmt::format("{}: and so do {} more {}", directory.entry(next, bodies).prefix,
                                found.size() - kMostLines,
                                next.shapes.front().is_movable ? "bodies" : "agents"));
  }
  return lines;
}

}  // namespace sim::scenario
