#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "hal/node/devices/robot_description.h"
#include "hal/node/devices/wheel_drive.h"
#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/result.h"
#include "hal/types/time.h"
#include "sim/core/ground.h"
#include "sim/core/material.h"
#include "sim/core/obstacle_loss.h"
#include "sim/physics/movable.h"
#include "sim/physics/shape.h"

namespace sim::physics {

using hal::AgentId;

/// The defaults were determined by measurement: docs/models.md, 1 and 2.
struct WorldConfig {
  hal::Duration step = std::chrono::milliseconds(10);  ///< > 0, at most 20 ms.
  double gravity = 9.81;                               ///< m/s^2, along `down`.
  hal::Vec3 down{0, 0, -1};              ///< Unit vector; if tilted, flat ground is a slope.
  double erp = 0.4;                      ///< Share of a joint error corrected per step, 0 .. 1.
  double cfm = 1e-8;                     ///< Softness of constraints.
  double surface_layer = 1e-4;           ///< m; contacts may sink in this far.
  double max_correcting_velocity = 0.1;  ///< m/s at which contacts push bodies apart.
  double ground_friction = 0.6;          ///< >= 0; for motes and movables.
  int jam_contacts = 8;                  ///< Islands with more contacts use the iterative solver.
  /// Islands with more robots use the iterative solver, too: seven robots in a ring have only seven
  /// contacts, for which the exact solver takes 2.5 ms a step.
  int jam_robots = 4;
  std::uint64_t seed = 1;       ///< For the iterative solver's row order.
  bool measure_energy = false;  ///< Records the work of all wheels; steps take about 5 % longer.
  std::shared_ptr<const Ground> ground = kFlatGround;  ///< Never null.
};

/// A wall or another box that never moves.
struct StaticBox {
  std::string name;
  hal::Vec3 centre;  ///< m, world frame
  hal::Vec3 size;    ///< m along its own axes, each > 0
  double yaw = 0;    ///< rad
  double friction = 0.6;
  ObstacleLoss radio_loss = kBrickWall;    ///< Not used by the world itself.
  std::string material{kDefaultMaterial};  ///< The same: name of a Material.
};

/// Pose of a body. The origin is the centre of a robot's footprint, of the face on which a mote
/// stood at the start, or of a movable.
struct BodyPose {
  hal::Vec3 position;                            ///< m, of the origin, world frame
  double heading = 0;                            ///< rad, of the body's x axis seen from above
  double tilt = 0;                               ///< rad between the body's z axis and vertical
  std::array<double, 4> quaternion{1, 0, 0, 0};  ///< w, x, y, z: body to world
};

struct BodyVelocity {
  hal::Vec3 linear;   ///< m/s of the origin, world frame
  hal::Vec3 angular;  ///< rad/s, world frame
};

/// Number of contacts of a body with one kind of object.
struct ContactRecord {
  std::uint64_t steps = 0;         ///< Physics steps in contact, asleep or not.
  std::optional<hal::Time> first;  ///< Since the start of the world.
};

/// Contacts of an agent's body; wheels on the ground do not count.
struct Contacts {
  ContactRecord walls;
  ContactRecord motes;
  ContactRecord robots;
  ContactRecord movables;
  ContactRecord bodies;  ///< Of the last three: a step in contact with several counts once.
};

/// How a body was lost, that is, reached a state that no robot or mote should reach.
enum class BodyLoss : std::uint8_t {
  kTipped,       ///< Tilted by more than 1 rad against the ground. Never of a movable.
  kBlownUp,      ///< NaN, or faster than 100 km/s; it is frozen at its last valid position.
  kBelowGround,  ///< Its origin is more than 0.2 m below the ground.
  kFarAway,      ///< More than 100 km from the world's origin.
};
std::string_view name(BodyLoss loss);  ///< For messages: "tipped over".

struct LostBody {
  AgentId agent;  ///< 0: a movable.
  BodyLoss how = BodyLoss::kTipped;
  hal::Time at{};                          ///< End of the step.
  std::optional<std::uint32_t> movable{};  ///< Its number.
};

/// State of a movable after a step.
struct MovableState {
  BodyPose pose;
  BodyVelocity velocity;
  bool asleep = false;
};

/// Energies of an agent's body and wheels, J. The last three are totals since the start; they stay
/// 0 unless the world measures energies or the robot has a battery.
struct Energy {
  double kinetic = 0;    ///< Of the body and its wheels.
  double potential = 0;  ///< 0 with the centre of mass at the world's origin.
  /// Work of the motors at the hinges or, at the contact level, at the wheels' contacts with the
  /// ground.
  double motor_work = 0;
  double friction_loss = 0;  ///< At the wheels' contacts with the ground.
  /// Input of the motors: their work and the heat in their windings. Energy that they receive while
  /// braking is lost.
  double motor_input = 0;

  double mechanical() const { return kinetic + potential; }
};

/// Rigid bodies on the ground: robots on driven wheels, motes and movables that can be pushed, and
/// walls. Equal
/// calls give bit-identical results: bodies are made and stepped in the order of the calls. A world
/// is used by one thread at a time; worlds in other threads do not affect it unless both have a
/// jam, because the iterative solver uses a random generator that the process shares.
///
///   World world(WorldConfig{});
///   world.add_robot(r0, description, {8, 8, 0});
///   world.set_body_velocity(r0, {0.5, 0, 0});
///   world.step();
///   world.pose(r0).position;
class World {
 public:
  /// @throws std::invalid_argument naming the field that is out of range.
  explicit World(const WorldConfig& config);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Add objects; call before the first step. @throws std::invalid_argument  a size, mass or wheel
  /// is not possible, or the agent already exists or is 0.
  void add_wall(const StaticBox& wall);
  /// @param height  m, initial height of the mote's lower face above the ground; above 0 it stands
  /// on a box or falls.
  void add_mote(AgentId agent, const hal::node::devices::MoteDescription& mote,
                const hal::Pose2& pose, double height = 0);
  void add_robot(AgentId agent, const hal::node::devices::RobotDescription& robot,
                 const hal::Pose2& pose);
  /// Movables have numbers, from 0 in the order of the calls.
  void add_movable(const Movable& movable);

  /// Sets the velocity of a robot's body until the next command. The part that the wheels can
  /// realise, scaled to the motors' limit, is approached within the acceleration limits. Errors:
  /// kInvalidArgument (NaN or infinite), kNotAvailable (not a robot).
  hal::Result<hal::node::devices::WheelDrive::Limited> set_body_velocity(AgentId agent,
                                                                         const hal::Twist2& twist);

  /// Sets the speeds of the driven wheels [rad/s], which are approached within the acceleration
  /// limits. Speeds that match no possible motion of the body are fitted by least squares. Errors:
  /// kInvalidArgument (count, NaN, beyond the limit), kNotAvailable (not a robot).
  hal::Result<void> set_wheel_speeds(AgentId agent, std::span<const double> speeds);

  /// Switches a robot's motors. Without power its wheels roll freely. Both on and off set its
  /// command to zero. Errors: kNotAvailable (not a robot).
  hal::Result<void> set_motors(AgentId agent, bool on);

  /// Places a body at a pose with the next step: at rest and upright on the ground. A robot keeps
  /// its command. Overlapping bodies are pushed apart.
  /// @pre the agent was added; the pose is finite.
  void place(AgentId agent, const hal::Pose2& pose);

  /// Advances the world by config().step.
  void step();

  const WorldConfig& config() const;
  std::uint64_t steps() const;  ///< Taken so far.
  hal::Time now() const;        ///< steps() times the step.

  /// For all of these: @pre the agent was added.
  BodyPose pose(AgentId agent) const;
  hal::Vec3 position(AgentId agent) const;  ///< Position of pose(), without its angles.
  /// Number of the last step that may have moved the body; 0: none. A pose read after that step is
  /// still valid.
  std::uint64_t moved_at(AgentId agent) const;
  BodyVelocity velocity(AgentId agent) const;
  const Contacts& contacts(AgentId agent) const;
  bool asleep(AgentId agent) const;  ///< At rest, and not simulated until something touches it.

  /// @pre the agent is a robot.
  const hal::node::devices::WheelDrive& drive(AgentId agent) const;
  /// rad of the driven wheels since the start, not wrapped: what their encoders would count. At the
  /// level kContact a wheel turns as the motor profile says, also while it spins; a wheel whose
  /// motor is off or too weak for its load rolls as the ground passes by.
  std::span<const double> wheel_angles(AgentId agent) const;

  /// Energies of body and wheels. Work, loss and input are 0 without `measure_energy` or a battery.
  Energy energy(AgentId agent) const;

  double motor_input(AgentId agent) const;  ///< As in energy(). @pre the agent is a robot.

  bool has(AgentId agent) const;

  std::size_t movable_count() const;
  /// For all of these: @param number  below movable_count().
  MovableState movable(std::size_t number) const;
  const Contacts& movable_contacts(std::size_t number) const;
  const Shape& movable_shape(std::size_t number) const;  ///< An element of shapes().

  /// Bodies that tipped over or were lost, in order of time, each once.
  std::span<const LostBody> lost_bodies() const;

  /// Walls and bodies in the order in which they were added; poses as of the last step. Each add_…
  /// appends; indices do not change.
  std::span<const Shape> shapes() const;

  /// The shapes of an agent; they have consecutive indices in shapes().
  std::span<const Shape> shapes_of(AgentId agent) const;

  /// Agents whose bodies the last step may have moved, in the order in which they were added. All
  /// others are where they were.
  std::span<const AgentId> moved() const;
  std::span<const std::uint32_t> moved_movables() const;  ///< The same for movables.

  /// Number of messages of the solver so far (a singular system, a failed collision test): normally
  /// 0.
  std::uint64_t solver_messages() const;

  /// Number of steps in which a jam was solved by the iterative solver.
  std::uint64_t jammed_steps() const;

  /// Largest number of contacts of an island solved by the exact solver, not counting those of
  /// wheels and motes with the ground.
  int largest_exact_heap() const;

  /// Largest depth of overlap between bodies and walls at the start of the last step, m.
  double deepest_overlap() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sim::physics
