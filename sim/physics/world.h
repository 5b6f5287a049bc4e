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
#include "sim/core/obstacle_loss.h"
#include "sim/physics/shape.h"

namespace sim::physics {

using hal::AgentId;

/// Defaults are the measured ones of docs/models.md, 1 and 2.
struct WorldConfig {
  hal::Duration step = std::chrono::milliseconds(10);  ///< > 0, at most 20 ms.
  double gravity = 9.81;                               ///< m/s^2, along `down`.
  hal::Vec3 down{0, 0, -1};              ///< Unit vector; tilted, flat ground is a slope.
  double erp = 0.4;                      ///< Share of a joint error corrected per step, 0 .. 1.
  double cfm = 1e-8;                     ///< Softness of constraints.
  double surface_layer = 1e-4;           ///< m; contacts may sink in this far.
  double max_correcting_velocity = 0.1;  ///< m/s at which contacts push bodies apart.
  double ground_friction = 0.6;          ///< For motes; wheels bring their own. >= 0
  int jam_contacts = 8;                  ///< Heaps with more contacts get the iterative solver.
  /// Heaps with more robots get the iterative solver, too: seven robots in a ring have only seven
  /// contacts, for which the exact solver takes 2.5 ms a step.
  int jam_robots = 4;
  std::uint64_t seed = 1;                              ///< Of the iterative solver's row order.
  bool measure_energy = false;                         ///< Books all wheels' work, some 5 % slower.
  std::shared_ptr<const Ground> ground = kFlatGround;  ///< Never null.
};

/// A wall or another box that never moves.
struct StaticBox {
  std::string name;
  hal::Vec3 centre;  ///< m, world frame
  hal::Vec3 size;    ///< m along its own axes, each > 0
  double yaw = 0;    ///< rad
  double friction = 0.6;
  ObstacleLoss radio_loss = kBrickWall;  ///< The world itself makes nothing of it.
};

/// Where a body is. Its origin is the middle of a robot's footprint, of the face on which a mote
/// stood at the start.
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

/// How often a body touched one kind of thing.
struct ContactRecord {
  std::uint64_t steps = 0;         ///< Physics steps in contact, asleep or not.
  std::optional<hal::Time> first;  ///< Since the start of the world.
};

/// Contacts of an agent's body; wheels on the ground do not count.
struct Contacts {
  ContactRecord walls;
  ContactRecord motes;
  ContactRecord robots;
  ContactRecord bodies;  ///< Motes or robots: a step in contact with both counts once.
};

/// What became of a body that no robot or mote should get into.
enum class BodyLoss : std::uint8_t {
  kTipped,       ///< Tilted by more than 1 rad against the ground.
  kBlownUp,      ///< Not a number, or faster than 100 km/s; it is frozen where it was before.
  kBelowGround,  ///< Its origin is more than 0.2 m below the ground.
  kFarAway,      ///< More than 100 km from the world's origin.
};
std::string_view name(BodyLoss loss);  ///< For people: "tipped over".

struct LostBody {
  AgentId agent;
  BodyLoss how = BodyLoss::kTipped;
  hal::Time at{};  ///< End of the step.
};

/// Energies of an agent's body and wheels, J. The last three count from the start; they stay 0
/// unless the world measures energies or the robot has a battery.
struct Energy {
  double kinetic = 0;    ///< Of body and wheels.
  double potential = 0;  ///< 0 with the centre of mass in the world's origin.
  /// Work of the motors at the hinges or, at the contact level, where the wheels touch the ground.
  double motor_work = 0;
  double friction_loss = 0;  ///< Where the wheels touch the ground.
  /// Input of the motors: their work and the heat in their windings. Energy that they take up while
  /// they brake is lost.
  double motor_input = 0;

  double mechanical() const { return kinetic + potential; }
};

/// Rigid bodies on the ground: robots on driven wheels, motes that can be pushed, walls.
/// Same calls, same bits: bodies are made and stepped in the order of the calls. A world is used by
/// one thread at a time; worlds in other threads do not disturb it unless both hold a jam, because
/// the iterative solver draws from a generator that the process shares.
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

  /// Before the first step. @throws std::invalid_argument  a size, mass or wheel that is not
  /// possible, or an agent that is there already or is 0.
  void add_wall(const StaticBox& wall);
  /// @param height  m, of the mote's lower face above the ground at the start; above 0 it stands on
  /// a box or falls.
  void add_mote(AgentId agent, const hal::node::devices::MoteDescription& mote,
                const hal::Pose2& pose, double height = 0);
  void add_robot(AgentId agent, const hal::node::devices::RobotDescription& robot,
                 const hal::Pose2& pose);

  /// Drives with a velocity of the body until the next command: what the wheels can do of it,
  /// scaled to the motors' limit, then approached within the acceleration limits. Errors:
  /// kInvalidArgument (NaN or infinite), kNotAvailable (not a robot).
  hal::Result<hal::node::devices::WheelDrive::Limited> set_body_velocity(AgentId agent,
                                                                         const hal::Twist2& twist);

  /// rad/s, one per driven wheel; approached within the acceleration limits. Speeds that no
  /// feasible motion of the body fits are fitted by least squares. Errors: kInvalidArgument (count,
  /// NaN, beyond the limit), kNotAvailable (not a robot).
  hal::Result<void> set_wheel_speeds(AgentId agent, std::span<const double> speeds);

  /// Switches a robot's motors. Without power its wheels roll freely. Either way its command
  /// becomes zero. Errors: kNotAvailable (not a robot).
  hal::Result<void> set_motors(AgentId agent, bool on);

  /// Puts a body somewhere else with the next step: at rest and upright on the ground. A robot
  /// keeps its command. What stands there is pushed apart.
  /// @pre the agent was added; the pose is finite.
  void place(AgentId agent, const hal::Pose2& pose);

  /// Moves everything on by config().step.
  void step();

  const WorldConfig& config() const;
  std::uint64_t steps() const;  ///< Taken so far.
  hal::Time now() const;        ///< steps() times the step.

  /// All of these: @pre the agent was added.
  BodyPose pose(AgentId agent) const;
  hal::Vec3 position(AgentId agent) const;  ///< That of pose(), without its angles.
  /// The last of steps() that may have moved the body; 0: none. Who knows its pose of that step, or
  /// of a later one, knows it still.
  std::uint64_t moved_at(AgentId agent) const;
  BodyVelocity velocity(AgentId agent) const;
  const Contacts& contacts(AgentId agent) const;
  bool asleep(AgentId agent) const;  ///< At rest and not computed until something touches it.

  /// @pre the agent is a robot.
  const hal::node::devices::WheelDrive& drive(AgentId agent) const;
  /// rad of the driven wheels since the start, not wrapped: what their encoders would count. At the
  /// level kContact a wheel turns as the motor profile says, also while it spins; a wheel whose
  /// motor is off or too weak for its load rolls as the ground passes by.
  std::span<const double> wheel_angles(AgentId agent) const;

  /// Of body and wheels. Work, loss and input are 0 without `measure_energy` or a battery.
  Energy energy(AgentId agent) const;

  double motor_input(AgentId agent) const;  ///< That of energy(). @pre the agent is a robot.

  bool has(AgentId agent) const;

  /// Bodies that tipped over or got lost, in the order in which it happened; each once.
  std::span<const LostBody> lost_bodies() const;

  /// Walls and bodies in the order they were added; poses as of the last step. Each add_… appends;
  /// indices stay.
  std::span<const Shape> shapes() const;

  /// Those of shapes() that are an agent's: they follow one another.
  std::span<const Shape> shapes_of(AgentId agent) const;

  /// Agents whose bodies the last step may have moved, in the order they were added. All others are
  /// where they were before it.
  std::span<const AgentId> moved() const;

  /// Complaints of the solver so far (a singular system, a failed collision test): 0 when healthy.
  std::uint64_t solver_messages() const;

  /// Steps in which a jam went to the iterative solver.
  std::uint64_t jammed_steps() const;

  /// Most contacts, those of wheels and motes with the ground left out, that one heap had when the
  /// exact solver worked on it.
  int largest_exact_heap() const;

  /// How far bodies and walls overlapped most at the start of the last step, m.
  double deepest_overlap() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sim::physics
