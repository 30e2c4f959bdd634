// SPDX-License-Identifier: MIT
#pragma once
// Candidates: the stencils of a surface that may come near each other before long.
//
// Looking at all stencils at every step would cost too much. When the surface is looked at every vertex gets a track, the
// straight line on which it moves, and room about it, and those stencils are found whose features may come within reach of
// each other as long as all vertices stay in their rooms and a time is not over. A step then costs O(1) a vertex, until one
// leaves its room. Vertices that move with each other keep their distance, so tracks are those of a system that moves with
// their mean velocity.
//
// Broad phase: an R-tree of boxes about the tracks (Boost.Geometry).

#include <cstdint>
#include <span>
#include <vector>

#include "jetlag/contact/stencil.hpp"
#include "jetlag/contact/surface.hpp"
#include "jetlag/model/changing_elements.hpp"

namespace jetlag {

class Candidates {
 public:
  /// reach [m] > 0: a stencil that is not a candidate is farther apart. with_itself: whether features of one body, which edges
  /// and triangles hold together, are candidates. Stencils of fixed particles alone never are.
  /// Throws std::invalid_argument for particles that the model does not have.
  Candidates(Surface surface, const Model<double>& model, double reach, bool with_itself = true);

  /// What is known of the motion no longer holds.
  void forget() { is_known_ = false; }

  /// Of a step of h [s] of all: how much of it the list holds for, > 0. Whether it is another list: `looks` grows. Series that
  /// are not finite are no matter of this one: then all of it. whole: all of it in any case, however long the list becomes.
  double cover(const MotionAhead& motion, double h, bool whole = false);

  /// Some of the particles, each with a clock of its own, have new series: whether it is another list. It holds up to until().
  bool cover(const MotionAhead& motion, std::span<const int> updated);
  double until() const { return until_; }  // [s]

  /// The time [s] up to which the features of a stencil are farther apart than reach [m], seen from tracks and rooms; -infinity
  /// where these do not tell. Of a list that holds.
  double apart_until(const Stencil& stencil, double now, double reach) const;

  /// Whether the series of the last call, in its step, were finite.
  bool are_finite() const { return are_finite_; }

  /// Ascending.
  const std::vector<Stencil>& list() const { return list_; }

  /// Whether a particle is a vertex of the surface.
  bool has(int particle) const { return place_[particle] >= 0; }

  /// How often the surface has been looked at.
  std::uint64_t looks() const { return looks_; }

  const Surface& surface() const { return surface_; }

 private:
  struct Track {
    double x[3] = {}, v[3] = {};  // [m], [m/s]
    double room = 0;              // [m]
  };
  void find_curve(std::size_t p, const PathView& path, double h);
  bool stays(std::size_t p, const PathView& path, double now, double h) const;
  void choose_room();
  void look(const MotionAhead& motion, bool whole);
  bool find(double horizon, std::size_t most);

  Surface surface_;
  int dimension_;
  double reach_;
  std::vector<bool> fixed_;
  std::vector<int> place_;     // of a particle among the vertices; -1
  std::vector<int> body_;      // of a vertex; empty: all may touch all
  double part_ = 0.1;          // of the edges, that is room
  std::uint64_t covered_ = 0;  // steps since the last look
  bool is_known_ = false, are_finite_ = true;
  double begin_ = 0, until_ = 0;  // [s]
  double drift_[3] = {};          // mean velocity [m/s]
  double room_ = 0;               // [m], beyond the curves of a step
  std::vector<Track> tracks_;
  std::vector<double> curve_;  // how far each vertex leaves a straight line in its step, at most [m]
  std::vector<Stencil> list_;
  std::uint64_t looks_ = 0;
};

}  // namespace jetlag
