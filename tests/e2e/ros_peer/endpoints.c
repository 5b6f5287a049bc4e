/* Readers and writers with any QoS, on Cyclone DDS: which of a run's endpoints they match, what they get of
 * them, and what the others say of themselves in discovery.
 *
 *   ros_endpoints DOMAIN KIND,TYPE,TOPIC,RELIABILITY,DURABILITY[,DEADLINE] ...   lines of JSON, until killed
 *
 * KIND: reader; writer, which writes zeros ten times a second; silent, a writer that writes nothing.
 * RELIABILITY: reliable or best_effort. DURABILITY: volatile or transient_local. DEADLINE: ms. Endpoints
 * are numbered from 0 in lines of these forms:
 *   {"endpoint": 0, "peer": "GUID", "participant": "GUID", "type": "…", "reliable": true, "kept": false}
 *   {"endpoint": 0, "incompatible": 1, "policy": 11}     by the number of the policy (OMG DDS 1.4, 2.3.3)
 *   {"endpoint": 0, "written": NS, …}                    a sample, with the time at which it was written
 *   {"participant": "GUID", "user_data": "…"}            of each participant that is discovered
 */
#include <dds/dds.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ros_messages.h"
#include "ros_types.h"

#define MAX_ENDPOINTS 32
#define MAX_PEERS 8

struct endpoint {
  const struct type* type;
  dds_entity_t entity;
  bool is_reader, is_silent;
  dds_instance_handle_t peers[MAX_PEERS]; /* those that were told */
  int peer_count;
  uint32_t incompatible;
};

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "ros_endpoints: %s: %s\n", what, dds_strretcode(entity));
  exit(1);
}

static dds_qos_t* qos_of(const char* reliability, const char* durability, const char* deadline) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos,
                       strcmp(reliability, "reliable") == 0 ? DDS_RELIABILITY_RELIABLE
                                                            : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_SECS(1));
  dds_qset_durability(qos, strcmp(durability, "transient_local") == 0
                               ? DDS_DURABILITY_TRANSIENT_LOCAL
                               : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 100);
  if (deadline != NULL) dds_qset_deadline(qos, DDS_MSECS(atoi(deadline)));
  return qos;
}

static struct endpoint make(dds_entity_t participant, char* text) {
  const char* word[6] = {NULL};
  int count = 0;
  for (char* one = strtok(text, ","); one != NULL && count < 6; one = strtok(NULL, ","))
    word[count++] = one;
  if (count < 5) {
    fprintf(stderr, "ros_endpoints: needs KIND,TYPE,TOPIC,RELIABILITY,DURABILITY\n");
    exit(2);
  }
  struct endpoint made = {.type = find_type(word[1]), .is_reader = strcmp(word[0], "reader") == 0,
                          .is_silent = strcmp(word[0], "silent") == 0};
  dds_qos_t* qos = qos_of(word[3], word[4], word[5]);
  const dds_entity_t topic =
      checked(dds_create_topic(participant, made.type->descriptor, word[2], NULL, NULL), "topic");
  made.entity = checked(made.is_reader ? dds_create_reader(participant, topic, qos, NULL)
                                       : dds_create_writer(participant, topic, qos, NULL),
                        "endpoint");
  dds_delete_qos(qos);
  return made;
}

static void tell_peer(int number, const dds_builtintopic_endpoint_t* peer) {
  printf("{\"endpoint\": %d, \"peer\": ", number);
  print_hex(peer->key.v, sizeof peer->key.v);
  printf(", \"participant\": ");
  print_hex(peer->participant_key.v, sizeof peer->participant_key.v);
  dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
  dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
  dds_qget_reliability(peer->qos, &reliability, NULL);
  dds_qget_durability(peer->qos, &durability);
  printf(", \"type\": \"%s\", \"reliable\": %s, \"kept\": %s}\n", peer->type_name,
         reliability == DDS_RELIABILITY_RELIABLE ? "true" : "false",
         durability == DDS_DURABILITY_TRANSIENT_LOCAL ? "true" : "false");
}

static bool was_told(const struct endpoint* one, dds_instance_handle_t peer) {
  for (int i = 0; i < one->peer_count; ++i)
    if (one->peers[i] == peer) return true;
  return false;
}

static void look_for_peers(int number, struct endpoint* one) {
  dds_instance_handle_t found[MAX_PEERS];
  const int count =
      one->is_reader
          ? checked(dds_get_matched_publications(one->entity, found, MAX_PEERS), "publications")
          : checked(dds_get_matched_subscriptions(one->entity, found, MAX_PEERS), "subscriptions");
  for (int i = 0; i < count && i < MAX_PEERS; ++i) {
    if (was_told(one, found[i]) || one->peer_count == MAX_PEERS) continue;
    dds_builtintopic_endpoint_t* peer =
        one->is_reader ? dds_get_matched_publication_data(one->entity, found[i])
                       : dds_get_matched_subscription_data(one->entity, found[i]);
    if (peer == NULL) continue;
    one->peers[one->peer_count++] = found[i];
    tell_peer(number, peer);
    dds_builtintopic_free_endpoint(peer);
  }
}

static void look_for_incompatible(int number, struct endpoint* one) {
  uint32_t total = 0, policy = 0;
  if (one->is_reader) {
    dds_requested_incompatible_qos_status_t status;
    dds_get_requested_incompatible_qos_status(one->entity, &status);
    total = status.total_count, policy = status.last_policy_id;
  } else {
    dds_offered_incompatible_qos_status_t status;
    dds_get_offered_incompatible_qos_status(one->entity, &status);
    total = status.total_count, policy = status.last_policy_id;
  }
  if (total == one->incompatible) return;
  one->incompatible = total;
  printf("{\"endpoint\": %d, \"incompatible\": %" PRIu32 ", \"policy\": %" PRIu32 "}\n", number,
         total, policy);
}

static void read_samples(int number, const struct endpoint* one) {
  void* samples[1] = {NULL};
  dds_sample_info_t status[1];
  while (checked(dds_take(one->entity, samples, status, 1, 1), "take") == 1) {
    if (status[0].valid_data && one->type->print != NULL) {
      printf("{\"endpoint\": %d, \"written\": %" PRId64 ", ", number, status[0].source_timestamp);
      one->type->print(samples[0]);
      printf("}\n");
    }
    dds_return_loan(one->entity, samples, 1);
  }
}

/* A sample of zeros; of the messages that are written here, those without text or sequences. */
static void write_sample(const struct endpoint* one) {
  const geometry_msgs_msg_dds__Twist_ twist = {0};
  const geometry_msgs_msg_dds__TwistStamped_ stamped = {.header = {.frame_id = (char*)""}};
  const void* sample = &twist;
  if (strcmp(one->type->name, "TwistStamped") == 0) sample = &stamped;
  checked(dds_write(one->entity, sample), "write");
}

static void look_for_participants(dds_entity_t reader) {
  void* samples[1] = {NULL};
  dds_sample_info_t status[1];
  while (checked(dds_take(reader, samples, status, 1, 1), "take participants") == 1) {
    const dds_builtintopic_participant_t* one = samples[0];
    void* data = NULL;
    size_t size = 0;
    if (status[0].valid_data && dds_qget_userdata(one->qos, &data, &size)) {
      printf("{\"participant\": ");
      print_hex(one->key.v, sizeof one->key.v);
      printf(", \"user_data\": ");
      print_hex(data, size);
      printf("}\n");
      dds_free(data);
    }
    dds_return_loan(reader, samples, 1);
  }
}

int main(int argc, char** argv) {
  if (argc < 3 || argc - 2 > MAX_ENDPOINTS) {
    fprintf(stderr, "usage: ros_endpoints DOMAIN KIND,TYPE,TOPIC,RELIABILITY,DURABILITY ...\n");
    return 2;
  }
  const dds_entity_t participant =
      checked(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL), "participant");
  const dds_entity_t participants = checked(
      dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, NULL, NULL), "built-in");
  struct endpoint endpoints[MAX_ENDPOINTS];
  const int count = argc - 2;
  for (int i = 0; i < count; ++i) endpoints[i] = make(participant, argv[i + 2]);
  for (unsigned cycle = 0; true; ++cycle) {
    look_for_participants(participants);
    for (int i = 0; i < count; ++i) {
      look_for_peers(i, &endpoints[i]);
      look_for_incompatible(i, &endpoints[i]);
      if (endpoints[i].is_reader) read_samples(i, &endpoints[i]);
      else if (!endpoints[i].is_silent && cycle % 10 == 0) write_sample(&endpoints[i]);
    }
    fflush(stdout);
    dds_sleepfor(DDS_MSECS(10));
  }
}
