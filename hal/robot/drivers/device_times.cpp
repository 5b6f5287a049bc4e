#include "hal/robot/drivers/device_times.h"

namespace hal::robot::drivers {

void times_keys(files::description::Fields& io, DeviceTimes& times, double longest_period) {
  io.duration({"period", "Time between two requests to the device.", "50 ms"},
              {1e-3, longest_period}, times.period);
  io.duration({"timeout", "Longest time to wait for an answer.", "150 ms"}, {1e-3, 10},
              times.timeout);
  io.duration({"stale_after", "Age after which a reading is no longer used; longer than `period`.",
               "500 ms"},
              {1e-3, 60}, times.stale_after);
  if (times.stale_after <= times.period)
    io.mistake("stale_after", "must be longer than period: no reading would ever be fresh");
}

}  // namespace hal::robot::drivers
