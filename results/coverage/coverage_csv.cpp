#include "results/coverage/coverage_csv.h"

#include <fmt/format.h>

#include <iterator>

namespace results::coverage {

std::string coverage_csv(const Coverage& map) {
  std::string text = "x_m,y_m,z_m,best,rssi_dbm,snr_db,rate_mbps";
  auto out = std::back_inserter(text);
  for (const Transmitter& one : map.transmitters) fmt::format_to(out, ",rssi_dbm[{}]", one.name);
  text += '\n';
  std::size_t next = 0;
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      const hal::Vec2 place = map.centre(column, row);
      const Spot& spot = map.at(column, row);
      fmt::format_to(out, "{:.6g},{:.6g},{:.6g},{},{:.2f},{:.2f},{:g}", place.x, place.y,
                     map.height, map.transmitters[spot.best].name, spot.rssi.value, spot.snr.value,
                     spot.rate.value / 1e6);
      for (std::size_t i = 0; i < map.transmitters.size(); ++i)
        fmt::format_to(out, ",{:.2f}", map.rssi[next++]);
      text += '\n';
    }
  }
  return text;
}

}  // namespace results::coverage
