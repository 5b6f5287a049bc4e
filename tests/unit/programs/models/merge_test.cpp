#include "programs/models/merge.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sdf/sdf.hh>

#include "tests/unit/programs/models/loaded.h"

namespace programs::models::test {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;
using Vector = std::array<double, 3>;

Matrix times(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}
Matrix transposed(const Matrix& a) {
  Matrix t{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t[i][j] = a[j][i];
  return t;
}
Vector times(const Matrix& a, const Vector& v) {
  Vector w{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) w[i] += a[i][k] * v[k];
  return w;
}
Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Matrix about_x(double a) {
  return {{{1, 0, 0}, {0, std::cos(a), -std::sin(a)}, {0, std::sin(a), std::cos(a)}}};
}
Matrix about_y(double a) {
  return {{{std::cos(a), 0, std::sin(a)}, {0, 1, 0}, {-std::sin(a), 0, std::cos(a)}}};
}
Matrix about_z(double a) {
  return {{{std::cos(a), -std::sin(a), 0}, {std::sin(a), std::cos(a), 0}, {0, 0, 1}}};
}
/// URDF: roll, then pitch, then yaw about fixed axes.
Matrix rpy(double roll, double pitch, double yaw) {
  return times(about_z(yaw), times(about_y(pitch), about_x(roll)));
}

/// A mass in the frame of the robot.
struct Mass {
  double kg;
  Vector at;
  Matrix tensor;  ///< About its centre.
};

Matrix symmetric(double xx, double yy, double zz, double xy, double xz, double yz) {
  return {{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
}
Matrix turned(const Matrix& r, const Matrix& tensor) {
  return times(times(r, tensor), transposed(r));
}

struct Sum {
  double kg = 0;
  Vector centre{};
  Matrix tensor{};
};
Sum sum_of(const std::vector<Mass>& masses) {
  Sum sum;
  for (const Mass& one : masses) sum.kg += one.kg;
  for (const Mass& one : masses)
    for (std::size_t i = 0; i < 3; ++i) sum.centre[i] += one.kg * one.at[i] / sum.kg;
  for (const Mass& one : masses) {
    const Vector d{one.at[0] - sum.centre[0], one.at[1] - sum.centre[1], one.at[2] - sum.centre[2]};
    const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        sum.tensor[i][j] +=
            one.tensor[i][j] + one.kg * ((i == j ? square : 0) - d[i] * d[j]);  // Huygens, Steiner
  }
  return sum;
}

constexpr double kClose = 1e-9;

void expect_equal(const hal::node::devices::BodyInertia& body, const Sum& sum) {
  EXPECT_NEAR(body.mass, sum.kg, kClose);
  EXPECT_NEAR(body.centre.x, sum.centre[0], kClose);
  EXPECT_NEAR(body.centre.y, sum.centre[1], kClose);
  EXPECT_NEAR(body.centre.z, sum.centre[2], kClose);
  EXPECT_NEAR(body.moments.x, sum.tensor[0][0], kClose);
  EXPECT_NEAR(body.moments.y, sum.tensor[1][1], kClose);
  EXPECT_NEAR(body.moments.z, sum.tensor[2][2], kClose);
  EXPECT_NEAR(body.products.x, sum.tensor[0][1], kClose);
  EXPECT_NEAR(body.products.y, sum.tensor[0][2], kClose);
  EXPECT_NEAR(body.products.z, sum.tensor[1][2], kClose);
}

constexpr double kQuarter = 1.5707963267948966;  // rad

// The wheels stand at z = 0, so the robot's frame is that of its root.
TEST(Merge, MassesOverFixedJointsAreTheSumsWorkedByHand) {
  const Matrix tower = about_z(kQuarter / 2);
  const Vector tower_at{-0.05, 0.03, 0.15};
  const Matrix plate = times(tower, about_y(kQuarter));
  const Vector plate_at = plus(tower_at, times(tower, Vector{0, 0, 0.4}));
  const Matrix head = times(plate, about_x(kQuarter / 3));
  const Vector head_at = plus(plate_at, times(plate, Vector{0.05, 0, 0}));
  const Sum sum =
      sum_of({{4,
               {0.01, -0.02, 0.1},
               turned(rpy(0.1, 0.2, 0.3), symmetric(0.05, 0.06, 0.07, 0.001, -0.002, 0.003))},
              {1.5, plus(tower_at, times(tower, Vector{0, 0, 0.2})),
               turned(tower, symmetric(0.02, 0.021, 0.005, 0.0001, 0.0002, -0.0003))},
              {0.5, plus(head_at, times(head, Vector{0.01, 0.02, 0.03})),
               turned(times(head, about_z(kQuarter)), symmetric(0.001, 0.002, 0.0025, 0, 0, 0))}});
  expect_equal(loaded(with_wheels("fixed_chain.urdf")).robot.inertia.value(), sum);
}

TEST(Merge, PosesInFramesOfOthersAreResolvedBeforeMassesAreSummed) {
  // deck turns by a quarter; the mast is 0.1 m along its x, and the top 0.01 m further.
  const Sum sum = sum_of({{5, {-0.05, 0, 0.08}, symmetric(0.05, 0.06, 0.07, 0, 0, 0)},
                          {0.5, {0, 0.11, 0.6}, symmetric(0.002, 0.001, 0.0025, 0, 0, 0)},
                          {0.1, {-0.2, 0, 0.03}, symmetric(1e-4, 1e-4, 1e-4, 0, 0, 0)}});
  expect_equal(loaded(with_wheels("frames.sdf")).robot.inertia.value(), sum);
}

TEST(Merge, NestedAndIncludedModelsAreFixedParts) {
  const Sum sum = sum_of({{5, {-0.05, 0, 0.08}, symmetric(0.05, 0.06, 0.07, 0, 0, 0)},
                          {0.1, {-0.2, 0, 0.03}, symmetric(1e-4, 1e-4, 1e-4, 0, 0, 0)},
                          {0.4, {0, 0.1, 0.2}, symmetric(0.002, 0.001, 0.0025, 0, 0, 0)},
                          {0.3, {0.1, 0, 0.25}, symmetric(0.001, 0.001, 0.0002, 0, 0, 0)}});
  expect_equal(loaded(with_wheels("nested.sdf")).robot.inertia.value(), sum);
}

// libsdformat adds up what fixed joints hold by its own code when it reads URDF.
TEST(Merge, TheSumsAreThoseOfLibsdformat) {
  ::sdf::Console::Instance()->SetQuiet(true);
  ::sdf::Root root;
  ASSERT_TRUE(root.Load(robots() + "turtlebot3_burger.urdf").empty());
  const ::sdf::Link* const link = root.Model()->LinkByName("base_footprint");
  ASSERT_NE(link, nullptr);
  const auto& theirs = link->Inertial();
  const auto own = loaded("urdf: " + robots() +
                          "turtlebot3_burger.urdf\ndrive: {left: wheel_left_joint, right: "
                          "wheel_right_joint, casters: caster_back_link}\nwheels: {wheel: {limit: "
                          "{effort: 1.4 N m, velocity: 6.67 rad/s}}}\n")
                       .robot.inertia.value();
  EXPECT_NEAR(own.mass, theirs.MassMatrix().Mass(), kClose);
  EXPECT_NEAR(own.centre.x, theirs.Pose().Pos().X(), kClose);
  // The ground is where the wheels stand, in the frame of base_footprint: 0.01 + 0.023 - 0.033 = 0.
  EXPECT_NEAR(own.centre.z, theirs.Pose().Pos().Z(), kClose);
  const auto moi = theirs.Moi();
  EXPECT_NEAR(own.moments.x, moi(0, 0), kClose);
  EXPECT_NEAR(own.moments.y, moi(1, 1), kClose);
  EXPECT_NEAR(own.moments.z, moi(2, 2), kClose);
  EXPECT_NEAR(own.products.x, moi(0, 1), kClose);
  EXPECT_NEAR(own.products.y, moi(0, 2), kClose);
  EXPECT_NEAR(own.products.z, moi(1, 2), kClose);
}

}  // namespace
}  // namespace programs::models::test
