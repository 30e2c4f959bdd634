// SPDX-License-Identifier: MIT
#pragma once
// How far the elements of solids are deformed.

#include <cstddef>
#include <string>
#include <vector>

#include "jetlag/model/system.hpp"

namespace jetlag {

/// The elements of solids of one kind.
struct Solid {
  std::string law;         // as a scene calls it
  std::vector<int> cells;  // shape (count, dimension + 1), row by row: particles
  double thickness = 1;    // [m], of triangles
};

/// What becomes of them over the frames of a run. F is the deformation gradient of an element, J = det F.
struct Deformation {
  std::string law;
  std::size_t count = 0;
  double volume = 0;                 // at rest [m^3]
  double min_j = 1, min_j_time = 0;  // [1], [s]
  std::vector<int> min_j_element{};  // its particles
  double max_stretch = 1;            // the largest singular value of F, to 1e-7
  std::size_t inverted = 0;          // the most elements with J <= 0 in one frame
};

class DeformationMeter {
 public:
  /// rest: positions at rest [m], shape (particles, dimension), dimension 2 or 3. Solids of one law are counted together.
  DeformationMeter(const std::vector<Solid>& solids, const Coordinates<double>& rest);

  /// A frame.
  void take(double time, const Coordinates<double>& position);

  const std::vector<Deformation>& found() const { return found_; }

 private:
  struct Group {
    std::vector<int> cells;
    std::vector<double> inverse;  // [element]: of the edges at rest, a square matrix
  };

  template <int D>
  void add(const Solid& solid, const Coordinates<double>& rest, Group& group, Deformation& found);
  template <int D>
  void take(double time, const Coordinates<double>& position, const Group& group, Deformation& found);

  int dimension_;
  std::vector<Group> groups_;
  std::vector<Deformation> found_;
};

}  // namespace jetlag
