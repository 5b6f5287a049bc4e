/* The messages of ros_messages.idl by their names in ROS 2, and how a sample is printed as the inside of a
 * JSON object. */
#include "ros_types.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ros_messages.h"

/* ---- printing ------------------------------------------------------------------------------- */

/* JSON has no infinity: as Python's json module reads it. */
static void print_number(double value) {
  if (isnan(value)) printf("NaN");
  else if (isinf(value)) printf("%sInfinity", value < 0 ? "-" : "");
  else printf("%.17g", value);
}

static void print_text(const char* key, const char* text) {
  printf("\"%s\": \"", key);
  for (; *text != '\0'; ++text) {
    const unsigned char c = (unsigned char)*text;
    if (c == '"' || c == '\\') printf("\\%c", c);
    else if (c < 0x20) printf("\\u%04x", c);
    else putchar(c);
  }
  printf("\"");
}

static void print_stamp(const builtin_interfaces_msg_dds__Time_* t) {
  printf("\"t\": %" PRId64, (int64_t)t->sec * 1000000000 + t->nanosec);
}

static void print_numbers(const char* key, const double* values, int count) {
  printf(", \"%s\": [", key);
  for (int i = 0; i < count; ++i) {
    if (i > 0) printf(", ");
    print_number(values[i]);
  }
  printf("]");
}

static void print_clock(const void* sample) {
  print_stamp(&((const rosgraph_msgs_msg_dds__Clock_*)sample)->clock);
}

static void print_transforms(const void* sample) {
  const tf2_msgs_msg_dds__TFMessage_* message = sample;
  printf("\"transforms\": [");
  for (uint32_t i = 0; i < message->transforms._length; ++i) {
    const geometry_msgs_msg_dds__TransformStamped_* one = &message->transforms._buffer[i];
    printf("%s{", i > 0 ? ", " : "");
    print_stamp(&one->header.stamp);
    printf(", \"parent\": \"%s\", \"child\": \"%s\"", one->header.frame_id, one->child_frame_id);
    print_numbers("translation", &one->transform.translation.x, 3);
    print_numbers("rotation", &one->transform.rotation.x, 4);
    printf("}");
  }
  printf("]");
}

static void print_odometry(const void* sample) {
  const nav_msgs_msg_dds__Odometry_* message = sample;
  print_stamp(&message->header.stamp);
  printf(", \"frame\": \"%s\", \"child\": \"%s\"", message->header.frame_id,
         message->child_frame_id);
  print_numbers("position", &message->pose.pose.position.x, 3);
  print_numbers("orientation", &message->pose.pose.orientation.x, 4);
  print_numbers("linear", &message->twist.twist.linear.x, 3);
  print_numbers("angular", &message->twist.twist.angular.x, 3);
  print_numbers("pose_covariance", message->pose.covariance, 36);
  print_numbers("twist_covariance", message->twist.covariance, 36);
}

static void print_range(const void* sample) {
  const sensor_msgs_msg_dds__Range_* message = sample;
  print_stamp(&message->header.stamp);
  printf(", \"frame\": \"%s\", \"radiation_type\": %u", message->header.frame_id,
         message->radiation_type);
  const double values[] = {message->field_of_view, message->min_range, message->max_range,
                           message->range};
  print_numbers("values", values, 4);
}

static void print_scan(const void* sample) {
  const sensor_msgs_msg_dds__LaserScan_* message = sample;
  print_stamp(&message->header.stamp);
  printf(", \"frame\": \"%s\"", message->header.frame_id);
  const double angles[] = {message->angle_min, message->angle_max, message->angle_increment,
                           message->time_increment, message->scan_time};
  print_numbers("angles", angles, 5);
  const double limits[] = {message->range_min, message->range_max};
  print_numbers("limits", limits, 2);
  printf(", \"ranges\": [");
  for (uint32_t i = 0; i < message->ranges._length; ++i) {
    if (i > 0) printf(", ");
    print_number(message->ranges._buffer[i]);
  }
  printf("]");
}

static void print_pose(const void* sample) {
  const geometry_msgs_msg_dds__PoseStamped_* message = sample;
  print_stamp(&message->header.stamp);
  printf(", \"frame\": \"%s\"", message->header.frame_id);
  print_numbers("position", &message->pose.position.x, 3);
  print_numbers("orientation", &message->pose.orientation.x, 4);
}

static void print_bool(const void* sample) {
  printf("\"data\": %s", ((const std_msgs_msg_dds__Bool_*)sample)->data ? "true" : "false");
}

static void print_imu(const void* sample) {
  const sensor_msgs_msg_dds__Imu_* message = sample;
  print_stamp(&message->header.stamp);
  printf(", \"frame\": \"%s\"", message->header.frame_id);
  print_numbers("orientation_covariance", message->orientation_covariance, 9);
  print_numbers("angular", &message->angular_velocity.x, 3);
  print_numbers("linear", &message->linear_acceleration.x, 3);
}

static void print_battery(const void* sample) {
  const sensor_msgs_msg_dds__BatteryState_* message = sample;
  print_stamp(&message->header.stamp);
  printf(", \"frame\": \"%s\", \"present\": %d", message->header.frame_id, message->present);
  const double values[] = {message->voltage, message->current, message->percentage};
  print_numbers("values", values, 3);
}

static void print_markers(const void* sample) {
  const visualization_msgs_msg_dds__MarkerArray_* message = sample;
  printf("\"markers\": [");
  for (uint32_t i = 0; i < message->markers._length; ++i) {
    const visualization_msgs_msg_dds__Marker_* one = &message->markers._buffer[i];
    printf("%s{", i > 0 ? ", " : "");
    print_stamp(&one->header.stamp);
    printf(", \"frame\": \"%s\", \"ns\": \"%s\", \"id\": %d, \"type\": %d, \"action\": %d",
           one->header.frame_id, one->ns, (int)one->id, (int)one->type, (int)one->action);
    print_numbers("position", &one->pose.position.x, 3);
    print_numbers("orientation", &one->pose.orientation.x, 4);
    print_numbers("scale", &one->scale.x, 3);
    const double colour[] = {one->color.r, one->color.g, one->color.b, one->color.a};
    print_numbers("colour", colour, 4);
    printf(", \"rest\": %u}", one->points._length + one->colors._length +
                                  one->texture.data._length + one->uv_coordinates._length +
                                  one->mesh_file.data._length +
                                  (unsigned)one->mesh_use_embedded_materials);
  }
  printf("]");
}

static void print_string(const void* sample) {
  print_text("data", ((const std_msgs_msg_dds__String_*)sample)->data);
}

static void print_joints(const void* sample) {
  const sensor_msgs_msg_dds__JointState_* message = sample;
  print_stamp(&message->header.stamp);
  printf(", \"frame\": \"%s\", \"names\": [", message->header.frame_id);
  for (uint32_t i = 0; i < message->name._length; ++i)
    printf("%s\"%s\"", i > 0 ? ", " : "", message->name._buffer[i]);
  printf("]");
  print_numbers("position", message->position._buffer, (int)message->position._length);
  print_numbers("velocity", message->velocity._buffer, (int)message->velocity._length);
  print_numbers("effort", message->effort._buffer, (int)message->effort._length);
}

static void print_diagnostics(const void* sample) {
  const diagnostic_msgs_msg_dds__DiagnosticArray_* message = sample;
  print_stamp(&message->header.stamp);
  printf(", \"status\": [");
  for (uint32_t i = 0; i < message->status._length; ++i) {
    const diagnostic_msgs_msg_dds__DiagnosticStatus_* one = &message->status._buffer[i];
    printf("%s{\"level\": %u, ", i > 0 ? ", " : "", one->level);
    print_text("name", one->name);
    printf(", ");
    print_text("message", one->message);
    printf(", ");
    print_text("hardware_id", one->hardware_id);
    printf(", \"values\": {");
    for (uint32_t k = 0; k < one->values._length; ++k) {
      if (k > 0) printf(", ");
      print_text(one->values._buffer[k].key, one->values._buffer[k].value);
    }
    printf("}}");
  }
  printf("]");
}

void print_hex(const uint8_t* bytes, size_t count) {
  printf("\"");
  for (size_t i = 0; i < count; ++i) printf("%02x", bytes[i]);
  printf("\"");
}

static void print_gids(const char* key, uint32_t count, const rmw_dds_common_msg_dds__Gid_* gids) {
  printf(", \"%s\": [", key);
  for (uint32_t i = 0; i < count; ++i) {
    if (i > 0) printf(", ");
    print_hex(gids[i].data, sizeof gids[i].data);
  }
  printf("]");
}

static void print_entities(const void* sample) {
  const rmw_dds_common_msg_dds__ParticipantEntitiesInfo_* message = sample;
  printf("\"gid\": ");
  print_hex(message->gid.data, sizeof message->gid.data);
  printf(", \"nodes\": [");
  for (uint32_t i = 0; i < message->node_entities_info_seq._length; ++i) {
    const rmw_dds_common_msg_dds__NodeEntitiesInfo_* one =
        &message->node_entities_info_seq._buffer[i];
    printf("%s{", i > 0 ? ", " : "");
    print_text("namespace", one->node_namespace);
    printf(", ");
    print_text("name", one->node_name);
    print_gids("readers", one->reader_gid_seq._length, one->reader_gid_seq._buffer);
    print_gids("writers", one->writer_gid_seq._length, one->writer_gid_seq._buffer);
    printf("}");
  }
  printf("]");
}

/* ---- types ---------------------------------------------------------------------------------- */

static const struct type types[] = {
    {"Clock", &rosgraph_msgs_msg_dds__Clock__desc, print_clock},
    {"TFMessage", &tf2_msgs_msg_dds__TFMessage__desc, print_transforms},
    {"Odometry", &nav_msgs_msg_dds__Odometry__desc, print_odometry},
    {"Range", &sensor_msgs_msg_dds__Range__desc, print_range},
    {"Imu", &sensor_msgs_msg_dds__Imu__desc, print_imu},
    {"BatteryState", &sensor_msgs_msg_dds__BatteryState__desc, print_battery},
    {"MarkerArray", &visualization_msgs_msg_dds__MarkerArray__desc, print_markers},
    {"LaserScan", &sensor_msgs_msg_dds__LaserScan__desc, print_scan},
    {"Twist", &geometry_msgs_msg_dds__Twist__desc, NULL},
    {"PoseStamped", &geometry_msgs_msg_dds__PoseStamped__desc, print_pose},
    {"Bool", &std_msgs_msg_dds__Bool__desc, print_bool},
    {"String", &std_msgs_msg_dds__String__desc, print_string},
    {"TwistStamped", &geometry_msgs_msg_dds__TwistStamped__desc, NULL},
    {"JointState", &sensor_msgs_msg_dds__JointState__desc, print_joints},
    {"DiagnosticArray", &diagnostic_msgs_msg_dds__DiagnosticArray__desc, print_diagnostics},
    {"ParticipantEntitiesInfo", &rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc,
     print_entities},
};

const struct type* find_type(const char* name) {
  for (size_t i = 0; i < sizeof types / sizeof types[0]; ++i) {
    if (strcmp(types[i].name, name) == 0) return &types[i];
  }
  fprintf(stderr, "ros_peer: no type %s\n", name);
  exit(2);
}
