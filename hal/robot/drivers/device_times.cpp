#include "hal/robot/drivers/device_times.h"

namespace hal::robot::drivers {

DeviceTimes read_times(files::config::Mapping& in, DeviceTimes times, double longest_period) {
  times.period =
      in.duration({"period", "Between two commands to, or questions of, the device.", "50 ms"},
                  {1e-3, longest_period}, times.period);
  times.timeout = in.duration({"timeout", "How long to wait for an answer.", "150 ms"}, {1e-3, 10},
                              times.timeout);
  times.stale_after =
      in.duration({"stale_after", "Older readings are not used; longer than `period`.", "500 ms"},
                  {1e-3, 60}, times.stale_after);
  if (times.stale_after <= times.period) {
    in.mistake("stale_after", "must be longer than period: no reading would ever be fresh");
  }
  return times;
}

}  // namespace hal::robot::drivers
