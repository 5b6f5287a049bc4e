/* A load on Cyclone DDS (options.c says how), which knows nothing of this project. Its
 * configuration is what CYCLONEDDS_URI names. */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "journal.h"
#include "sample.h"

#define TAKEN 16

typedef struct {
  dds_entity_t writer;
  load_Sample sample;
} Publisher;

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "cyclone_load: %s: %s\n", what, dds_strretcode(entity));
  exit(1);
}

static void on_data(dds_entity_t reader, void* context) {
  (void)context;
  void* samples[TAKEN] = {NULL};
  dds_sample_info_t infos[TAKEN];
  int count;
  while ((count = dds_take(reader, samples, infos, TAKEN, TAKEN)) > 0) {
    for (int i = 0; i < count; ++i) {
      const load_Sample* sample = samples[i];
      if (infos[i].valid_data)
        note_receive(sample->writer, sample->number, sample->bytes._length, sample->written_ns);
    }
    dds_return_loan(reader, samples, count);
  }
}

static void on_publication_matched(dds_entity_t writer, dds_publication_matched_status_t status,
                                   void* context) {
  (void)writer;
  (void)context;
  note_matched(true, status.current_count_change);
}

static void on_subscription_matched(dds_entity_t reader, dds_subscription_matched_status_t status,
                                    void* context) {
  (void)reader;
  (void)context;
  note_matched(false, status.current_count_change);
}

static dds_qos_t* endpoint_qos(const Options* options) {
  dds_qos_t* qos = dds_create_qos();
  const dds_duration_t blocking =
      options->blocking > 0 ? (dds_duration_t)(options->blocking * 1e9) : DDS_MSECS(100);
  if (options->reliability != kAsConfigured)
    dds_qset_reliability(
        qos,
        options->reliability == kReliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
        blocking);
  if (options->keep_all) dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
  if (options->keep_last > 0)
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, (int32_t)options->keep_last);
  dds_qset_ignorelocal(qos, DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

static bool write_sample(void* context, uint64_t number, int64_t written_ns) {
  Publisher* publisher = context;
  publisher->sample.number = number;
  publisher->sample.written_ns = written_ns;
  return dds_write(publisher->writer, &publisher->sample) == DDS_RETCODE_OK;
}

static void start_publisher(const Options* options, dds_entity_t participant, const dds_qos_t* qos,
                            Publisher* into) {
  const dds_entity_t topic = checked(
      dds_create_topic(participant, &load_Sample_desc, options->publish, NULL, NULL), "topic");
  dds_listener_t* listener = dds_create_listener(NULL);
  dds_lset_publication_matched(listener, on_publication_matched);
  into->writer = checked(dds_create_writer(participant, topic, qos, listener), "writer");
  dds_delete_listener(listener);
  into->sample.writer = options->writer;
  into->sample.bytes._buffer = calloc(options->size > 0 ? options->size : 1, 1);
  into->sample.bytes._length = into->sample.bytes._maximum = options->size;
}

static void start_subscriber(const Options* options, dds_entity_t participant,
                             const dds_qos_t* qos) {
  const dds_entity_t topic = checked(
      dds_create_topic(participant, &load_Sample_desc, options->subscribe, NULL, NULL), "topic");
  dds_listener_t* listener = dds_create_listener(NULL);
  dds_lset_data_available(listener, on_data);
  dds_lset_subscription_matched(listener, on_subscription_matched);
  checked(dds_create_reader(participant, topic, qos, listener), "reader");
  dds_delete_listener(listener);
}

int main(int argc, char** argv) {
  const Options options = read_options(argc, argv);
  open_journal(&options);
  note_created();
  const dds_entity_t participant =
      checked(dds_create_participant(options.domain, NULL, NULL), "participant");
  dds_qos_t* qos = endpoint_qos(&options);
  Publisher publisher;
  memset(&publisher, 0, sizeof publisher);
  if (options.subscribe != NULL) start_subscriber(&options, participant, qos);
  if (options.publish != NULL) start_publisher(&options, participant, qos, &publisher);
  dds_delete_qos(qos);
  run_load(write_sample, &publisher);
  const int status = close_journal();
  dds_delete(participant);
  free(publisher.sample.bytes._buffer);
  return status;
}
