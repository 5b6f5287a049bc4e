#include "sim/scenario/propagation_section.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/radio/radio_rules.h"
#include "sim/scenario/measured_keys.h"

namespace sim::scenario {
namespace {

using radio::PathLossConfig;

const auto kModels =
    kinds_of<PathLossConfig, radio::kNamedLaws>([](const auto& law) { return law.kModel; });

}  // namespace

void chain_keys(Fields& io, std::vector<PathLossConfig>& chain) {
  const std::vector<PathLossConfig> otherwise = chain;
  if (!io.is_writing()) chain.clear();
  io.list<PathLossConfig>(
      {"propagation",
       "Models of the propagation from antenna to antenna, applied one after the other. Exactly "
       "one must be a law of distance. Default: `power_law`.",
       "[{model: log_distance, exponent: 3}, {model: shadowing, sigma: 4 dB}]"},
      chain, [&](Fields& one, PathLossConfig& law) {
        if (std::holds_alternative<radio::ForeignLawConfig>(law)) {
          std::string name(radio::model_of(law));
          return one.needed_text({"model", ""}, name);
        }
        using Kind = radio::PathLossKind;
        static const std::string meaning =
            fmt::format("Laws of distance: {}. Constant for each link: {}. Fading in time: {}.",
                        radio::models_of(Kind::kLawOfDistance), radio::models_of(Kind::kOfLinks),
                        radio::models_of(Kind::kFading));
        one.kinds({"model", meaning, "two_ray_ground"}, kModels, law,
                  [](Fields& keys, PathLossConfig& any) {
                    std::visit([&keys](auto& c) { keys_of(keys, c); }, any);
                  });
      });
  Mapping* const in = io.reading();
  const bool has_mistakes = in != nullptr && in->items("propagation").size() != chain.size();
  if (chain.empty() || has_mistakes) chain = otherwise;
}

}  // namespace sim::scenario
