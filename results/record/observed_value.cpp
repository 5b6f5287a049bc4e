#include "results/record/observed_value.h"

#include <array>
#include <cmath>

namespace results::record {
namespace {

constexpr double kGreatest = 1e150;
constexpr std::array kShares{0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};

std::optional<double> bound(double edge) {
  return std::isfinite(edge) ? std::optional<double>{edge} : std::nullopt;
}

}  // namespace

ObservableTables::ObservableTables(Database& database)
    : observable(database, "INSERT INTO observables VALUES (?, ?, ?, ?, ?, ?, 0)"),
      sample(database, "INSERT INTO observable_samples VALUES (?, ?, ?)"),
      sums(database, "INSERT INTO observable_sums VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      bin(database, "INSERT INTO observable_bins VALUES (?, ?, ?, ?)"),
      quantile(database, "INSERT INTO observable_quantiles VALUES (?, ?, ?, ?)"),
      left_out(database, "UPDATE observables SET left_out = ? WHERE observable = ?") {}

ObservedValue::ObservedValue(ObservableTables& tables,
                             const sim::scenario::ObservableRequest& request,
                             const Identity& identity)
    : tables_(&tables), row_(identity.row), request_(&request) {
  std::optional<std::int64_t> every;
  if (request.every) every = request.every->count();
  tables.observable.run(row_, identity.name, identity.agent.value, identity.unit,
                        sim::scenario::name(request.keeps), every);
  if (request.keeps == sim::scenario::Keeps::kHistogram)
    histogram_.emplace(request.bins, request.range);
  if (request.keeps == sim::scenario::Keeps::kQuantiles) quantiles_.emplace();
}

int ObservedValue::add(hal::Time at, double value) {
  if (!(std::abs(value) <= kGreatest)) return 0;
  sums_.add(at, value);
  if (histogram_) histogram_->add(value);
  if (quantiles_) quantiles_->add(value);
  if (request_->keeps != sim::scenario::Keeps::kSamples) return 0;
  if (sums_.count() > request_->most) {
    ++left_out_;
    return 0;
  }
  tables_->sample.run(row_, hal::to_ns(at), value);
  return 1;
}

void ObservedValue::finish(hal::Time end) {
  write_sums(end);
  if (left_out_ > 0) tables_->left_out.run(left_out_, row_);
  if (histogram_) {
    for (const Bins::Bin& bin : histogram_->bins()) {
      tables_->bin.run(row_, bound(bin.lower), bound(bin.upper), bin.count);
    }
  }
  if (!quantiles_ || quantiles_->count() == 0) return;
  for (const double share : kShares) {
    tables_->quantile.run(row_, share, quantiles_->quantile(share), quantiles_->error());
  }
}

void ObservedValue::write_sums(hal::Time end) {
  if (sums_.count() == 0) {
    tables_->sums.run(row_, 0, std::nullopt, std::nullopt, std::nullopt, std::nullopt, 0.0,
                      std::nullopt, std::nullopt);
    return;
  }
  std::optional<double> deviation;
  if (sums_.count() > 1) deviation = sums_.deviation();
  tables_->sums.run(row_, sums_.count(), sums_.mean(), deviation, sums_.least(), sums_.greatest(),
                    sums_.sum(), sums_.last(), sums_.mean_over_time(end));
}

}  // namespace results::record
