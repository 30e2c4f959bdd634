// SPDX-License-Identifier: MIT
// Surfaces in Wavefront's format: lines "v x y z" and "f a b c ..", among others that are passed over.
// Source: M. Reddy, B-spline and Wavefront formats, appendix B1 of Advanced Visualizer Manual, Wavefront Technologies. The
// readers of other projects take a word that is no number for 0 (tinyobjloader 2.0), which nobody would see in a motion.
#include <algorithm>
#include <new>
#include <numeric>

#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "scenes/meshes/numbers.hpp"
#include "scenes/meshes/words.hpp"

namespace jetlag {

namespace {

class Surface {
 public:
  explicit Surface(Words& words) : words_(words) {}

  Mesh read() {
    for (std::string word; words_.next(word);) {
      if (word == "v")
        vertex();
      else if (word == "f")
        face();
      else
        words_.pass_over_line();
    }
    if (flat_.empty()) words_.refuse("there are no vertices (v)");
    if (mesh_.triangles.empty()) words_.refuse("there are no faces (f)");
    mesh_.position = Coordinates<double>::Map(flat_.data(), count(), 3);
    mesh_.edges = edges_of({}, mesh_.triangles);
    warn_of_loose_vertices();
    warn_of_seams();
    return std::move(mesh_);
  }

 private:
  long count() const { return static_cast<long>(flat_.size() / 3); }

  /// Beyond three there may be a weight or a colour.
  void vertex() {
    std::vector<double> numbers;
    for (std::string word; words_.next_in_line(word);) numbers.push_back(coordinate(word));
    if (numbers.size() < 3) words_.refuse("a vertex (v) has three coordinates");
    flat_.insert(flat_.end(), numbers.begin(), numbers.begin() + 3);
  }

  double coordinate(const std::string& word) const {
    if (const auto x = number_of(word)) return *x;
    words_.refuse("got '" + word.substr(0, 40) + "' for a coordinate; must be a finite number");
  }

  /// a, a/texture, a/texture/normal or a//normal; below zero counted from the last vertex so far.
  int corner(const std::string& word) const {
    const auto index = whole_number_of(word.substr(0, word.find('/')));
    const long own = index && *index < 0 ? count() + *index : index.value_or(0) - 1;
    if (!index || own < 0 || own >= count())
      words_.refuse("got '" + word.substr(0, 40) + "' for a vertex of a face; must be from 1 to " +
                    std::to_string(count()) + ", the number of vertices above it, or as far below zero");
    return static_cast<int>(own);
  }

  /// One of more than three corners becomes a fan about the first.
  void face() {
    std::vector<int> corners;
    for (std::string word; words_.next_in_line(word);) corners.push_back(corner(word));
    if (corners.size() < 3) words_.refuse("a face (f) has at least three vertices");
    std::vector<int> sorted = corners;
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
      words_.refuse("a face has vertex " + std::to_string(*twice + 1) + " twice");
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      mesh_.triangles.push_back({corners[0], corners[i], corners[i + 1]});
  }

  void warn_of_loose_vertices() {
    std::vector<bool> is_held(static_cast<std::size_t>(count()), false);
    for (const auto& t : mesh_.triangles)
      for (const int v : t) is_held[static_cast<std::size_t>(v)] = true;
    const auto loose = std::ranges::count(is_held, false);
    if (loose == 0) return;
    const auto first = std::ranges::find(is_held, false) - is_held.begin();
    mesh_.warnings.push_back("mesh: " + words_.name() + ": " + std::to_string(loose) +
                             (loose == 1 ? " vertex is" : " vertices are") +
                             " in no face, so nothing holds them, the first of them " +
                             std::to_string(first + 1) + " (particle " + std::to_string(first) + ")");
  }

  /// Where a surface was cut to lay a texture on it, each side has vertices of its own: it comes apart.
  void warn_of_seams() {
    std::vector<int> order(static_cast<std::size_t>(count()));
    std::iota(order.begin(), order.end(), 0);
    const auto place = [&](int v) { return std::array{flat_[3 * v], flat_[3 * v + 1], flat_[3 * v + 2]}; };
    std::ranges::stable_sort(order, {}, place);
    long again = 0;
    int first = 0;
    for (std::size_t i = 1; i < order.size(); ++i)
      if (place(order[i]) == place(order[i - 1]) && again++ == 0) first = order[i];
    if (again > 0)
      mesh_.warnings.push_back("mesh: " + words_.name() + ": " + std::to_string(again) +
                               " vertices are where another one is, the first of them " +
                               std::to_string(first + 1) + " (particle " + std::to_string(first) +
                               "): nothing joins them, and the surface comes apart there; merge them");
  }

  Words& words_;
  Mesh mesh_;
  std::vector<double> flat_;
};

}  // namespace

Mesh read_wavefront(const std::filesystem::path& file) {
  Words words(file);
  try {
    return Surface(words).read();
  } catch (const std::bad_alloc&) {
    words.refuse("the memory that this process may have is not enough for it");
  }
}

}  // namespace jetlag
