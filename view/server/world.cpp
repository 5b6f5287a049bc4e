#include "view/server/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "sim/agents/drawn_bodies.h"
#include "sim/agents/simulation_config.h"
#include "view/server/channels.h"
#include "view/server/json_text.h"
#include "view/server/movables.h"
#include "view/server/radio_range.h"
#include "view/server/recorded.h"
#include "view/server/series.h"
#include "view/server/shapes.h"

namespace view::server {
namespace {

using results::record::Statement;
using sim::agents::AgentConfig;
using sim::scenario::Scenario;

/// The rectangle that contains everything.
class Bounds {
 public:
  void add(double x, double y, double around = 0) {
    x0_ = std::min(x0_, x - around);
    x1_ = std::max(x1_, x + around);
    y0_ = std::min(y0_, y - around);
    y1_ = std::max(y1_, y + around);
  }
  /// Adds the corners of a rectangle that is turned by `yaw`.
  void add_turned(const sim::physics::StaticBox& box) {
    const double c = std::abs(std::cos(box.yaw)), s = std::abs(std::sin(box.yaw));
    const double x = (c * box.size.x + s * box.size.y) / 2,
                 y = (s * box.size.x + c * box.size.y) / 2;
    add(box.centre.x - x, box.centre.y - y);
    add(box.centre.x + x, box.centre.y + y);
  }
  Json json() const {
    return JsonObject().add("x0", x0_).add("x1", x1_).add("y0", y0_).add("y1", y1_).json();
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  double x0_ = kFar, x1_ = -kFar, y0_ = kFar, y1_ = -kFar;
};

/// Descriptions by name: agents with equal descriptions share one.
class Shared {
 public:
  explicit Shared(const char* kind) : kind_(kind) {}
  /// @return its name; none if there is nothing to describe.
  std::optional<std::string> add(const Json& what) {
    if (what.text == "null" || what.text == "[]") return std::nullopt;
    const auto known = names_.find(what.text);
    if (known != names_.end()) return known->second;
    std::string name = fmt::format("{}{}", kind_, names_.size());
    all_.add(name, what);
    return names_[what.text] = std::move(name);
  }
  Json json() const { return all_.json(); }

 private:
  const char* kind_;
  std::map<std::string, std::string> names_;
  JsonObject all_;
};

Json parameters_json(const AgentConfig& agent) {
  JsonObject parameters;
  for (const auto& one : agent.parameters) {
    if (one.is_list) {
      parameters.add(one.name, json_array(one.items));
    } else {
      parameters.add(one.name, one.value);
    }
  }
  return parameters.json();
}

std::string_view kind_name(const AgentConfig& agent) {
  if (!has_body(agent)) return "station";
  return is_robot(agent) ? "robot" : "mote";
}

struct Standing {
  Json agents, shapes, channels;
};

/// The agents according to the scenario.
Standing agents_of(const Scenario& scenario, Bounds& bounds) {
  Shared shapes("shape"), channels("channels");
  JsonArray agents;
  for (const AgentConfig& one : scenario.simulation.agents) {
    bounds.add(one.pose.x, one.pose.y, body_radius(one));
    agents.add(JsonObject()
                   .add("agent", one.id.value)
                   .add("name", one.name)
                   .add("kind", kind_name(one))
                   .add("program", one.program)
                   .add("x", one.pose.x)
                   .add("y", one.pose.y)
                   .add("theta", one.pose.theta)
                   .add("shape", shapes.add(shape_json(one)))
                   .add("channels", channels.add(channels_json(one)))
                   .add("range_m", radio_range(scenario.simulation, one))
                   .add("parameters", parameters_json(one))
                   .add("infrared", infrared_json(one))
                   .json());
  }
  return {agents.json(), shapes.json(), channels.json()};
}

/// The agents according to the record, if the scenario cannot be read.
Standing agents_of(Record& record, Bounds& bounds) {
  JsonArray agents;
  Statement row =
      record.query("SELECT agent, name, kind, program, x_m, y_m, theta_rad FROM agents ORDER BY 1");
  while (row.next()) {
    bounds.add(row.real(4), row.real(5));
    agents.add(JsonObject()
                   .add("agent", row.integer(0))
                   .add("name", row.text(1))
                   .add("kind", row.text(2))
                   .add("program", row.text(3))
                   .add("x", row.real(4))
                   .add("y", row.real(5))
                   .add("theta", row.real(6))
                   .add("shape", std::nullopt)
                   .add("channels", std::nullopt)
                   .add("range_m", std::nullopt)
                   .add("parameters", Json{"{}"})
                   .add("infrared", Json{"[]"})
                   .json());
  }
  return {agents.json(), {"{}"}, {"{}"}};
}

Json wall_json(const sim::physics::StaticBox& wall) {
  return JsonObject()
      .add("name", wall.name)
      .add("x", wall.centre.x)
      .add("y", wall.centre.y)
      .add("yaw", wall.yaw)
      .add("length_x", wall.size.x)
      .add("length_y", wall.size.y)
      .add("height", wall.centre.z + wall.size.z / 2)
      .json();
}

Json walls_of(const Scenario& scenario, Bounds& bounds) {
  JsonArray walls;
  const sim::Ground& ground = *scenario.simulation.world.ground;
  for (const auto& wall : scenario.simulation.walls) {
    if (!sim::agents::stands_on(ground, wall)) continue;
    bounds.add_turned(wall);
    walls.add(wall_json(wall));
  }
  return walls.json();
}

Json walls_of(Record& record, Bounds& bounds) {
  constexpr double kDrawnHeight = 1;  // m: the record does not have it
  JsonArray walls;
  Statement row = record.query("SELECT name, x_m, y_m, yaw_rad, size_x_m, size_y_m FROM walls");
  while (row.next()) {
    const sim::physics::StaticBox wall{.name = row.text(0),
                                       .centre = {row.real(1), row.real(2), kDrawnHeight / 2},
                                       .size = {row.real(4), row.real(5), kDrawnHeight},
                                       .yaw = row.real(3)};
    bounds.add_turned(wall);
    walls.add(wall_json(wall));
  }
  return walls.json();
}

/// Adds where agents were; of a run that goes on only their latest places, because reading all
/// poses would take longer and longer.
void add_ways(Record& record, Bounds& bounds) {
  Statement row = record.query(record.is_growing()
                                   ? "SELECT MIN(x_m), MIN(y_m), MAX(x_m), MAX(y_m) FROM bodies"
                                   : "SELECT MIN(x_m), MIN(y_m), MAX(x_m), MAX(y_m) FROM poses");
  if (!row.next() || row.is_null(0)) return;
  bounds.add(row.real(0), row.real(1));
  bounds.add(row.real(2), row.real(3));
}

Json texts_of(Record& record, const char* sql) {
  JsonArray texts;
  Statement row = record.query(sql);
  while (row.next()) texts.add(row.text(0));
  return texts.json();
}

/// More links than these cannot be distinguished: the page then draws only those of the selected
/// agent.
constexpr std::size_t kMostLinks = 2000;

Json links_of(Record& record) {
  JsonArray links;
  Statement row =
      record.query(fmt::format("SELECT a, b FROM links ORDER BY 1, 2 LIMIT {}", kMostLinks + 1));
  while (row.next()) links.add(JsonArray().add(row.integer(0)).add(row.integer(1)).json());
  return links.json();
}

Json links_of(const Scenario& scenario) {
  JsonArray links;
  std::size_t left = kMostLinks + 1;
  for (const auto& [a, b] : links_at_start(scenario.simulation)) {
    if (left-- == 0) break;
    links.add(JsonArray().add(a).add(b).json());
  }
  return links.json();
}

Json lines_of(std::string text, const std::vector<std::string>& more) {
  JsonArray lines;
  for (const std::string& line : more) lines.add(line);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (end > 0) lines.add(text.substr(0, end));
    text.erase(0, end + 1);
  }
  return lines.json();
}

/// Adds what only a run has.
void add_run(JsonObject& world, Record& record, const std::vector<std::string>& said) {
  const RecordSettings settings = record_settings(record);
  for (const char* key : {"result", "profile", "fingerprint"}) world.add(key, record.value(key));
  const double period_s = record.real("control_period_s").value_or(0);
  world.add("seed", record.integer("seed").value_or(0))
      .add("end", record.until())
      .add("until", record.until())
      .add("control_period", std::llround(1e9 * period_s))
      .add("links", links_of(record))
      .add("series", SeriesStore::list(record))
      .add("states",
           texts_of(record, "SELECT state FROM states GROUP BY state ORDER BY MIN(rowid)"))
      .add("topics", texts_of(record,
                              "SELECT topic FROM messages UNION SELECT topic FROM "
                              "counted_ends ORDER BY 1"))
      .add("recorded", recorded_json(settings))
      .add("missing", missing_json(settings))
      .add("warnings", lines_of(record.value("warnings"), said));
}

/// Adds what a scenario tells about a run that has not happened.
void add_plan(JsonObject& world, const Scenario& scenario, const std::vector<std::string>& said) {
  const RecordSettings settings = record_settings(scenario);
  std::int64_t end = 0;
  for (const auto& one : scenario.simulation.ends) {
    if (!one.agent && !one.when) end = std::max<std::int64_t>(end, one.after.count());
  }
  world.add("result", std::nullopt)
      .add("profile", std::nullopt)
      .add("fingerprint", std::nullopt)
      .add("seed", static_cast<std::int64_t>(scenario.simulation.seed))
      .add("end", end)
      .add("until", 0)
      .add("control_period", scenario.simulation.control_period.count())
      .add("links", links_of(scenario))
      .add("series", Json{"[]"})
      .add("states", Json{"[]"})
      .add("topics", Json{"[]"})
      .add("recorded", recorded_json(settings))
      .add("missing", missing_json(settings))
      .add("warnings", lines_of("", said));
}

}  // namespace

std::string world_json(Record* record, const Scenario* scenario, const std::string& name,
                       const std::vector<std::string>& said) {
  Bounds bounds;
  const Standing standing =
      scenario != nullptr ? agents_of(*scenario, bounds) : agents_of(*record, bounds);
  if (scenario != nullptr) {
    for (const sim::physics::Movable& one : scenario->simulation.movables)
      bounds.add(one.pose.x, one.pose.y);
  }
  const Json walls = scenario != nullptr ? walls_of(*scenario, bounds) : walls_of(*record, bounds);
  JsonObject world;
  world.add("name", name);
  if (record != nullptr) {
    add_ways(*record, bounds);
    add_run(world, *record, said);
  } else {
    add_plan(world, *scenario, said);
  }
  return world.add("agents", standing.agents)
      .add("shapes", standing.shapes)
      .add("channels", standing.channels)
      .add("walls", walls)
      .add("movables",
           scenario != nullptr ? movables_json(scenario->simulation) : movables_json(*record))
      .add("bounds", bounds.json())
      .json()
      .text;
}

}  // namespace view::server
