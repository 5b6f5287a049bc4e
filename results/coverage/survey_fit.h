#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/coverage/survey_file.h"
#include "results/statistics/regression.h"
#include "sim/agents/simulation_config.h"
#include "sim/radio/channel/multi_wall.h"

namespace results::coverage {

/// Root mean squares of the residuals, dB, when only half of the rows, drawn at random, are fitted.
struct HeldOut {
  std::size_t fitted_rows = 0, held_rows = 0;
  double fitted = 0, held = 0;
};

/// The multi-wall law fitted to a survey.
struct SurveyFit {
  sim::radio::MultiWallConfig law;
  /// constant_loss [dB], exponent, and as far as the rows' paths cross them the loss of each
  /// material and ceiling_loss [dB].
  statistics::LinearFit fit;
  std::size_t rows = 0;
  std::optional<HeldOut> held_out{};  ///< nullopt: half of the rows do not suffice for a fit.
  std::vector<std::string> warnings{};
};

/// What each row says of the law's parameters: the loss of the path from its access point beyond
/// free space at 1 m.
/// @throws hal::files::config::ConfigErrors  an access point that is not an agent; a row at its
/// antenna.
statistics::Observations observations_of(const sim::agents::SimulationConfig& config,
                                         std::span<const SurveyRow> rows);

/// Fits by least squares: all rows count the same, errors are taken as independent.
/// @throws std::runtime_error  parameters that the rows do not tell apart, too few rows, or an
///   exponent or a constant out of range. @throws hal::files::config::ConfigErrors  as above.
SurveyFit fit_survey(const sim::agents::SimulationConfig& config, std::span<const SurveyRow> rows);

/// The parameters with their intervals, and the residuals, as text.
std::string survey_text(const SurveyFit& fit);

/// The scenario's radio with the fitted law in place of its law of distance, as a radio file.
/// @param what  where it comes from, for the comment at its head.
std::string survey_radio(const sim::agents::SimulationConfig& config, const SurveyFit& fit,
                         const std::string& what);

}  // namespace results::coverage
