#include "sim/scenario/propagation_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "sim/radio/radio_rules.h"

namespace sim::scenario {
namespace {

using radio::PathLossConfig;

/// Of those that files can name: all but the last.
constexpr std::size_t kModels = std::variant_size_v<PathLossConfig> - 1;
static_assert(
    std::is_same_v<std::variant_alternative_t<kModels, PathLossConfig>, radio::ForeignLawConfig>);
const auto kModelKinds =
    kinds_of<PathLossConfig, kModels>([](const auto& law) { return law.kModel; });

constexpr Range kLoss{0, 300};             // dB
constexpr Range kSomeDistance{1e-3, 1e6};  // m
constexpr Range kShape{0.5, 50};

/// Its settings are in itself.
void model_keys(Fields&, radio::ForeignLawConfig&) {}
void model_keys(Fields&, radio::PowerLawConfig&) {}
void model_keys(Fields&, radio::FriisConfig&) {}
void model_keys(Fields&, radio::TwoRayGroundConfig&) {}

void model_keys(Fields& io, radio::LogDistanceConfig& c) {
  io.quantity({"reference_loss", "Up to the reference distance.", "46.6777 dB"}, "dB", kLoss,
              c.reference_loss);
  io.quantity({"reference_distance", "From which the loss grows.", "1 m"}, "m", kSomeDistance,
              c.reference_distance);
  io.number({"exponent", "Ten times that in dB for ten times the distance.", "3"}, "1", {1, 8},
            c.exponent);
}

void model_keys(Fields& io, radio::ShadowingConfig& c) {
  io.quantity({"sigma", "Standard deviation among links; none differs by more than three times it.",
               "4 dB"},
              "dB", {0, 30}, c.sigma);
  io.quantity({"decorrelation_distance",
               "If one end moves so far, the correlation falls to 1/e, exponentially.", "20 m"},
              "m", kSomeDistance, c.decorrelation_distance);
}

void scatterer_speed(Fields& io, radio::FadingConfig& c) {
  io.number({"scatterer_speed",
             "Of what reflects the waves; it adds to the speed of the nodes. 0 m/s: a link changes "
             "only when one of its ends moves.",
             "1 m/s"},
            "m/s", {0, 1000}, c.scatterer_speed);
}

void model_keys(Fields& io, radio::NakagamiConfig& c) {
  io.number({"m_near", "Shape up to `middle_from`; 1: Rayleigh, more: steadier.", "1.5"}, "1",
            kShape, c.m_near);
  io.number({"m_middle", "Shape from there up to `far_from`.", "0.75"}, "1", kShape, c.m_middle);
  io.number({"m_far", "Shape beyond.", "0.75"}, "1", kShape, c.m_far);
  io.quantity({"middle_from", "Distance from which `m_middle` holds.", "80 m"}, "m", {0, 1e6},
              c.middle_from);
  io.quantity({"far_from", "Distance from which `m_far` holds.", "200 m"}, "m", {0, 1e6},
              c.far_from);
  if (c.far_from < c.middle_from) io.mistake("far_from", "is below middle_from");
  scatterer_speed(io, c);
}

void model_keys(Fields& io, radio::RicianConfig& c) {
  io.quantity({"k", "Power of the direct ray over that of all others (K).", "6 dB"}, "dB",
              {-50, 50}, c.k);
  scatterer_speed(io, c);
}

void model_keys(Fields& io, radio::RayleighConfig& c) { scatterer_speed(io, c); }

}  // namespace

void chain_keys(Fields& io, std::vector<PathLossConfig>& chain) {
  const std::vector<PathLossConfig> otherwise = chain;
  if (!io.is_writing()) chain.clear();
  io.list<PathLossConfig>(
      {"propagation",
       "What the way from antenna to antenna does to a frame's power, one after the other; one of "
       "the entries must be a law of distance. Without it: `power_law`.",
       "[{model: log_distance, exponent: 3}, {model: shadowing, sigma: 4 dB}]"},
      chain, [&](Fields& one, PathLossConfig& law) {
        if (std::holds_alternative<radio::ForeignLawConfig>(law)) {
          std::string name(radio::model_of(law));
          return one.needed_text({"model", ""}, name);
        }
        using Kind = radio::PathLossKind;
        static const std::string meaning =
            fmt::format("Laws of distance: {}. Differing between links: {}. Fading in time: {}.",
                        radio::models_of(Kind::kLawOfDistance), radio::models_of(Kind::kOfLinks),
                        radio::models_of(Kind::kFading));
        one.kinds({"model", meaning, "two_ray_ground"}, kModelKinds, law,
                  [](Fields& keys, PathLossConfig& any) {
                    std::visit([&keys](auto& c) { model_keys(keys, c); }, any);
                  });
      });
  Mapping* const in = io.reading();
  const bool has_mistakes = in != nullptr && in->items("propagation").size() != chain.size();
  if (chain.empty() || has_mistakes) chain = otherwise;
}

}  // namespace sim::scenario
