// SPDX-License-Identifier: MIT
// A spring collapses within a body: only its neighbourhood takes small steps (methods 13, H5).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/block.hpp"
#include "studies/clocks/collapsing_body.hpp"

namespace jetlag::testing {
namespace {

constexpr double lead = 0.37, until = 1.0;  // [s]; the collapse is no whole number of steps away
constexpr double tolerance = 1e-9;          // lengths of the spring
constexpr double offsets[] = {1e-1, 1e-3, 1e-6, 0.0};

struct Counted {
  std::vector<double> updates;                                // of each particle
  double shortest = std::numeric_limits<double>::infinity();  // step [s]
  double across = 0;                                          // step of an end in which the collapse lies [s]
  State<double> end;
};
template <class ScheduleType>
Counted counted(const CollapsingBody& body, const System<double>& system) {
  typename ScheduleType::Options options;
  options.tolerance = tolerance * body.length;
  ScheduleType schedule(system, 8, options);
  Counted counted;
  counted.end = body.start;
  RunOptions run;
  run.observer.on_update = [&](const Update& update) {
    counted.shortest = std::min(counted.shortest, update.step);
    if (body.distance[update.particle] == 0 && update.begin <= lead && lead <= update.begin + update.step)
      counted.across = std::max(counted.across, update.step);
  };
  EXPECT_EQ(schedule.run(counted.end, until, run).outcome, Outcome::success);
  for (int i = 0; i < system.particles(); ++i)
    counted.updates.push_back(static_cast<double>(schedule.updates_of(i)));
  return counted;
}

/// Means over the particles of each distance from the collapse.
std::vector<double> means(const std::vector<double>& values, const std::vector<int>& distance) {
  std::vector<double> sum(*std::ranges::max_element(distance) + 1), count(sum.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum[distance[i]] += values[i];
    ++count[distance[i]];
  }
  for (std::size_t d = 0; d < sum.size(); ++d) sum[d] /= count[d];
  return sum;
}

// ---- the bodies -------------------------------------------------------------------------------------------

struct Body {
  std::string name;
  std::function<Mesh()> mesh;
  bool at_its_end;  // where the spring collapses: at the top, or in the middle
};
void PrintTo(const Body& body, std::ostream* out) { *out << body.name; }

const std::filesystem::path bunny = std::filesystem::path(JETLAG_SHARED_DIR) / "meshes/coarse_bunny.mesh";

class Collapse : public ::testing::TestWithParam<Body> {
 protected:
  void SetUp() override {
    if (GetParam().name == "Bunny" && !std::filesystem::exists(bunny)) GTEST_SKIP() << "needs " << bunny;
  }
  static CollapsingBody body(double offset) {
    const Mesh mesh = GetParam().mesh();
    Eigen::RowVector3d place = mesh.position.colwise().mean();
    if (GetParam().at_its_end) place[1] = mesh.position.col(1).maxCoeff();
    return collapsing_body(mesh, edge_near(mesh, place), offset, lead);
  }
};
INSTANTIATE_TEST_SUITE_P(
    InThe, Collapse,
    ::testing::Values(
        Body{"Body", [] { return truncated_ellipsoid({0.8, 1.2, 0.8}, {8, 8}, 0.9, 0.95); }, false},
        Body{"LongBody", [] { return truncated_ellipsoid({0.8, 4.8, 0.8}, {4, 24}, 0.9, 0.95); }, true},
        Body{"Bunny", [] { return read_medit(bunny); }, false}),
    [](const auto& info) { return info.param.name; });

// ---- laws -------------------------------------------------------------------------------------------------

/// Updates with the collapse, and what they are more than without it: the spring cut and the rest the same.
struct Compared {
  Counted with, without;
  std::vector<double> more;
  double most;    // updates of an end
  double levels;  // how many halvings the shortest step lies below those of the slowest particle
};
template <class ScheduleType>
Compared compared(const CollapsingBody& body) {
  Compared c{counted<ScheduleType>(body, body.system), counted<ScheduleType>(body, body.cut), {}, 0, 0};
  for (std::size_t i = 0; i < c.with.updates.size(); ++i)
    c.more.push_back(c.with.updates[i] - c.without.updates[i]);
  c.most = c.with.updates[body.ends[0]];
  c.levels = std::ceil(std::log2(until / *std::ranges::min_element(c.without.updates) / c.with.shortest));
  return c;
}

/// Neighbours may differ by one halving: a particle at distance d is held `levels - d` halvings down while the ends are
/// at their shortest steps, takes one of 2^d of these, and on the way back doubles its step at each update.
double allowed(const Compared& c, int d) { return std::max(0.0, c.levels - d) + std::ldexp(c.most, -d); }

/// Where that is less than one update, nothing is left of the collapse: the motion itself has come to (omega
/// t)^(2d) / (2d)! by then, below 1e-4 of it at d = 6.
void expect_nothing_far_away(const Compared& c, const CollapsingBody& body, double most = 0) {
  int far_away = 0;
  for (std::size_t i = 0; i < c.more.size(); ++i) {
    if (allowed(c, body.distance[i]) >= 1) continue;
    EXPECT_NEAR(c.with.updates[i], c.without.updates[i], most) << i << " at distance " << body.distance[i];
    ++far_away;
  }
  EXPECT_EQ(far_away > 0, allowed(c, body.farthest()) < 1);
}

/// As long as they are more than one update.
void expect_fall(const std::vector<double>& means, std::size_t from) {
  EXPECT_GT(means[0], 1);
  for (std::size_t d = from; d + 1 < means.size() && means[d] > 1; ++d) {
    EXPECT_LT(means[d + 1], means[d]) << "distance " << d;
  }
}

/// Ends that meet exactly are a kink (model/kinks.hpp), at which steps end: what is left is an error of the tolerance at
/// most in each update, of whoever it is. Ends that pass each other turn the force in 2 offset s, which a series need not
/// see: while the ends are nearest within a step h, the force of the spring, of k L, may be wrong by twice that for as long
/// as h and that turn, and by then an end goes wrong by 2 h L k / m a second; far away that has not arrived.
void expect_errors_of_a_step(const Compared& c, const CollapsingBody& body, double offset) {
  const State<double> truth = moved(body.system, body.nearest, until);
  ASSERT_GT(c.with.across, 0);
  for (std::size_t i = 0; i < c.more.size(); ++i) {
    const double error = (c.with.end.position.row(i) - truth.position.row(i)).norm() / body.length;
    const bool far_away = allowed(c, body.distance[i]) < 1;
    EXPECT_LE(error, far_away || offset == 0 ? c.with.updates[i] * tolerance
                                             : 2 * (c.with.across + 2 * offset) * (until - lead))
        << i << " at distance " << body.distance[i];
  }
}

TEST_P(Collapse, ShortensBlockStepsOnlyNearIt) {
  for (const double offset : offsets) {
    SCOPED_TRACE(offset);
    const CollapsingBody body = this->body(offset);
    const Compared c = compared<BlockSteps>(body);
    for (std::size_t i = 0; i < c.more.size(); ++i)
      EXPECT_LE(c.more[i], allowed(c, body.distance[i])) << i << " at distance " << body.distance[i];
    expect_fall(means(c.more, body.distance), 0);
    expect_nothing_far_away(c, body);
    expect_errors_of_a_step(c, body, offset);
  }
}

TEST_P(Collapse, ShortensFreeStepsOnlyNearIt) {
  // The neighbours of the ends are woken by both of them: they may be updated more often than these. Steps of free clocks
  // end by those of their neighbours, so that who is updated when depends on everybody: one or two of 20 updates.
  for (const double offset : offsets) {
    SCOPED_TRACE(offset);
    const CollapsingBody body = this->body(offset);
    const Compared c = compared<Asynchronous>(body);
    expect_fall(means(c.more, body.distance), 1);
    expect_nothing_far_away(c, body, 2);
    expect_errors_of_a_step(c, body, offset);
  }
}

}  // namespace
}  // namespace jetlag::testing
