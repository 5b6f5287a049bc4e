#include "baraka/run/network/priority.h"

#include <sched.h>

namespace baraka::run::network {

void go_before_others(bool before) {
  sched_param parameters{};
  parameters.sched_priority = before ? ::sched_get_priority_min(SCHED_RR) : 0;
  (void)::sched_setscheduler(0, (before ? SCHED_RR : SCHED_OTHER) | SCHED_RESET_ON_FORK,
                             &parameters);
}

void let_others_finish() {
  const sched_param parameters{};
  (void)::sched_setscheduler(0, SCHED_BATCH, &parameters);
}

}  // namespace baraka::run::network
