// SPDX-License-Identifier: MIT
// Medit's ASCII mesh format: sections, each a word, a count and that many rows.
// Source: P. Frey, MEDIT: An interactive mesh visualization software, INRIA RT-0253, 2001. Programs add sections of their
// own to it, and write words and numbers in their own ways.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <new>

#include "jetlag/scenes/error.hpp"
#include "jetlag/scenes/mesh.hpp"
#include "scenes/meshes/words.hpp"

namespace jetlag {

namespace {

constexpr long max_rows = 50'000'000;

/// Whether a word begins a section, as no entry of a row does.
bool is_name(const std::string& word) { return std::isalpha(static_cast<unsigned char>(word[0])) != 0; }

/// Whether they are the same but for the case of letters.
bool is(const std::string& word, std::string_view section) {
  return std::ranges::equal(
      word, section, [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
}

void read_vertices(Words& words, Mesh& mesh) {
  const long count = words.whole("the number of vertices", 1, max_rows);
  std::vector<double> flat;  // grows with what is really there, whatever the file promises
  for (long i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) flat.push_back(words.real("a coordinate"));
    words.real("a reference");
  }
  mesh.position = Coordinates<double>::Map(flat.data(), count, 3);
}

void read_tetrahedra(Words& words, Mesh& mesh) {
  const long count = words.whole("the number of tetrahedra", 0, max_rows), vertices = mesh.position.rows();
  if (vertices == 0) words.refuse("Tetrahedra come before Vertices");
  long turned = 0, line_of_first = 0;
  for (long i = 0; i < count; ++i) {
    std::array<int, 4> t;
    for (int& v : t) v = static_cast<int>(words.whole("a vertex of a tetrahedron", 1, vertices)) - 1;
    words.real("a reference");
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b)
        if (t[a] == t[b])
          words.refuse("tetrahedron " + std::to_string(i + 1) + " has vertex " + std::to_string(t[a] + 1) +
                       " twice");
    const double volume = six_volumes(mesh.position, t);
    if (!(std::abs(volume) > 0.0)) words.refuse("tetrahedron " + std::to_string(i + 1) + " has no volume");
    if (volume < 0) {
      if (turned++ == 0) line_of_first = words.line();
      std::swap(t[2], t[3]);
    }
    mesh.tetrahedra.push_back(t);
  }
  if (turned > 0)
    mesh.warnings.push_back("mesh: " + words.name() + ": " + std::to_string(turned) + " of " +
                            std::to_string(count) + " tetrahedra, the first of them in line " +
                            std::to_string(line_of_first) +
                            ", had their vertices in the order of a negative volume and were turned round");
}

/// Names vertices that are in no tetrahedron: nothing of the mesh holds them.
void warn_of_loose_vertices(const Words& words, Mesh& mesh) {
  std::vector<bool> is_held(static_cast<std::size_t>(mesh.position.rows()), false);
  for (const auto& t : mesh.tetrahedra)
    for (const int v : t) is_held[static_cast<std::size_t>(v)] = true;
  constexpr long most_named = 10;
  long loose = 0;
  std::string names;
  for (std::size_t v = 0; v < is_held.size(); ++v) {
    if (is_held[v] || loose++ >= most_named) continue;
    names += (names.empty() ? "" : ", ") + std::to_string(v + 1) + " (particle " + std::to_string(v) + ")";
  }
  if (loose == 0) return;
  if (loose > most_named) names += " and " + std::to_string(loose - most_named) + " more";
  mesh.warnings.push_back("mesh: " + words.name() + ": " +
                          (loose == 1 ? "a vertex is in no tetrahedron, so no edge holds it: "
                                      : "vertices are in no tetrahedron, so no edges hold them: ") +
                          names);
}

/// Passes over a section: its count and its rows, up to the next name. False at the end.
bool pass_over(Words& words, std::string& word) {
  do
    if (!words.next(word)) return false;
  while (!is_name(word));
  return true;
}

Mesh read(Words& words) {
  Mesh mesh;
  std::string word, passed;
  if (!words.next(word) || !is(word, "MeshVersionFormatted"))
    words.refuse("a Medit mesh begins with MeshVersionFormatted");
  words.whole("the version", 1, 4);
  bool goes_on = words.next(word);
  while (goes_on && !is(word, "End")) {
    if (!is_name(word))
      words.refuse("got '" + word.substr(0, 40) +
                   "'; must be a section of a Medit mesh, such as Vertices or Tetrahedra");
    if (is(word, "Dimension")) {
      words.whole("the dimension", 3, 3);
      goes_on = words.next(word);
    } else if (is(word, "Vertices")) {
      if (mesh.position.rows() > 0) words.refuse("Vertices are given twice");
      read_vertices(words, mesh);
      goes_on = words.next(word);
    } else if (is(word, "Tetrahedra")) {
      if (!mesh.tetrahedra.empty()) words.refuse("Tetrahedra are given twice");
      read_tetrahedra(words, mesh);
      goes_on = words.next(word);
    } else {
      if (passed.size() < 100) passed += (passed.empty() ? "; passed over: " : ", ") + word.substr(0, 40);
      goes_on = pass_over(words, word);
    }
  }
  if (mesh.position.rows() == 0) words.refuse("there is no section Vertices" + passed);
  if (mesh.tetrahedra.empty()) words.refuse("there are no Tetrahedra" + passed);
  warn_of_loose_vertices(words, mesh);
  mesh.edges = edges_of(mesh.tetrahedra, {});
  return mesh;
}

}  // namespace

Mesh read_medit(const std::filesystem::path& file) {
  Words words(file);
  try {
    return read(words);
  } catch (const std::bad_alloc&) {
    words.refuse("the memory that this process may have is not enough for it");
  }
}

}  // namespace jetlag
