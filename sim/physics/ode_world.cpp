#include "sim/physics/ode_world.h"

#include <algorithm>
#include <cstdarg>

#include "hal/types/check.h"

namespace sim::physics {
namespace {

/// Counter of messages of the step in progress. ODE has one handler per process; each thread steps
/// one world at a time.
thread_local std::uint64_t* message_count = nullptr;

void count_message(int /*number*/, const char* /*text*/, va_list /*arguments*/) {
  if (message_count != nullptr) ++*message_count;
}

bool start_ode() {
  dInitODE2(0);
  dSetMessageHandler(count_message);
  return true;
}

/// Initialises ODE once per process; it is never closed.
void initialise_ode() {
  static const bool started = start_ode();
  BARAKA_CHECK(started);
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
}

void configure(dWorldID world, const WorldConfig& config) {
  const hal::Vec3 gravity = config.gravity * config.down;
  dWorldSetGravity(world, gravity.x, gravity.y, gravity.z);
  dWorldSetERP(world, config.erp);
  dWorldSetCFM(world, config.cfm);
  dWorldSetContactSurfaceLayer(world, config.surface_layer);
  dWorldSetContactMaxCorrectingVel(world, config.max_correcting_velocity);
  dWorldSetQuickStepNumIterations(world, 20);
  // With these thresholds, motes at rest sleep within 0.6 s and none falls asleep while it is
  // pushed (docs/models.md, 1).
  dWorldSetAutoDisableFlag(world, 1);
  dWorldSetAutoDisableLinearThreshold(world, 0.005);
  dWorldSetAutoDisableAngularThreshold(world, 0.02);
  dWorldSetAutoDisableSteps(world, 0);
  dWorldSetAutoDisableTime(world, 0.5);
  dWorldSetAutoDisableAverageSamplesCount(world, 1);
}

}  // namespace

OdeWorld::OdeWorld(const WorldConfig& config) : ground_(config.ground) {
  initialise_ode();
  dynamics_ = dWorldCreate();
  // ODE's default threading object is shared by all worlds and aborts when two threads step.
  threading_ = dThreadingAllocateSelfThreadedImplementation();
  dWorldSetStepThreadingImplementation(dynamics_, dThreadingImplementationGetFunctions(threading_),
                                       threading_);
  configure(dynamics_, config);
  space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  contacts_ = dJointGroupCreate(0);
  ground_plane_ = dCreatePlane(nullptr, 0, 0, 1, 0);
}

OdeWorld::~OdeWorld() {
  dJointGroupDestroy(contacts_);
  dSpaceDestroy(space_);
  dGeomDestroy(ground_plane_);
  dWorldSetStepThreadingImplementation(dynamics_, nullptr, nullptr);
  dWorldDestroy(dynamics_);
  dThreadingFreeImplementation(threading_);
}

dGeomID OdeWorld::ground_plane(hal::Vec2 at) const {
  const hal::Vec3 normal = ground_->normal(at);
  dGeomPlaneSetParams(ground_plane_, normal.x, normal.y, normal.z,
                      hal::dot(normal, on(*ground_, at)));
  return ground_plane_;
}

void OdeWorld::drop_contacts(std::size_t awake) {
  // An emptied group keeps its memory: without this, that of the first steps, in which every mote
  // is awake, would be kept for the whole run.
  most_awake_ = std::max(most_awake_, awake);
  if (2 * awake >= most_awake_) return dJointGroupEmpty(contacts_);
  most_awake_ = awake;
  dJointGroupDestroy(contacts_);
  contacts_ = dJointGroupCreate(0);
}

void OdeWorld::solve_exactly(double seconds) {
  message_count = &messages_;
  dWorldStep(dynamics_, seconds);
  message_count = nullptr;
}

void OdeWorld::solve_iteratively(double seconds, std::uint32_t seed) {
  message_count = &messages_;
  dRandSetSeed(seed);
  dWorldQuickStep(dynamics_, seconds);
  message_count = nullptr;
}

}  // namespace sim::physics
