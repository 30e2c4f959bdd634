// SPDX-License-Identifier: MIT
// Surfaces in Wavefront's format: lines "v x y z" and "f a b c ..", among others that are passed over.
// Source: M. Reddy, B-spline and Wavefront formats, appendix B1 of Advanced Visualizer Manual, Wavefront Technologies. The
// readers of other projects take a word that is no number for 0 (tinyobjloader 2.0), which nobody would see in a motion.
#include <Eigen/Geometry>
#include <algorithm>
#include <new>
#include <numeric>
#include <set>
#include <utility>

#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "scenes/meshes/numbers.hpp"
#include "scenes/meshes/words.hpp"

namespace jetlag {

namespace {

class SurfaceReader {
 public:
  explicit SurfaceReader(Words& words) : words_(words) {}

  Mesh read() {
    for (std::string word; words_.next(word);) {
      if (word == "v")
        vertex();
      else if (word == "f")
        face();
      else
        other(word);
    }
    if (flat_.empty()) words_.refuse("there are no vertices (v)");
    if (mesh_.triangles.empty()) words_.refuse("there are no faces (f)");
    mesh_.position = Coordinates<double>::Map(flat_.data(), count(), 3);
    mesh_.edges = edges_of({}, mesh_.triangles);
    require_no_repeats();
    if (!unknown_.empty())
      mesh_.warnings.push_back("mesh: " + words_.name() + ", " + unknown_ + ": not known, and passed over");
    warn_of_loose_vertices();
    warn_of_seams();
    return std::move(mesh_);
  }

 private:
  /// Lines that say nothing of the shape; of what is not known, the first is named.
  void other(const std::string& word) {
    static const std::set<std::string> known = {
        "vt",        "vn",     "vp",     "g",      "o",     "s",    "l",        "p",        "usemtl",
        "mtllib",    "mg",     "usemap", "maplib", "bevel", "lod",  "c_interp", "d_interp", "shadow_obj",
        "trace_obj", "cstype", "deg",    "bmat",   "step",  "curv", "curv2",    "surf",     "parm",
        "trim",      "hole",   "scrv",   "sp",     "end",   "con"};
    if (!known.contains(word) && unknown_.empty())
      unknown_ = "line " + std::to_string(words_.line()) + " with '" + word.substr(0, 40) + "'";
    words_.pass_over_line();
  }

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

  using Point = Eigen::Vector3d;
  Point at(int vertex) const { return Eigen::Map<const Point>(&flat_[3 * static_cast<std::size_t>(vertex)]); }

  /// Whether the fan about a corner covers a polygon once: no triangle is turned against the polygon's area vector (Newell).
  bool is_fan(const std::vector<int>& corners, const Point& area) const {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      const Point a = at(corners[i]) - at(corners[0]), b = at(corners[i + 1]) - at(corners[0]);
      if (!(a.cross(b).dot(area) > 0)) return false;
    }
    return true;
  }

  /// One of more than three corners becomes a fan about the first that will do.
  void face() {
    std::vector<int> corners;
    for (std::string word; words_.next_in_line(word);) corners.push_back(corner(word));
    if (corners.size() < 3) words_.refuse("a face (f) has at least three vertices");
    std::vector<int> sorted = corners;
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
      words_.refuse("a face has vertex " + std::to_string(*twice + 1) + " twice");
    if (corners.size() > 3) {
      Point area = Point::Zero();
      for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        area += (at(corners[i]) - at(corners[0])).cross(at(corners[i + 1]) - at(corners[0]));
      std::size_t turns = 0;
      for (; turns < corners.size() && !is_fan(corners, area); ++turns)
        std::ranges::rotate(corners, corners.begin() + 1);
      if (turns == corners.size()) words_.refuse("a face that is not convex: cut it into triangles");
    }
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      mesh_.triangles.push_back({corners[0], corners[i], corners[i + 1]});
  }

  void require_no_repeats() const {
    std::vector<std::array<int, 3>> sorted = mesh_.triangles;
    for (auto& t : sorted) std::ranges::sort(t);
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
      words_.refuse("two faces have the vertices " + std::to_string((*twice)[0] + 1) + ", " +
                    std::to_string((*twice)[1] + 1) + " and " + std::to_string((*twice)[2] + 1));
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
    std::ranges::sort(order, {}, [&](int v) { return std::pair(place(v), v); });
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
  std::string unknown_;
};

}  // namespace

Mesh read_wavefront(const std::filesystem::path& file) {
  Words words(file);
  try {
    return SurfaceReader(words).read();
  } catch (const std::bad_alloc&) {
    words.refuse("the memory that this process may have is not enough for it");
  }
}

}  // namespace jetlag
