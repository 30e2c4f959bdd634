// SPDX-License-Identifier: MIT
// Elements that come and go, by a law that stands for all: two masses that attract each other while they are near.
#include "jetlag/model/changing_elements.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

#include "jetlag/control/fixed_step.hpp"
#include "jetlag/control/jorba_zou.hpp"
#include "jetlag/ensembles/ensemble.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/integrators/explicit/leapfrog.hpp"
#include "jetlag/integrators/taylor.hpp"
#include "jetlag/model/energy.hpp"
#include "jetlag/schedule/asynchronous.hpp"
#include "jetlag/schedule/avi.hpp"
#include "jetlag/schedule/block.hpp"
#include "jetlag/schedule/lockstep.hpp"
#include "jetlag/schedule/subcycling.hpp"

namespace jetlag::testing::changing_elements_test {
namespace {

constexpr double reach = 1.0, stiffness = 4.0;

/// A spring of length 0 between particles 0 and 1 on a line while they are nearer than `reach`. It jumps there: what is on
/// stays on until it has been taken beyond.
class NearSpring final : public ElementsAlong {
 public:
  explicit NearSpring(std::size_t law) : law_(law) {}

  bool begin(const State<double>& state, Model<double>& model) override {
    if (left_at_.rows() != state.position.rows() || left_at_ != state.position)
      is_on_ = is_near(state.position);
    if (is_on_ == (model.law(law_).count() > 0)) return false;
    if (is_on_)
      model = model.with(law_, {0, 1}, {stiffness});
    else
      model = model.with(law_, {}, {});
    return true;
  }
  double up_to_change(const PositionSeries& x, double h, Report&) override {
    change_ = -1;
    constexpr int parts = 64;
    double before = 0;
    for (int part = 1; part <= parts && change_ < 0; ++part) {
      if (beyond(x, h * part / parts))
        change_ = h * part / parts;
      else
        before = h * part / parts;
    }
    if (change_ < 0) return h;
    for (double middle = (before + change_) / 2; before < middle && middle < change_;
         middle = (before + change_) / 2)
      (beyond(x, middle) ? change_ : before) = middle;
    return change_;
  }
  bool is_safe(const PositionSeries&, double, bool, Report&) override { return true; }
  void take(double h, const Coordinates<double>& position) override {
    is_on_ = h == change_ ? !is_on_ : is_near(position);
    change_ = -1;
    left_at_ = position;
  }
  std::unique_ptr<ElementsAlong> clone() const override { return std::make_unique<NearSpring>(*this); }

 private:
  static bool is_near(const Coordinates<double>& x) { return std::abs(x(1, 0) - x(0, 0)) < reach; }
  bool beyond(const PositionSeries& x, double h) const {
    double between = 0;
    for (int n = x.degree; n >= 0; --n)
      between = between * (h / x.unit) + x.coefficient(n, 1)[0] - x.coefficient(n, 0)[0];
    return is_on_ ? std::abs(between) > reach : std::abs(between) < reach;
  }

  std::size_t law_;
  bool is_on_ = false;
  double change_ = -1;
  Coordinates<double> left_at_;
};

class NearSprings final : public ChangingElements {
 public:
  std::unique_ptr<ElementsAlong> follow(const Model<double>&, std::size_t first_law) const override {
    return std::make_unique<NearSpring>(first_law);
  }
};

System<double> two_masses() {
  System<double> system(1, {1.0, 1.0});
  system.add<Drag>({{0}}, {{0.0}});  // so that the law that changes is not the first one
  system.add_changing({record_law<ZeroLengthSpring>(1)}, std::make_shared<NearSprings>());
  return system;
}
const State<double> coming{0.0, Coordinates<double>{{-2.0}, {2.0}}, Coordinates<double>{{1.0}, {-1.0}}};

TEST(ChangingElements, ActFromWhereTheyComeToWhereTheyGo) {
  // The distance r falls from 4 at 2 m/s. Within 1 it is r'' = -2 k r: from 1 at -2 it swings through to -1 at -2, in
  // 2 atan(r w / v) / w of time, w = sqrt(2 k); then it goes on at 2 m/s.
  const System<double> system = two_masses();
  const double w = std::sqrt(2 * stiffness), within = 2 * std::atan(reach * w / 2) / w, until = 4;
  State<double> state = coming;
  Lockstep lockstep(taylor(system, 20, std::make_unique<JorbaZou>()));
  ASSERT_EQ(lockstep.run(state, until, {}).outcome, Outcome::success);
  const double distance = 1 + 2 * (until - 1.5 - within);
  EXPECT_NEAR(state.position(0, 0) - state.position(1, 0), distance, 1e-13);
  EXPECT_NEAR(state.velocity(0, 0), 1, 1e-14);
  EXPECT_NEAR(EnergyMeter(system)(state).total(), 1, 1e-13);
}

TEST(ChangingElements, CountInTheEnergyWhereTheyAre) {
  const System<double> system = two_masses();
  EnergyMeter energy(system);
  EXPECT_EQ(energy(coming).potential, 0);
  State<double> near = coming;
  near.position << 0, 0.5;
  EXPECT_EQ(energy(near).potential, stiffness * 0.25 / 2);
  EXPECT_EQ(energy(coming).potential, 0);
}

TEST(ChangingElements, AreThoseOfTheBeginningOfAStepThatIsGiven) {
  // Of a step of 1/8 s: from the first time at which the distance is below 1, 1.625 s, to the first at which it is above.
  const System<double> system = two_masses();
  State<double> state = coming;
  Lockstep lockstep(taylor(system, 20, std::make_unique<FixedStep>(0.125)));
  ASSERT_EQ(lockstep.run(state, 1.625, {}).outcome, Outcome::success);
  EXPECT_NEAR(state.velocity(0, 0), 1, 1e-15);
  ASSERT_EQ(lockstep.run(state, 1.75, {}).outcome, Outcome::success);
  const double w = std::sqrt(2 * stiffness), t = 0.125;
  EXPECT_NEAR(2 * state.velocity(0, 0), 2 * std::cos(w * t) + 0.75 * w * std::sin(w * t), 1e-14);
}

TEST(ChangingElements, AreRefusedByMethodsThatDoNotFollowThem) {
  const System<double> system = two_masses();
  const std::vector<std::function<void()>> methods{
      [&] { Leapfrog(system, 0.1); },
      [&] { BlockSteps(system, fixed_degree(8), {}); },
      [&] { Asynchronous(system, fixed_degree(8), {}); },
      [&] { Avi(system, equal_steps(system, 0.1)); },
      [&] { Subcycling(system, ParticleSteps(2, 0.1)); },
      [&] { Ensemble(system, 8, {coming}, 1.0, Workers(1)); },
      [&] { Expansion<double> series(system); },
      [&] {
        RandomTaylor(system, geometric(4, 12, 0.5), std::make_unique<JorbaZou>(), {.shared_draw = false});
      },
  };
  for (std::size_t m = 0; m < methods.size(); ++m) EXPECT_THROW(methods[m](), std::invalid_argument) << m;
}

}  // namespace
}  // namespace jetlag::testing::changing_elements_test
