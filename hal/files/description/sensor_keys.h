#pragma once

#include "hal/files/description/fields.h"
#include "hal/node/devices/sensors.h"

/// The keys of each kind of sensor in `sensors:`.
namespace hal::files::description {

void keys_of(Fields& io, node::devices::Battery& battery);
void keys_of(Fields& io, node::devices::Bumper& bumper);
void keys_of(Fields& io, node::devices::ImuSensor& imu);
void keys_of(Fields& io, node::devices::PoseSensor& pose);
void keys_of(Fields& io, node::devices::ScanSensor& scan);
void keys_of(Fields& io, node::devices::Sonar& sonar);

/// `name` of a sensor without a position.
void name_key(Fields& io, node::devices::Mount& mount);

/// `name`, `position` and `heading` of a sensor.
void keys_of(Fields& io, node::devices::Mount& mount);

}  // namespace hal::files::description
