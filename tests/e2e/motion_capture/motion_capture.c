/* A motion capture system: the truth about an emulated body, 50 times a second, as
 * geometry_msgs/PoseStamped of ROS 2, on Cyclone DDS.
 *
 *   motion_capture DOMAIN TOPIC FILE
 *
 * TOPIC as in DDS, e.g. rt/mocap/r0/pose. FILE: the state file of an emulator, with
 * "pose": [x, y, theta] (m, m, rad). While there is no such file, nothing is said.
 */
#include <dds/dds.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ros_messages.h"

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "motion_capture: %s: %s\n", what, dds_strretcode(entity));
  exit(1);
}

static int read_pose(const char* file, double* pose) {
  char text[4096];
  FILE* stream = fopen(file, "r");
  if (stream == NULL) return 0;
  text[fread(text, 1, sizeof text - 1, stream)] = '\0';
  fclose(stream);
  const char* found = strstr(text, "\"pose\": [");
  return found != NULL &&
         sscanf(found, "\"pose\": [%lf, %lf, %lf]", &pose[0], &pose[1], &pose[2]) == 3;
}

int main(int argc, char** argv) {
  if (argc != 4) {
    fprintf(stderr, "usage: motion_capture DOMAIN TOPIC FILE\n");
    return 2;
  }
  const dds_entity_t participant =
      checked(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL), "participant");
  const dds_entity_t topic =
      checked(dds_create_topic(participant, &geometry_msgs_msg_dds__PoseStamped__desc, argv[2],
                               NULL, NULL),
              "topic");
  const dds_entity_t writer = checked(dds_create_writer(participant, topic, NULL, NULL), "writer");
  double pose[3];
  while (1) {
    if (read_pose(argv[3], pose)) {
      const geometry_msgs_msg_dds__PoseStamped_ sample = {
          .header = {.stamp = {0, 0}, .frame_id = (char*)"world"},
          .pose = {.position = {pose[0], pose[1], 0},
                   .orientation = {0, 0, sin(pose[2] / 2), cos(pose[2] / 2)}}};
      checked(dds_write(writer, &sample), "write");
    }
    dds_sleepfor(DDS_MSECS(20));
  }
}
