#include "sim/core/material.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace sim {
namespace {

using Complex = std::complex<double>;

/// Row of table 3 of Recommendation ITU-R P.2040-3: permittivity a f^b, conductivity c f^d S/m, f
/// in GHz; and the thickness of our wall.
struct Slab {
  const char* material;
  double a, b, c, d;
  double thickness;  ///< m
};

constexpr std::array kSlabs{
    Slab{"brick", 3.91, 0, 0.0238, 0.16, 0.12},
    Slab{"concrete", 5.24, 0, 0.0462, 0.7822, 0.15},
    Slab{"wood", 1.99, 0, 0.0047, 1.0718, 0.04},
    Slab{"plasterboard", 2.73, 0, 0.0085, 0.9395, 0.025},
    Slab{"glass", 6.31, 0, 0.0036, 1.3394, 0.006},
};

/// Equations 43b and 44 at normal incidence, with 59 for the imaginary part of the permittivity,
/// dB.
double transmission_loss(const Slab& slab, double ghz) {
  const double sigma = slab.c * std::pow(ghz, slab.d);
  const Complex index = std::sqrt(Complex(slab.a * std::pow(ghz, slab.b), -17.98 * sigma / ghz));
  const Complex reflection = (1.0 - index) / (1.0 + index);
  const double wavelength = 0.299792458 / ghz;
  const Complex q = 2 * std::numbers::pi * slab.thickness / wavelength * index;
  const Complex through = std::exp(Complex(0, -1) * q);
  const Complex squared = reflection * reflection;
  return -20 *
         std::log10(std::abs((1.0 - squared) * through / (1.0 - squared * through * through)));
}

TEST(Material, OfASlabLosesWhatTheRecommendationSays) {
  for (const Slab& slab : kSlabs) {
    const auto found = find_material(slab.material, {});
    ASSERT_TRUE(found) << slab.material;
    // The table is rounded to a tenth of a dB.
    EXPECT_NEAR(found->loss.value, transmission_loss(slab, 2.4), 0.051) << slab.material;
    EXPECT_NEAR(found->loss_5ghz.value, transmission_loss(slab, 5.5), 0.051) << slab.material;
  }
}

TEST(Material, EveryOneHasASource) {
  EXPECT_EQ(built_in_materials().size(), kSlabs.size() + 2);  // and COST 231's two
  EXPECT_EQ(find_material("light_wall", {})->loss, hal::Decibels{3.4});
  EXPECT_EQ(find_material("heavy_wall", {})->loss_5ghz, hal::Decibels{6.9});
  EXPECT_TRUE(find_material(kDefaultMaterial, {}));
}

TEST(Material, OfTheScenarioGoesBeforeABuiltInOne) {
  const std::vector<Material> own{{"brick", hal::Decibels{8}, hal::Decibels{9}},
                                  {"door", hal::Decibels{1}, hal::Decibels{2}}};
  EXPECT_EQ(find_material("brick", own), own[0]);
  EXPECT_EQ(find_material("door", own), own[1]);
  EXPECT_EQ(find_material("door", {}), std::nullopt);
  EXPECT_TRUE(names_of_materials(own).starts_with("brick, door, light_wall, "));
}

}  // namespace
}  // namespace sim
