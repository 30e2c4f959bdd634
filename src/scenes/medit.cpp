// SPDX-License-Identifier: MIT
// Medit's ASCII mesh format: keywords, each followed by a count and that many rows.
// Source: P. Frey, MEDIT: An interactive mesh visualization software, INRIA RT-0253, 2001.
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/mesh.hpp"

namespace jetlag {

namespace {

constexpr long max_rows = 50'000'000;

/// Words of a file, one after another, with their line numbers; '#' starts a comment.
class Words {
 public:
  explicit Words(const std::filesystem::path& file) : name_(file.string()), in_(file) {
    if (!std::filesystem::is_regular_file(file) || !in_)
      throw SceneError("mesh: got \"" + name_ + "\"; must be a file that can be read");
  }

  /// The next word; false at the end.
  bool next(std::string& word) {
    while (!(line_ >> word) || word[0] == '#') {
      std::string text;
      if (!std::getline(in_, text)) return false;
      ++number_;
      if (text.size() > 100'000) refuse("a line longer than 100000 characters");
      line_.clear();
      line_.str(text.substr(0, text.find('#')));
    }
    return true;
  }

  double real(const char* what) {
    const std::string word = required(what);
    double x = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(x))
      refuse("got '" + word.substr(0, 40) + "' for " + what + "; must be a finite number");
    return x;
  }

  long whole(const char* what, long low, long high) {
    const std::string word = required(what);
    long x = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
    if (error != std::errc() || end != word.data() + word.size() || x < low || x > high)
      refuse("got '" + word.substr(0, 40) + "' for " + what + "; must be a whole number from " +
             std::to_string(low) + " to " + std::to_string(high));
    return x;
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw SceneError("mesh: " + name_ + ", line " + std::to_string(number_) + ": " + why);
  }

 private:
  std::string required(const char* what) {
    std::string word;
    if (!next(word)) refuse(std::string("the file ends where ") + what + " is expected");
    return word;
  }

  std::string name_;
  std::ifstream in_;
  std::istringstream line_;
  long number_ = 0;
};

/// Numbers in a row of a section that is passed over.
const std::map<std::string, int> other_sections{
    {"Triangles", 4}, {"Quadrilaterals", 5},   {"Hexahedra", 9}, {"Edges", 3},
    {"Corners", 1},   {"RequiredVertices", 1}, {"Ridges", 1},    {"RequiredEdges", 1},
    {"Normals", 3},   {"NormalAtVertices", 2}, {"Tangents", 3},  {"TangentAtVertices", 2}};

void read_vertices(Words& words, Mesh& mesh) {
  const long count = words.whole("the number of vertices", 1, max_rows);
  std::vector<double> flat;  // grows with what is really there, whatever the file promises
  for (long i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) flat.push_back(words.real("a coordinate"));
    words.whole("a reference", std::numeric_limits<long>::min(), std::numeric_limits<long>::max());
  }
  mesh.position = Coordinates<double>::Map(flat.data(), count, 3);
}

void read_tetrahedra(Words& words, Mesh& mesh) {
  const long count = words.whole("the number of tetrahedra", 0, max_rows), vertices = mesh.position.rows();
  if (vertices == 0) words.refuse("Tetrahedra come before Vertices");
  bool mirrored = false;
  for (long i = 0; i < count; ++i) {
    std::array<int, 4> t;
    for (int& v : t) v = static_cast<int>(words.whole("a vertex of a tetrahedron", 1, vertices)) - 1;
    words.whole("a reference", std::numeric_limits<long>::min(), std::numeric_limits<long>::max());
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b)
        if (t[a] == t[b])
          words.refuse("tetrahedron " + std::to_string(i + 1) + " has vertex " + std::to_string(t[a] + 1) +
                       " twice");
    const double volume = six_volumes(mesh.position, t);
    if (!(std::abs(volume) > 0.0)) words.refuse("tetrahedron " + std::to_string(i + 1) + " has no volume");
    if (i == 0) mirrored = volume < 0;  // some programs number the vertices the other way round
    if ((volume < 0) != mirrored)
      words.refuse("tetrahedron " + std::to_string(i + 1) +
                   " is inverted: its volume has the other sign than the first");
    if (mirrored) std::swap(t[2], t[3]);
    mesh.tetrahedra.push_back(t);
  }
}

}  // namespace

Mesh read_medit(const std::filesystem::path& file) {
  Words words(file);
  Mesh mesh;
  std::string word;
  if (!words.next(word) || word != "MeshVersionFormatted")
    words.refuse("a Medit mesh begins with MeshVersionFormatted");
  words.whole("the version", 1, 4);
  bool ended = false;
  while (!ended && words.next(word)) {
    if (word == "Dimension") {
      words.whole("the dimension", 3, 3);
    } else if (word == "Vertices") {
      if (mesh.position.rows() > 0) words.refuse("Vertices are given twice");
      read_vertices(words, mesh);
    } else if (word == "Tetrahedra") {
      if (!mesh.tetrahedra.empty()) words.refuse("Tetrahedra are given twice");
      read_tetrahedra(words, mesh);
    } else if (word == "End") {
      ended = true;
    } else if (const auto other = other_sections.find(word); other != other_sections.end()) {
      const long rows = words.whole("a number of rows", 0, max_rows);
      for (long i = 0; i < rows * other->second; ++i) words.real("an entry");
    } else {
      words.refuse("got '" + word.substr(0, 40) +
                   "'; must be a section of a Medit mesh, such as Vertices or Tetrahedra");
    }
  }
  if (mesh.position.rows() == 0) words.refuse("there is no section Vertices");
  if (mesh.tetrahedra.empty()) words.refuse("there are no Tetrahedra");
  mesh.edges = edges_of(mesh.tetrahedra, {});
  return mesh;
}

}  // namespace jetlag
