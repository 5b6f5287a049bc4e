#include "sim/scenario/antenna_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/scenario/csv_file.h"
#include "sim/scenario/given_file.h"

namespace sim::scenario {
namespace {

using radio::AntennaConfig;
using radio::AntennaRow;

constexpr std::string_view kAntennaHeader = "azimuth_deg,elevation_deg,gain_dbi";
constexpr Range kBeamWidth{1e-3, 6.2832};  // rad

const auto kPatterns = kinds_of<AntennaConfig, std::variant_size_v<AntennaConfig>>(
    [](const auto& antenna) { return antenna.kPattern; });

/// Notes what is wrong; then there are no rows.
std::vector<AntennaRow> antenna_rows(const CsvTable& table, const std::string& key, Mapping& in) {
  std::vector<AntennaRow> rows;
  if (table.rows.empty()) return rows;
  if (fmt::format("{}", fmt::join(table.header, ",")) != kAntennaHeader) {
    in.mistake(key, fmt::format("the header is '{}'; needed is '{}'", fmt::join(table.header, ","),
                                kAntennaHeader));
    return rows;
  }
  for (const auto& cells : table.rows) {
    const auto azimuth = csv_number(cells[0], table.header[0], {-180, 360}, key, in);
    const auto elevation = csv_number(cells[1], table.header[1], {-90, 90}, key, in);
    const auto gain = csv_number(cells[2], table.header[2], {-100, 60}, key, in);
    if (!azimuth || !elevation || !gain) return {};
    rows.push_back({*azimuth, *elevation, *gain});
  }
  const auto wrong = radio::wrong_rows(rows);
  for (const auto& [row, what] : wrong)
    in.mistake(key, fmt::format("{}: {}", table.rows[row].front().place, what));
  return wrong.empty() ? rows : std::vector<AntennaRow>{};
}

void keys_of(Fields& /*io*/, radio::OmniAntenna& /*antenna*/) {}
void keys_of(Fields& /*io*/, radio::DipoleAntenna& /*antenna*/) {}

void keys_of(Fields& io, radio::BeamAntenna& c) {
  io.number({"width", "Half-power beam width in azimuth.", "30 deg"}, "rad", kBeamWidth, c.width);
  io.number({"height", "Half-power beam width in elevation.", "15 deg"}, "rad", kBeamWidth,
            c.height);
  io.number({"azimuth", "Direction of boresight in the frame of the body, to the left.", "90 deg"},
            "rad", kAngle, c.azimuth);
  io.number({"elevation", "Direction of boresight above the body's plane.", "10 deg"}, "rad",
            kAngle, c.elevation);
  io.quantity({"back", "In no direction is the gain below that of boresight by more.", "20 dB"},
              "dB", {0, 100}, c.back);
}

void keys_of(Fields& io, radio::TableAntenna& c) {
  std::filesystem::path file;
  file_key(io,
           {"file",
            "CSV file with the header azimuth_deg,elevation_deg,gain_dbi and a row for each "
            "direction of a grid; azimuth from the body's x axis to the left, elevation upwards.",
            "antennas/half_wave_dipole.csv", "`rows`"},
           file);
  const Key key{"rows", "The rows of such a file.", "['0,0,2', '180,0,-10']", "those of `file`"};
  Mapping* const in = io.reading();
  if (!file.empty()) c.rows = antenna_rows(read_csv(file, "file", *in), "file", *in);
  io.written_if(!c.rows.empty(), [&](Fields& given) {
    given.own(
        key, {.kind = Form::Kind::kTexts},
        [&](Mapping& from) {
          if (from.has(key.name))
            c.rows = antenna_rows(csv_of(key, kAntennaHeader, from), "rows", from);
        },
        [&](Writer& out) {
          std::vector<std::string> rows;
          for (const AntennaRow& row : c.rows)
            rows.push_back(fmt::format("{},{},{}", row.azimuth, row.elevation, row.gain));
          out.texts(key.name, rows);
        });
  });
  if (in != nullptr && !in->has("file") && !in->has("rows"))
    io.mistake("pattern", "table needs `file` or `rows`");
  if (c.rows.empty() && in != nullptr) c.rows = {{}};  // noted
}

void pattern_keys(Fields& io, AntennaConfig& antenna) {
  io.kinds({"pattern",
            "Gain by direction, times `antenna_gain`: omni, the same in all directions; dipole, a "
            "vertical half-wave dipole, 2.15 dBi at right angles to it; beam, one main lobe with 0 "
            "dBi at boresight; table, dBi by azimuth and elevation.",
            "dipole"},
           kPatterns, antenna, [](Fields& keys, AntennaConfig& any) {
             std::visit([&keys](auto& one) { keys_of(keys, one); }, any);
           });
}

}  // namespace

void antenna_key(Fields& io, AntennaConfig& antenna) {
  io.inside_given({"antenna",
                   "Gain of the antennas by direction, in the frame of the body that carries them: "
                   "they turn with it.",
                   "{pattern: beam, width: 60 deg}", "equal in all directions"},
                  !std::holds_alternative<radio::OmniAntenna>(antenna),
                  [&](Fields& keys) { pattern_keys(keys, antenna); });
}

void antenna_key(Fields& io, std::optional<AntennaConfig>& antenna) {
  AntennaConfig own = antenna.value_or(AntennaConfig{});
  const bool is_given = io.inside_given(
      {"antenna", "Gain of these agents' antennas by direction, in the frame of their body.",
       "{pattern: dipole}", "that of `radio`"},
      antenna.has_value(), [&](Fields& keys) { pattern_keys(keys, own); });
  if (io.reading() != nullptr && is_given) antenna = own;
}

}  // namespace sim::scenario
