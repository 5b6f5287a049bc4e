/* Drives a robot's base to a goal, on Cyclone DDS, by ROS 2's names only: where the base is it takes from
 * /tf and /odom, where its scanner is from /tf_static, what stands in its way from /scan, and it commands by
 * /cmd_vel ten times a second, whether it hears of the base or not.
 *
 *   ros_navigator DOMAIN X Y   goal in the frame odom, m; a line of JSON when the base stands there
 *
 * Of 37 directions ahead it takes the one nearest to the goal's in which the lane is free.
 */
#include <dds/dds.h>
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ros_messages.h"

#define MAX_POINTS 1000
static const double kSpeed = 0.2, kTurn = 1.5;       /* m/s; rad/s per rad */
static const double kLane = 0.22, kLookAhead = 0.8;  /* m: half the width; how far it must be free */
static const double kNear = 0.1;                     /* m from the goal */
static const double kStep = 5 * 3.14159265358979323846 / 180;

struct frame {
  double x, y, yaw; /* m, m, rad in its parent */
  bool is_known;
};

struct state {
  struct frame base, link, scanner; /* in odom, in the base, in the link */
  double speed;                     /* m/s, as /odom tells it */
  bool told_speed;
  double points[MAX_POINTS][2]; /* m, of the last scan, in the base */
  int point_count;
};

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "ros_navigator: %s: %s\n", what, dds_strretcode(entity));
  exit(1);
}

static dds_entity_t endpoint(dds_entity_t participant, const dds_topic_descriptor_t* type,
                             const char* name, bool reliable, bool kept, bool is_writer) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_SECS(1));
  dds_qset_durability(qos, kept ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  const dds_entity_t topic = checked(dds_create_topic(participant, type, name, NULL, NULL), "topic");
  const dds_entity_t made = checked(is_writer ? dds_create_writer(participant, topic, qos, NULL)
                                              : dds_create_reader(participant, topic, qos, NULL),
                                    name);
  dds_delete_qos(qos);
  return made;
}

static double yaw_of(const geometry_msgs_msg_dds__Quaternion_* q) {
  return atan2(2 * (q->w * q->z + q->x * q->y), 1 - 2 * (q->y * q->y + q->z * q->z));
}

static void take_transforms(struct state* state, const void* sample) {
  const tf2_msgs_msg_dds__TFMessage_* message = sample;
  for (uint32_t i = 0; i < message->transforms._length; ++i) {
    const geometry_msgs_msg_dds__TransformStamped_* one = &message->transforms._buffer[i];
    const struct frame frame = {one->transform.translation.x, one->transform.translation.y,
                                yaw_of(&one->transform.rotation), true};
    if (strcmp(one->header.frame_id, "odom") == 0) state->base = frame;
    if (strcmp(one->child_frame_id, "base_link") == 0) state->link = frame;
    if (strcmp(one->child_frame_id, "base_scan") == 0) state->scanner = frame;
  }
}

static void take_odometry(struct state* state, const void* sample) {
  const nav_msgs_msg_dds__Odometry_* message = sample;
  state->speed = hypot(message->twist.twist.linear.x, message->twist.twist.linear.y);
  state->told_speed = true;
}

static void to_parent(const struct frame* frame, double* x, double* y) {
  const double c = cos(frame->yaw), s = sin(frame->yaw), px = *x, py = *y;
  *x = frame->x + c * px - s * py;
  *y = frame->y + s * px + c * py;
}

static void take_scan(struct state* state, const void* sample) {
  const sensor_msgs_msg_dds__LaserScan_* message = sample;
  if (!state->scanner.is_known || !state->link.is_known) return;
  state->point_count = 0;
  for (uint32_t i = 0; i < message->ranges._length && state->point_count < MAX_POINTS; ++i) {
    const double range = message->ranges._buffer[i];
    if (!(range >= message->range_min && range <= message->range_max)) continue;
    const double angle = message->angle_min + i * message->angle_increment;
    double x = range * cos(angle), y = range * sin(angle);
    to_parent(&state->scanner, &x, &y);
    to_parent(&state->link, &x, &y);
    state->points[state->point_count][0] = x;
    state->points[state->point_count][1] = y;
    ++state->point_count;
  }
}

static void take_all(dds_entity_t reader, struct state* state,
                     void (*take)(struct state* state, const void* sample)) {
  void* samples[1] = {NULL};
  dds_sample_info_t status[1];
  while (checked(dds_take(reader, samples, status, 1, 1), "take") == 1) {
    if (status[0].valid_data) take(state, samples[0]);
    dds_return_loan(reader, samples, 1);
  }
}

static bool is_free(const struct state* state, double direction, double distance) {
  const double c = cos(direction), s = sin(direction);
  for (int i = 0; i < state->point_count; ++i) {
    const double* p = state->points[i];
    const double along = c * p[0] + s * p[1], across = c * p[1] - s * p[0];
    if (along > 0 && along < fmin(distance, kLookAhead) && fabs(across) < kLane) return false;
  }
  return true;
}

static double towards(const struct state* state, double direction, double distance) {
  for (int k = 0; k <= 18; ++k) {
    for (int side = -1; side <= 1; side += 2) {
      const double one = direction + side * k * kStep;
      if (fabs(one) < 1.6 && is_free(state, one, distance)) return one;
    }
  }
  return direction;
}

static geometry_msgs_msg_dds__Twist_ command(const struct state* state, double x, double y) {
  geometry_msgs_msg_dds__Twist_ twist = {0};
  if (!state->base.is_known) return twist;
  const double dx = x - state->base.x, dy = y - state->base.y, distance = hypot(dx, dy);
  if (distance < kNear) return twist;
  const double bearing = remainder(atan2(dy, dx) - state->base.yaw, 6.283185307179586);
  const double turn = towards(state, bearing, distance);
  twist.angular.z = fmax(-1, fmin(1, kTurn * turn));
  twist.linear.x = fabs(turn) < 0.8 ? kSpeed * cos(turn) : 0;
  return twist;
}

int main(int argc, char** argv) {
  if (argc != 4) {
    fprintf(stderr, "usage: ros_navigator DOMAIN X Y\n");
    return 2;
  }
  const double x = atof(argv[2]), y = atof(argv[3]);
  const dds_entity_t me =
      checked(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL), "participant");
  const dds_entity_t tf =
      endpoint(me, &tf2_msgs_msg_dds__TFMessage__desc, "rt/tf", true, false, false);
  const dds_entity_t tf_static =
      endpoint(me, &tf2_msgs_msg_dds__TFMessage__desc, "rt/tf_static", true, true, false);
  const dds_entity_t odom =
      endpoint(me, &nav_msgs_msg_dds__Odometry__desc, "rt/odom", false, false, false);
  const dds_entity_t scan =
      endpoint(me, &sensor_msgs_msg_dds__LaserScan__desc, "rt/scan", false, false, false);
  const dds_entity_t cmd_vel =
      endpoint(me, &geometry_msgs_msg_dds__Twist__desc, "rt/cmd_vel", true, false, true);
  static struct state state;
  bool is_there = false;
  for (unsigned cycle = 0; true; ++cycle) {
    take_all(tf, &state, take_transforms);
    take_all(tf_static, &state, take_transforms);
    take_all(odom, &state, take_odometry);
    take_all(scan, &state, take_scan);
    const geometry_msgs_msg_dds__Twist_ twist = command(&state, x, y);
    checked(dds_write(cmd_vel, &twist), "write");
    const bool stands = twist.linear.x == 0 && state.base.is_known && state.told_speed &&
                        state.speed < 0.005 && hypot(x - state.base.x, y - state.base.y) < kNear;
    if (stands && !is_there)
      printf("{\"reached\": true, \"x\": %.3f, \"y\": %.3f}\n", state.base.x, state.base.y);
    is_there = stands;
    if (cycle % 10 == 0)
      printf("{\"x\": %.3f, \"y\": %.3f, \"yaw\": %.3f, \"points\": %d, \"v\": %.3f, \"omega\": %.3f}\n",
             state.base.x, state.base.y, state.base.yaw, state.point_count, twist.linear.x,
             twist.angular.z);
    fflush(stdout);
    dds_sleepfor(DDS_MSECS(100));
  }
}
