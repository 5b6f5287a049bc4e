/* A program on Cyclone DDS that knows only ROS 2's messages: what a ROS 2 node sees of a run, and
 * says to it.
 *
 *   ros_peer read DOMAIN TYPE TOPIC [TYPE TOPIC ...]   a line of JSON per sample, until killed
 *   ros_peer hold DOMAIN TYPE TOPIC [TYPE TOPIC ...]   readers that never take a sample
 *   ros_peer write DOMAIN TYPE TOPIC HZ VALUE ...      the same sample again and again, until killed
 *   ros_peer switch DOMAIN Bool TOPIC                  a sample per 0 or 1 on standard input
 *
 * TYPE: Clock, TFMessage, Odometry, Range, LaserScan, Imu, BatteryState, MarkerArray, String, JointState,
 * DiagnosticArray, ParticipantEntitiesInfo; to write: Twist (vx vy omega), PoseStamped (x y z, qx qy qz qw),
 * Bool (0 or 1), String (the value is not looked at: "hello"). "ready" goes to standard error when it looks
 * for the others; `switch` has found one then.
 */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ros_messages.h"
#include "ros_types.h"

#define MAX_TOPICS 16
#define MAX_VALUES 8

static void die(const char* what, dds_return_t code) {
  fprintf(stderr, "ros_peer: %s: %s\n", what, code < 0 ? dds_strretcode(code) : "");
  exit(1);
}

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity < 0) die(what, entity);
  return entity;
}

static dds_qos_t* reliable_qos(int kept_for_latecomers, int keep_all) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos,
                      kept_for_latecomers ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, keep_all ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST, 1000);
  if (keep_all) dds_qset_resource_limits(qos, 20, 1, 20); /* soon full */
  return qos;
}

/* ---- commands ------------------------------------------------------------------------------- */

struct reading {
  const struct type* type;
  const char* topic;
  dds_entity_t reader;
};

/* Whether late readers of the topic want what was written before. */
static int is_kept(const char* topic) {
  return strstr(topic, "static") != NULL || strstr(topic, "markers") != NULL;
}

static int make_readers(dds_entity_t participant, int argc, char** argv, int keep_all,
                        struct reading* readings) {
  int count = 0;
  for (int i = 0; i + 1 < argc && count < MAX_TOPICS; i += 2) {
    struct reading* reading = &readings[count++];
    reading->type = find_type(argv[i]);
    reading->topic = argv[i + 1];
    dds_qos_t* qos = reliable_qos(is_kept(reading->topic), keep_all);
    const dds_entity_t topic = checked(
        dds_create_topic(participant, reading->type->descriptor, reading->topic, NULL, NULL),
        "topic");
    reading->reader = checked(dds_create_reader(participant, topic, qos, NULL), "reader");
    dds_delete_qos(qos);
  }
  return count;
}

static void print_samples(const struct reading* reading) {
  void* samples[1] = {NULL};
  dds_sample_info_t status[1];
  while (1) {
    const dds_return_t taken = dds_take(reading->reader, samples, status, 1, 1);
    if (taken < 0) die("take", taken);
    if (taken == 0) return;
    if (status[0].valid_data) {
      printf("{\"topic\": \"%s\", ", reading->topic);
      reading->type->print(samples[0]);
      printf("}\n");
    }
    dds_return_loan(reading->reader, samples, taken);
  }
}

static int read_samples(dds_entity_t participant, int argc, char** argv) {
  struct reading readings[MAX_TOPICS];
  const int count = make_readers(participant, argc, argv, 0, readings);
  fprintf(stderr, "ready\n");
  while (1) {
    for (int i = 0; i < count; ++i) print_samples(&readings[i]);
    fflush(stdout);
    dds_sleepfor(DDS_MSECS(2));
  }
}

static int hold_samples(dds_entity_t participant, int argc, char** argv) {
  struct reading readings[MAX_TOPICS];
  const int count = make_readers(participant, argc, argv, 1, readings);
  fprintf(stderr, "ready\n");
  int full = 0;
  while (1) {
    int matched = 0;
    for (int i = 0; i < count; ++i) {
      dds_subscription_matched_status_t status;
      dds_get_subscription_matched_status(readings[i].reader, &status);
      matched += status.current_count > 0;
      dds_sample_rejected_status_t rejected;
      dds_get_sample_rejected_status(readings[i].reader, &rejected);
      full += rejected.total_count_change > 0;
    }
    printf("{\"matched\": %d, \"rejections\": %d}\n", matched, full);
    fflush(stdout);
    dds_sleepfor(DDS_MSECS(20));
  }
}

static dds_entity_t make_writer(dds_entity_t participant, const struct type* type, const char* name) {
  dds_qos_t* qos = reliable_qos(0, 0);
  const dds_entity_t topic =
      checked(dds_create_topic(participant, type->descriptor, name, NULL, NULL), "topic");
  const dds_entity_t writer = checked(dds_create_writer(participant, topic, qos, NULL), "writer");
  dds_delete_qos(qos);
  return writer;
}

static int switch_on_and_off(dds_entity_t participant, int argc, char** argv) {
  if (argc != 2 || strcmp(argv[0], "Bool") != 0) return 2;
  const dds_entity_t writer = make_writer(participant, find_type(argv[0]), argv[1]);
  dds_publication_matched_status_t matched = {0};
  while (matched.current_count == 0) {
    dds_get_publication_matched_status(writer, &matched);
    dds_sleepfor(DDS_MSECS(2));
  }
  fprintf(stderr, "ready\n");
  for (int c = getchar(); c != EOF; c = getchar()) {
    if (c != '0' && c != '1') continue;
    const std_msgs_msg_dds__Bool_ flag = {.data = c == '1'};
    const dds_return_t written = dds_write(writer, &flag);
    if (written < 0) die("write", written);
  }
  return 0;
}

static int write_sample(dds_entity_t participant, int argc, char** argv) {
  if (argc < 4) return 2;
  const struct type* type = find_type(argv[0]);
  const double hz = atof(argv[2]);
  double v[MAX_VALUES] = {0};
  for (int i = 3; i < argc && i - 3 < MAX_VALUES; ++i) v[i - 3] = atof(argv[i]);
  geometry_msgs_msg_dds__Twist_ twist = {.linear = {v[0], v[1], 0}, .angular = {0, 0, v[2]}};
  geometry_msgs_msg_dds__PoseStamped_ pose = {
      .header = {.stamp = {12, 500000000}, .frame_id = (char*)"map"},
      .pose = {.position = {v[0], v[1], v[2]}, .orientation = {v[3], v[4], v[5], v[6]}}};
  std_msgs_msg_dds__Bool_ flag = {.data = v[0] != 0};
  std_msgs_msg_dds__String_ text = {.data = (char*)"hello"};
  const void* sample = &flag;
  if (strcmp(type->name, "Twist") == 0) sample = &twist;
  if (strcmp(type->name, "PoseStamped") == 0) sample = &pose;
  if (strcmp(type->name, "String") == 0) sample = &text;
  const dds_entity_t writer = make_writer(participant, type, argv[1]);
  fprintf(stderr, "ready\n");
  while (1) {
    const dds_return_t written = dds_write(writer, sample);
    if (written < 0) die("write", written);
    dds_sleepfor((dds_duration_t)(1e9 / hz));
  }
}

int main(int argc, char** argv) {
  if (argc < 5) {
    fprintf(stderr, "usage: ros_peer read|hold|write|switch DOMAIN TYPE TOPIC ...\n");
    return 2;
  }
  const dds_entity_t participant =
      checked(dds_create_participant((dds_domainid_t)atoi(argv[2]), NULL, NULL), "participant");
  if (strcmp(argv[1], "read") == 0) return read_samples(participant, argc - 3, argv + 3);
  if (strcmp(argv[1], "hold") == 0) return hold_samples(participant, argc - 3, argv + 3);
  if (strcmp(argv[1], "write") == 0) return write_sample(participant, argc - 3, argv + 3);
  if (strcmp(argv[1], "switch") == 0) {
    return switch_on_and_off(participant, argc - 3, argv + 3);
  }
  fprintf(stderr, "ros_peer: no command %s\n", argv[1]);
  return 2;
}
