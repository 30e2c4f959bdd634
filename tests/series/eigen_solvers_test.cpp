// SPDX-License-Identifier: MIT
// Every dense decomposition of Eigen on matrices of jets, against Cramer's rule: each coefficient is right or not finite.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "jetlag/series/eigen.hpp"

namespace jetlag::testing::eigen_solvers_test {
namespace {

constexpr int N = 4;

// ---- the truth -------------------------------------------------------------------------------------------

using Wide = Jet<long double, 16>;
using WideMatrix = std::vector<std::vector<Wide>>;

Wide determinant(const WideMatrix& a) {  // by the first row
  if (a.size() == 1) return a[0][0];
  Wide sum(0);
  for (std::size_t j = 0; j < a.size(); ++j) {
    WideMatrix minor;
    for (std::size_t i = 1; i < a.size(); ++i) {
      minor.push_back(a[i]);
      minor.back().erase(minor.back().begin() + static_cast<std::ptrdiff_t>(j));
    }
    const Wide term = a[0][j] * determinant(minor);
    sum = j % 2 == 0 ? sum + term : sum - term;
  }
  return sum;
}

template <class J>
Wide widened(const J& u) {
  Wide v(0);
  for (int k = 0; k <= u.degree(); ++k) v[k] = u[k];
  return v;
}

template <class J>
class EigenSolvers : public ::testing::Test {
 protected:
  using Matrix = Eigen::Matrix<J, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<J, Eigen::Dynamic, 1>;

  static J variable() {
    if constexpr (J::degree_at_compile_time == Dynamic)
      return J::variable(0.0, N);
    else
      return J::variable(0.0);
  }

  /// By a pointer: what checks is compiled once for all solvers.
  using Solve = Vector (*)(const Matrix& a, const Vector& b);

  struct System {
    std::string name;
    Matrix a;
    Vector b;
    bool is_regular;  // at t = 0
    bool is_positive;
  };

  static System system(const char* name, std::initializer_list<J> a, std::initializer_list<J> b,
                       bool is_regular, bool is_positive) {
    const auto n = static_cast<Eigen::Index>(b.size());
    System s{name, Matrix(n, n), Vector(n), is_regular, is_positive};
    for (Eigen::Index i = 0; i < n; ++i) s.b[i] = b.begin()[i];
    for (Eigen::Index i = 0; i < n * n; ++i) s.a(i / n, i % n) = a.begin()[i];
    return s;
  }

  static std::vector<System> systems() {
    const J t = variable(), zero(0.0), one(1.0), two(2.0), t2 = t * t, t3 = t2 * t;
    return {
        system("(2 t; t 1)", {two, t, t, one}, {t, zero}, true, true),
        system("(2 t^2; t^2 1)", {two, t2, t2, one}, {t, 1.0 + t}, true, true),
        system("(2 t^3; t^3 1)", {two, t3, t3, one}, {t3, zero}, true, true),
        system("(1+t 2; 3 4-t)", {1.0 + t, two, J(3.0), 4.0 - t}, {t, 1.0 + t}, true, false),
        system("(t 1; 1 t)", {t, one, one, t}, {1.0 + t, 2.0 + t2}, true, false),
        system("(t^3 1; 1 t^3)", {t3, one, one, t3}, {t, 2.0 + t}, true, false),
        system("nearly diagonal", {two, t, t2, t, J(3.0), t, t2, t, J(5.0)}, {t, 1.0 + t, 2.0 * t2}, true,
               true),
        system("3 by 3", {4.0 + t, 1.0 + t2, t, 1.0 + t2, 3.0 - t, 0.5 + t, t, 0.5 + t, 2.0 + t3},
               {1.0 + t, t2, two}, true, true),
        system("4 by 4", {5.0 + t, one, t, t2, one, 4.0 - t, one, t, t, one, 3.0 + t, one, t2, t, one, two},
               {t, 1.0 + t, 2.0 * t2, one}, true, true),
        system("(t 0; 0 1)", {t, zero, zero, one}, {t, 1.0 + t}, false, true),
        system("(1 1; 1 1+t)", {one, one, one, 1.0 + t}, {1.0 + t, 1.0 + 2.0 * t}, false, true),
        system("(1 t; t t)", {one, t, t, t}, {1.0 + t, t}, false, true),
        system("(t t; t 2t)", {t, t, t, 2.0 * t}, {t, 3.0 * t}, false, true),
        system("(0 t; t 0)", {zero, t, t, zero}, {t2, t}, false, false),
        system("(t^2 t; 0 t)", {t2, t, zero, t}, {t2 + t, t}, false, false),
        system("(0 1; t^3 1)", {zero, one, t3, one}, {one, 1.0 + t3}, false, false),
    };
  }

  static std::vector<Wide> by_cramers_rule(const System& s) {
    const auto n = static_cast<std::size_t>(s.b.size());
    WideMatrix a(n, std::vector<Wide>(n));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        a[i][j] = widened(s.a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    std::vector<Wide> x;
    for (std::size_t j = 0; j < n; ++j) {
      WideMatrix replaced = a;
      for (std::size_t i = 0; i < n; ++i) replaced[i][j] = widened(s.b[static_cast<Eigen::Index>(i)]);
      x.push_back(determinant(replaced) / determinant(a));
    }
    return x;
  }

  /// solve(a, b) is right in every finite coefficient; all are, where A_0 is regular. The condition numbers of A_0, below
  /// 10, come in once for each order: 10^5 eps of the solution.
  static void expect_right(const char* name, Solve solve, bool needs_positive = false) {
    for (const System& s : systems()) {
      if (needs_positive && !s.is_positive) continue;
      SCOPED_TRACE(std::string(name) + " of " + s.name);
      const auto truth = by_cramers_rule(s);
      Vector x;
      try {
        x = solve(s.a, s.b);
      } catch (const std::domain_error& refused) {
        EXPECT_FALSE(s.is_regular && s.a(0, 0)[0] != 0) << refused.what();  // (t 1; 1 t): coinciding values
        continue;
      }
      for (std::size_t i = 0; i < truth.size(); ++i) {
        const J& u = x[static_cast<Eigen::Index>(i)];
        if (s.is_regular) {
          EXPECT_TRUE(isfinite(u));
        }
        for (int k = 0; k <= u.degree(); ++k) {
          if (!std::isfinite(u[k])) continue;
          EXPECT_NEAR(u[k], static_cast<double>(truth[i][k]), 1e5 * 0x1p-52 * (1 + std::abs(u[k])))
              << "coefficient " << k << " of x_" << i;
        }
      }
    }
  }
};
using Jets = ::testing::Types<Jet<double, N>, Jet<double, Dynamic>>;
struct NameOfJet {
  template <class J>
  static std::string GetName(int) {
    return J::degree_at_compile_time == Dynamic ? "Dynamic" : "Static";
  }
};
TYPED_TEST_SUITE(EigenSolvers, Jets, NameOfJet);

TYPED_TEST(EigenSolvers, ByTriangles) {
  this->expect_right("PartialPivLU",
                     [](const auto& a, const auto& b) { return a.partialPivLu().solve(b).eval(); });
  this->expect_right("FullPivLU", [](const auto& a, const auto& b) { return a.fullPivLu().solve(b).eval(); });
  this->expect_right("inverse", [](const auto& a, const auto& b) { return (a.inverse() * b).eval(); });
  this->expect_right("LLT", [](const auto& a, const auto& b) { return a.llt().solve(b).eval(); }, true);
  this->expect_right("LDLT", [](const auto& a, const auto& b) { return a.ldlt().solve(b).eval(); }, true);
}

TYPED_TEST(EigenSolvers, ByReflections) {
  this->expect_right("QR", [](const auto& a, const auto& b) { return a.householderQr().solve(b).eval(); });
  this->expect_right("ColPivQR",
                     [](const auto& a, const auto& b) { return a.colPivHouseholderQr().solve(b).eval(); });
  this->expect_right("FullPivQR",
                     [](const auto& a, const auto& b) { return a.fullPivHouseholderQr().solve(b).eval(); });
  this->expect_right("COD", [](const auto& a, const auto& b) {
    return a.completeOrthogonalDecomposition().solve(b).eval();
  });
}

TYPED_TEST(EigenSolvers, BySpectra) {
  this->expect_right("JacobiSVD", [](const auto& a, const auto& b) {
    using Matrix = std::decay_t<decltype(a)>;
    const Eigen::JacobiSVD<Matrix> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
    return svd.solve(b).eval();
  });
  this->expect_right(
      "SelfAdjointEigenSolver",
      [](const auto& a, const auto& b) {
        using Matrix = std::decay_t<decltype(a)>;
        const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(a);
        auto y = (spectrum.eigenvectors().transpose() * b).eval();
        for (Eigen::Index i = 0; i < y.size(); ++i) y[i] = y[i] / spectrum.eigenvalues()[i];
        return (spectrum.eigenvectors() * y).eval();
      },
      true);
}

}  // namespace
}  // namespace jetlag::testing::eigen_solvers_test
