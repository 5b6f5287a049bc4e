#include "agentd/radio.h"

#include <fmt/format.h>
#include <net/if.h>

#include <system_error>

#include "hal/files/config/errors.h"

namespace agentd {
namespace {

/// @param place  a position on the command line names the key itself.
[[noreturn]] void refuse(const std::string& place, const char* key, const std::string& what) {
  const bool is_in_file = !place.starts_with("--set");
  throw hal::files::config::ConfigErrors(
      {fmt::format("{}: {}{}", place, is_in_file ? fmt::format("{}: ", key) : "", what)});
}

}  // namespace

hal::robot::radio::UdpLink open_radio(const hal::robot::agent::RobotFile& file,
                                      hal::robot::platform::EventLoop& loop) {
  const hal::robot::agent::RadioSettings& radio = file.radio;
  try {
    return {{.self = file.address,
             .interface = radio.interface,
             .address = radio.address,
             .port = radio.port,
             .bit_rate = radio.bit_rate,
             .power = radio.power},
            loop};
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::permission_denied) throw;
    refuse(file.radio_places.port, "radio.port", error.what());
  } catch (const std::runtime_error& error) {
    const bool is_address =
        !radio.address.empty() && ::if_nametoindex(radio.interface.c_str()) != 0;
    if (is_address) refuse(file.radio_places.address, "radio.address", error.what());
    refuse(file.radio_places.interface, "radio.interface", error.what());
  }
}

void require_air_interface(const hal::robot::agent::RobotFile& file) {
  if (file.air_interface.empty() || ::if_nametoindex(file.air_interface.c_str()) != 0) return;
  refuse(file.air_interface_place, "controller.air_interface",
         fmt::format("there is no network interface '{}' here", file.air_interface));
}

}  // namespace agentd
