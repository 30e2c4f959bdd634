// SPDX-License-Identifier: MIT
#pragma once
// Torsion about a bond.

#include <array>
#include <cmath>

#include "jetlag/forces/cloth/fold.hpp"

namespace jetlag {

/// E = k (1 + cos(n phi - phi_0)),   n = 1 .. 6,
/// of the angle phi about the bond x_1 x_2 between the planes (x_0, x_1, x_2) and (x_1, x_2, x_3): 0 where x_0 and x_3 are on
/// one side (cis), pi on opposite ones (trans), > 0 clockwise. Of cos phi and sin phi it is a polynomial, by
/// (cos phi + i sin phi)^n, which knows of no cut at pi. Participants along the bonds. stiffness k [J], phase phi_0 [rad]. The
/// forces follow from the energy.
/// Source: W. Cornell et al. (AMBER), J. Am. Chem. Soc. 117 (1995) 5179, eq. 1.
/// Range: bonds that are not in line.   Conserves: momentum, angular momentum, energy.
template <int n>
  requires(1 <= n && n <= 6)
struct Dihedral {
  static constexpr const char* name =
      std::array{"dihedral_1", "dihedral_2", "dihedral_3", "dihedral_4", "dihedral_5", "dihedral_6"}[n - 1];
  static constexpr int participants = 4;
  static constexpr std::array dimensions{3};
  static constexpr std::array parameters{"stiffness", "phase"};

  template <class T>
  static T energy(const Participants<T, 3, 4>& p, const T& stiffness, const T& phase) {
    using std::cos, std::sin, std::sqrt;
    // The fold at the bond lies flat where the dihedral angle is pi: phi = theta + pi.
    const auto& x = p.position;
    const detail::Fold<T> fold({x[1], x[2], x[0], x[3]});
    const T size = sqrt(T(fold.n_2.squaredNorm() * fold.n_3.squaredNorm()));
    const T c = -(fold.cosine / size), s = -(fold.sine / size);
    T cosine = c, sine = s;  // of i phi
    for (int i = 2; i <= n; ++i) {
      const T next = cosine * c - sine * s;
      sine = sine * c + cosine * s;
      cosine = next;
    }
    return stiffness * (T(1.0) + cos(phase) * cosine + sin(phase) * sine);
  }
};

extern template RecordedLaw record_law<Dihedral<1>>(int);  // recorded in src/forces
extern template RecordedLaw record_law<Dihedral<2>>(int);
extern template RecordedLaw record_law<Dihedral<3>>(int);

}  // namespace jetlag
