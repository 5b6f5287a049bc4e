#include "sim/radio/phy/error_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>

#include "hal/types/check.h"
#include "hal/types/math.h"
#include "sim/radio/standard.h"

namespace sim::radio {
namespace {

constexpr double kBitsPerByte = 8;
constexpr double kMega = 1e6;

auto group_of(const ErrorRow& row) { return std::tuple(row.modulation, row.mcs, row.size); }

/// Why a row cannot follow the one before it, of the same mode and size; empty if it can.
std::string wrong_order(const ErrorRow& before, const ErrorRow& row) {
  if (row.snr_db <= before.snr_db) {
    return fmt::format("snr_db: {} is not above that of the row before, {}", row.snr_db,
                       before.snr_db);
  }
  if (row.per > before.per) {
    return fmt::format("per: {} is above that of the row before, {}, which has a lower SNR",
                       row.per, before.per);
  }
  return "";
}

double per_at(double snr_db, double low_db, double low_per, double high_db, double high_per) {
  return low_per + (high_per - low_per) * (snr_db - low_db) / (high_db - low_db);
}

/// The MCSs of a format.
struct Format {
  const char* name;
  ModulationClass modulation;
  std::uint8_t highest;
};

std::vector<NamedMode> all_modes() {
  constexpr std::array kFormats{Format{"HT", ModulationClass::kHt, 7},
                                Format{"VHT", ModulationClass::kVht, 9},
                                Format{"HE", ModulationClass::kHe, 11}};
  std::vector<NamedMode> modes;
  constexpr std::size_t kMcss = 8 + 10 + 12;
  modes.reserve(kOfdmRates.size() + kMcss);
  std::uint8_t place = 0;
  for (const double rate : kOfdmRates) {
    modes.push_back({fmt::format("OFDM{}", rate / kMega), ModulationClass::kOfdm, place++});
  }
  for (const auto& [name, modulation, highest] : kFormats) {
    for (std::uint8_t mcs = 0; mcs <= highest; ++mcs) {
      modes.push_back({fmt::format("{}{}", name, mcs), modulation, mcs});
    }
  }
  return modes;
}

}  // namespace

const std::vector<NamedMode>& modes_with_error_tables() {
  static const std::vector<NamedMode> modes = all_modes();
  return modes;
}

std::string name_of_mode(const ErrorRow& row) {
  const auto& modes = modes_with_error_tables();
  const auto found = std::ranges::find_if(modes, [&row](const NamedMode& one) {
    return one.modulation == row.modulation && one.mcs == row.mcs;
  });
  BARAKA_CHECK(found != modes.end());
  return found->name;
}

std::vector<WrongRow> wrong_rows(const ErrorTable& table) {
  std::vector<WrongRow> wrong;
  struct Group {
    std::size_t first, last;
  };
  std::map<std::tuple<ModulationClass, std::uint8_t, std::uint32_t>, Group> groups;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto [group, is_new] = groups.try_emplace(group_of(table[i]), Group{i, i});
    if (is_new) continue;
    if (group->second.last + 1 != i) {
      wrong.push_back({i, "does not follow the other rows of its mode and size"});
    } else if (std::string what = wrong_order(table[i - 1], table[i]); !what.empty()) {
      wrong.push_back({i, std::move(what)});
    }
    group->second.last = i;
  }
  for (const auto& [key, group] : groups) {
    if (group.first == group.last) {
      wrong.push_back({group.first, "is the only row of its mode and size; two are needed"});
    }
  }
  std::ranges::stable_sort(wrong, {}, &WrongRow::row);
  return wrong;
}

ErrorCurve::ErrorCurve(const ErrorTable& rows) {
  std::map<std::uint32_t, std::vector<Point>> by_size;
  for (const ErrorRow& row : rows) by_size[row.size].push_back({row.snr_db, row.per});
  for (auto& [size, points] : by_size) sizes_.push_back({kBitsPerByte * size, std::move(points)});
  BARAKA_CHECK(!sizes_.empty());
}

/// The border between two sizes is their geometric mean, at which the smaller one counts.
const ErrorCurve::OfSize& ErrorCurve::nearest(double bits) const {
  std::size_t place = 0;
  while (place + 1 < sizes_.size() && bits * bits > sizes_[place].bits * sizes_[place + 1].bits) {
    ++place;
  }
  return sizes_[place];
}

double ErrorCurve::success(double sinr, double bits) const {
  if (bits <= 0) return 1;
  if (sinr <= 0) return 0;
  const OfSize& of = nearest(bits);
  constexpr double kDecibels = 10;
  const double snr_db = std::isinf(sinr) ? std::numeric_limits<double>::infinity()
                                         : kDecibels * hal::math::log10(sinr);
  if (snr_db < of.points.front().snr_db) return 0;
  const auto above = std::ranges::upper_bound(of.points, snr_db, {}, &Point::snr_db);
  const Point& below = *(above - 1);
  const double per = above == of.points.end()
                         ? below.per
                         : per_at(snr_db, below.snr_db, below.per, above->snr_db, above->per);
  return per >= 1 ? 0 : hal::math::pow(1 - per, bits / of.bits);
}

std::shared_ptr<const ErrorCurve> curve_of(const ErrorTable& table, const ModeId& mode) {
  ErrorTable rows;
  std::ranges::copy_if(table, std::back_inserter(rows), [&mode](const ErrorRow& row) {
    return row.modulation == mode.modulation && row.mcs == mode.mcs;
  });
  return rows.empty() ? nullptr : std::make_shared<const ErrorCurve>(rows);
}

}  // namespace sim::radio
