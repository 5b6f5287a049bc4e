#include "results/report/report_page_queues.h"

#include "results/report/queue_sums.h"
#include "results/report/relay_sums.h"

namespace results::report {

nlohmann::ordered_json relays_json(const Group& group) {
  auto relays = nlohmann::ordered_json::array();
  for (const RelaySums& one : relay_sums(group)) {
    relays.push_back({{"access_point", one.access_point},
                      {"destination", one.destination},
                      {"verdicts", one.verdicts},
                      {"queued", one.queued},
                      {"most", one.most},
                      {"waited_ns", one.waited_ns}});
  }
  return relays;
}

nlohmann::ordered_json queues_json(const Group& group) {
  auto queues = nlohmann::ordered_json::array();
  for (const QueueSums& one : queue_sums(group)) {
    queues.push_back({{"agent", one.agent},
                      {"receiver", one.receiver},
                      {"category", one.category},
                      {"frames", one.all.frames},
                      {"waiting", one.all.waiting},
                      {"most", one.all.most},
                      {"most_bytes", one.all.most_bytes},
                      {"waited_ns", one.all.waited_ns},
                      {"drops", one.all.drops}});
  }
  return queues;
}

}  // namespace results::report
