#include "sim/scenario/measured_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/radio/radio_config.h"
#include "sim/scenario/csv_file.h"
#include "sim/scenario/given_file.h"

namespace sim::scenario {
namespace {

using radio::MeasuredBetween;
using radio::MeasuredConfig;
using radio::MeasuredRow;
using Otherwise = MeasuredConfig::Otherwise;

constexpr Range kLossRange{0, 300};        // dB
constexpr Range kTimeRange{0, 1e9};        // s
constexpr Range kReceivedLevel{-200, 60};  // dBm
constexpr std::string_view kMatrixHeader = "from,to,loss_db";
constexpr std::string_view kTraceHeader = "from,to,time_s,loss_db";
constexpr std::array kBetween = {Option<MeasuredBetween>{"hold", MeasuredBetween::kHold},
                                 Option<MeasuredBetween>{"linear", MeasuredBetween::kLinear}};
const auto kOtherwise =
    kinds_of<Otherwise, std::variant_size_v<Otherwise>>([](const auto& law) { return law.kModel; });

/// What the columns of a table hold.
struct Columns {
  bool has_times = false;
  bool has_levels = false;  ///< RSSI in place of losses.
};

std::optional<Columns> columns_of(const std::vector<std::string>& header) {
  const std::string names = fmt::format("{}", fmt::join(header, ","));
  if (names == kMatrixHeader) return Columns{};
  if (names == kTraceHeader) return Columns{.has_times = true};
  if (names == "from,to,rssi_dbm") return Columns{.has_levels = true};
  if (names == "from,to,time_s,rssi_dbm") return Columns{.has_times = true, .has_levels = true};
  return std::nullopt;
}

/// Reads one table; notes mistakes at the key.
class MeasuredReader {
 public:
  MeasuredReader(Mapping& in, std::string key, std::optional<hal::Dbm> tx_power)
      : in_(in), key_(std::move(key)), tx_power_(tx_power) {}

  void read(const CsvTable& table, MeasuredConfig& c) {
    if (table.rows.empty()) return;
    const auto columns = columns_of(table.header);
    if (!columns) {
      return in_.mistake(key_,
                         fmt::format("the header is '{}'; needed is {}, with rssi_dbm in "
                                     "place of loss_db for received power, or {}",
                                     fmt::join(table.header, ","), kTraceHeader, kMatrixHeader));
    }
    if (columns->has_levels != tx_power_.has_value()) {
      return in_.mistake("tx_power", columns->has_levels
                                         ? "is needed for received power, rssi_dbm"
                                         : "is for received power, rssi_dbm; there are losses");
    }
    std::vector<MeasuredRow> rows;
    for (const auto& cells : table.rows)
      if (const auto row = row_of(cells, *columns)) rows.push_back(*row);
    c.has_times = columns->has_times;
    c.rows = std::make_shared<const std::vector<MeasuredRow>>(std::move(rows));
  }

 private:
  std::optional<MeasuredRow> row_of(const std::vector<CsvCell>& cells, Columns columns) {
    MeasuredRow row{.from = cells[0].text, .to = cells[1].text, .place = cells[0].place};
    if (columns.has_times) {
      const auto at = csv_number(cells[2], "time_s", kTimeRange, key_, in_);
      if (!at) return std::nullopt;
      row.at = *at;
    }
    const auto loss = loss_of(cells.back(), columns.has_levels);
    if (!loss) return std::nullopt;
    row.loss = *loss;
    if (row.from != row.to && seen_.emplace(row.from, row.to, row.at).second) return row;
    in_.mistake(key_, fmt::format("{}: {}", row.place,
                                  row.from == row.to ? "from and to are the same"
                                                     : "this link and time are there already"));
    return std::nullopt;
  }

  std::optional<double> loss_of(const CsvCell& cell, bool is_level) {
    if (!is_level) return csv_number(cell, "loss_db", kLossRange, key_, in_);
    const Range range{kReceivedLevel.low, tx_power_->value};
    const auto level = csv_number(cell, "rssi_dbm", range, key_, in_);
    return level ? std::optional(tx_power_->value - *level) : std::nullopt;
  }

  Mapping& in_;
  std::string key_;
  std::optional<hal::Dbm> tx_power_;
  std::set<std::tuple<std::string, std::string, double>> seen_;
};

std::vector<std::string> texts_of(const MeasuredConfig& c) {
  std::vector<std::string> texts;
  for (const MeasuredRow& row : *c.rows) {
    texts.push_back(c.has_times ? fmt::format("{},{},{},{}", row.from, row.to, row.at, row.loss)
                                : fmt::format("{},{},{}", row.from, row.to, row.loss));
  }
  return texts;
}

/// Rows in the scenario are losses, with or without times by their number of values.
std::string_view header_of(Mapping& in, const Key& key) {
  const auto texts = in.texts(key);
  const bool has_times = !texts.empty() && std::ranges::count(texts.front().text, ',') == 3;
  return has_times ? kTraceHeader : kMatrixHeader;
}

void table_keys(Fields& io, MeasuredConfig& c) {
  std::optional<hal::Dbm> tx_power;
  io.given({"tx_power",
            "With received power in the file: power with which it was sent; the loss is the "
            "difference.",
            "16 dBm", "the file has losses"},
           "dBm", {-50, 60}, tx_power);
  std::filesystem::path file;
  file_key(io,
           {"file",
            "CSV file with the header from,to,loss_db, or from,to,time_s,loss_db for a trace, or "
            "with rssi_dbm in place of loss_db; from and to are names of agents. A link has the "
            "rows of its direction, else those of the other one.",
            "links.csv", "`rows`"},
           file);
  Mapping* const in = io.reading();
  if (!file.empty()) MeasuredReader(*in, "file", tx_power).read(read_csv(file, "file", *in), c);
  const Key key{"rows", "Losses as in a file with losses.", "['a,b,80', 'b,c,92.5']",
                "those of `file`"};
  io.written_if(c.rows != nullptr && !c.rows->empty(), [&](Fields& given) {
    given.own(
        key, {.kind = Form::Kind::kTexts},
        [&](Mapping& from) {
          if (!from.has(key.name)) return;
          const std::string_view header = header_of(from, key);
          MeasuredReader(from, "rows", {}).read(csv_of(key, header, from), c);
        },
        [&](Writer& out) { out.texts(key.name, texts_of(c)); });
  });
  if (in != nullptr && !in->has("file") && !in->has("rows"))
    io.mistake("model", "measured needs `file` or `rows`");
}

using Links = std::set<std::pair<std::string_view, std::string_view>>;

Links links_of(const std::vector<MeasuredRow>& rows) {
  Links links;
  for (const MeasuredRow& row : rows) links.emplace(row.from, row.to);
  return links;
}

/// Names in the rows that no agent has.
std::vector<std::string> unknown_names(const std::vector<MeasuredRow>& rows,
                                       const std::vector<agents::AgentConfig>& agents) {
  std::set<std::string_view> names;
  for (const auto& agent : agents) names.insert(agent.name);
  std::vector<std::string> wrong;
  for (const MeasuredRow& row : rows) {
    for (const std::string* const name : {&row.from, &row.to}) {
      if (!names.contains(*name))
        wrong.push_back(fmt::format("{}: there is no agent '{}'", row.place, *name));
    }
  }
  return wrong;
}

/// The first pair on one channel without rows.
std::optional<std::string> without_loss(const std::vector<agents::AgentConfig>& agents,
                                        const Links& links) {
  const auto is_missing = [&](const agents::AgentConfig& a, const agents::AgentConfig& b) {
    return a.radio.channel == b.radio.channel && !links.contains({a.name, b.name}) &&
           !links.contains({b.name, a.name});
  };
  for (auto one = agents.begin(); one != agents.end(); ++one) {
    const auto other = std::find_if(one + 1, agents.end(),
                                    [&](const auto& agent) { return is_missing(*one, agent); });
    if (other == agents.end()) continue;
    return fmt::format("there is no loss for '{}' and '{}', and no `otherwise`", one->name,
                       other->name);
  }
  return std::nullopt;
}

}  // namespace

void keys_of(Fields& io, MeasuredConfig& c) {
  table_keys(io, c);
  io.choice({"between",
             "Loss between two rows of a link: hold, that of the earlier one; linear, linear in "
             "dB. Before the first and after the last row that of this row.",
             "linear"},
            kBetween, c.between);
  io.optional_duration({"silence",
                        "Where a link of a trace has no row for longer than this, nothing arrives "
                        "until its next row, as in a trace of received frames; none: never so.",
                        "100 ms"},
                       0, c.silence);
  Otherwise law = c.otherwise.value_or(Otherwise{});
  const bool is_given =
      io.inside_given({"otherwise", "Law of distance for links without rows.",
                       "{model: log_distance}", "every link needs rows"},
                      c.otherwise.has_value(), [&](Fields& keys) {
                        keys.kinds({"model", "The law.", "friis"}, kOtherwise, law,
                                   [](Fields& inner, Otherwise& any) {
                                     std::visit([&inner](auto& one) { keys_of(inner, one); }, any);
                                   });
                      });
  if (io.reading() != nullptr && is_given) c.otherwise = law;
}

void check_measured(Mapping& in, const Scenario& scenario, const MeasuredConfig& c) {
  if (c.rows == nullptr) return;
  const auto& agents = scenario.simulation.agents;
  std::vector<std::string> wrong = unknown_names(*c.rows, agents);
  const auto missing = without_loss(agents, links_of(*c.rows));
  if (missing && !c.otherwise) wrong.push_back(*missing);
  for (const std::string& what : wrong)
    in.within("radio").mistake("propagation", "measured: " + what);
}

}  // namespace sim::scenario
