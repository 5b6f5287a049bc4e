#include "sim/scenario/propagation_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

using radio::PathLossConfig;

/// Of those that files can name: all but the last.
constexpr std::size_t kModels = std::variant_size_v<PathLossConfig> - 1;
static_assert(
    std::is_same_v<std::variant_alternative_t<kModels, PathLossConfig>, radio::ForeignLawConfig>);
constexpr auto kAllModels = std::make_index_sequence<kModels>{};

template <std::size_t... kIndex>
constexpr auto model_options(std::index_sequence<kIndex...>) {
  return std::array{
      Option<std::size_t>{std::variant_alternative_t<kIndex, PathLossConfig>::kModel, kIndex}...};
}

/// "friis, rician and rayleigh", of those of a kind.
template <std::size_t... kIndex>
std::string models_of(radio::PathLossKind kind, std::index_sequence<kIndex...>) {
  std::vector<std::string_view> names;
  const auto add = [&](const auto& law) {
    if (law.kKind == kind) names.push_back(law.kModel);
  };
  (add(std::variant_alternative_t<kIndex, PathLossConfig>{}), ...);
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

constexpr Range kLoss{0, 300};             // dB
constexpr Range kSomeDistance{1e-3, 1e6};  // m
constexpr Range kShape{0.5, 50};

/// A model without its parameters.
template <std::size_t... kIndex>
PathLossConfig of_model(std::size_t model, std::index_sequence<kIndex...>) {
  constexpr std::array kMake{
      +[]() -> PathLossConfig { return std::variant_alternative_t<kIndex, PathLossConfig>{}; }...};
  return kMake.at(model)();
}

/// Its settings are in itself.
template <class Io>
void model_keys(Io&, radio::ForeignLawConfig&) {}
template <class Io>
void model_keys(Io&, radio::PowerLawConfig&) {}
template <class Io>
void model_keys(Io&, radio::FriisConfig&) {}
template <class Io>
void model_keys(Io&, radio::TwoRayGroundConfig&) {}

template <class Io>
void model_keys(Io& io, radio::LogDistanceConfig& c) {
  io.quantity({"reference_loss", "Up to the reference distance.", "46.6777 dB"}, "dB", kLoss,
              c.reference_loss);
  io.quantity({"reference_distance", "From which the loss grows.", "1 m"}, "m", kSomeDistance,
              c.reference_distance);
  io.number({"exponent", "Ten times that in dB for ten times the distance.", "3"}, "1", {1, 8},
            c.exponent);
}

template <class Io>
void model_keys(Io& io, radio::ShadowingConfig& c) {
  io.quantity({"sigma", "Standard deviation among links; none differs by more than three times it.",
               "4 dB"},
              "dB", {0, 30}, c.sigma);
  io.quantity({"decorrelation_distance",
               "If one end moves so far, the correlation falls to 1/e, exponentially.", "20 m"},
              "m", kSomeDistance, c.decorrelation_distance);
}

template <class Io>
void scatterer_speed(Io& io, radio::FadingConfig& c) {
  io.number({"scatterer_speed",
             "Of what reflects the waves; it adds to the speed of the nodes. 0 m/s: a link changes "
             "only when one of its ends moves.",
             "1 m/s"},
            "m/s", {0, 1000}, c.scatterer_speed);
}

template <class Io>
void model_keys(Io& io, radio::NakagamiConfig& c) {
  io.number({"m_near", "Shape up to `middle_from`; 1: Rayleigh, more: steadier.", "1.5"}, "1",
            kShape, c.m_near);
  io.number({"m_middle", "Shape from there up to `far_from`.", "0.75"}, "1", kShape, c.m_middle);
  io.number({"m_far", "Shape beyond.", "0.75"}, "1", kShape, c.m_far);
  io.quantity({"middle_from", "Distance from which `m_middle` holds.", "80 m"}, "m", {0, 1e6},
              c.middle_from);
  io.quantity({"far_from", "Distance from which `m_far` holds.", "200 m"}, "m", {0, 1e6},
              c.far_from);
  scatterer_speed(io, c);
}

template <class Io>
void model_keys(Io& io, radio::RicianConfig& c) {
  io.quantity({"k", "Power of the direct ray over that of all others (K).", "6 dB"}, "dB",
              {-50, 50}, c.k);
  scatterer_speed(io, c);
}

template <class Io>
void model_keys(Io& io, radio::RayleighConfig& c) {
  scatterer_speed(io, c);
}

void check_chain(Mapping& in, const std::vector<PathLossConfig>& chain) {
  if (std::ranges::count_if(chain, radio::is_law_of_distance) != 1) {
    in.mistake("propagation", "must have exactly one of " +
                                  models_of(radio::PathLossKind::kLawOfDistance, kAllModels));
  }
  if (std::ranges::count_if(chain, radio::is_fading) > 1) {
    in.mistake("propagation", "must not have more than one of " +
                                  models_of(radio::PathLossKind::kFading, kAllModels));
  }
}

}  // namespace

std::vector<PathLossConfig> read_propagation(Mapping& in, std::vector<PathLossConfig> otherwise) {
  std::vector<PathLossConfig> chain;
  bool is_whole = true;
  for (Mapping& one : in.mappings(
           {"propagation",
            "What the way from antenna to antenna does to a frame's power, one after the other; "
            "one of the entries must be a law of distance. Without it: `power_law`.",
            "[{model: log_distance, exponent: 3}, {model: shadowing, sigma: 4 dB}]"})) {
    const std::optional<std::size_t> model = one.choice(
        {"model",
         "Laws of distance: power_law (with `path_loss_exponent`), friis, log_distance, "
         "two_ray_ground. Of each link: shadowing (log-normal), and in time nakagami, rician, "
         "rayleigh.",
         "two_ray_ground"},
        model_options(kAllModels));
    is_whole &= model.has_value();
    if (!model) continue;
    PathLossConfig config = of_model(*model, kAllModels);
    FieldReader reader(one);
    std::visit([&reader](auto& c) { model_keys(reader, c); }, config);
    if (const auto* m = std::get_if<radio::NakagamiConfig>(&config);
        m != nullptr && m->far_from < m->middle_from) {
      one.mistake("far_from", "is below middle_from");
    }
    chain.push_back(config);
    one.finish();
  }
  if (chain.empty()) return otherwise;
  if (is_whole) check_chain(in, chain);
  return chain;
}

void write_propagation(Writer& out, const std::vector<PathLossConfig>& chain) {
  out.open_list("propagation");
  for (PathLossConfig one : chain) {
    out.open_item();
    out.text("model", model_of(one));
    FieldWriter writer(out);
    std::visit([&writer](auto& c) { model_keys(writer, c); }, one);
    out.close();
  }
  out.close();
}

}  // namespace sim::scenario
