#include "results/report/link_trace.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "results/record/run_reader.h"

namespace results::report {
namespace {

constexpr std::string_view kPowers =
    "SELECT s.name, r.name, f.at_ns, avg(e.rssi_dbm) FROM frame_ends e "
    "JOIN frames f USING (frame) JOIN agents s ON s.agent = f.transmitter "
    "JOIN agents r ON r.agent = e.agent WHERE e.rssi_dbm IS NOT NULL "
    "GROUP BY f.at_ns, f.transmitter, e.agent ORDER BY f.at_ns, f.transmitter, e.agent";

}  // namespace

void write_link_trace(const std::filesystem::path& folder,
                      const std::function<void(std::string_view)>& write) {
  record::RunReader reader(folder);
  auto query = reader.query(kPowers);
  bool has_rows = false;
  while (query.next()) {
    if (!has_rows) write("from,to,time_s,rssi_dbm\n");
    has_rows = true;
    const double at = static_cast<double>(query.integer(2)) * 1e-9;
    write(fmt::format("{},{},{:.6f},{:.3f}\n", query.text(0), query.text(1), at, query.real(3)));
  }
  if (!has_rows) {
    throw std::runtime_error(
        fmt::format("{}: no frame was recorded with its received power; `record: {{frames: all}}` "
                    "records them",
                    folder.string()));
  }
}

}  // namespace results::report
