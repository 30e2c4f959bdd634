// SPDX-License-Identifier: MIT
// Forces of solids: elastic tetrahedra and triangles, and loads on the faces of tetrahedra.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "jetlag/base/text.hpp"
#include "jetlag/forces/forces.hpp"
#include "jetlag/forces/solids/lame.hpp"
#include "jetlag/output/shape.hpp"
#include "jetlag/scenes/error.hpp"
#include "scenes/choices.hpp"
#include "scenes/forces/elements.hpp"
#include "scenes/forces/materials.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

/// Warns of locking, but not in plane stress, where the material is free across.
Material read_material(const Value& force, ForcesRead& into, std::size_t count, bool has_plane_stress) {
  Material material;
  std::vector<std::string> of_locking;
  material.elastic = read_lame(force, count, of_locking);
  material.viscous = read_viscosity(force, material.elastic);
  bool is_plane_stress = false;
  if (into.particles.dimension == 3) {
    for (const char* key : {"plane", "thickness"})
      if (const auto value = force.find(key)) value->refuse("left out in space");
  } else {
    material.thickness = read_thickness(force, into);
    const Value plane = force.at("plane", "strain");
    is_plane_stress = plane.one_of({"strain", "stress"}) == "stress";
    if (is_plane_stress && !has_plane_stress)
      plane.refuse(
          "strain: of this law the stretch across would be the root of an equation; stvk has stress");
  }
  if (!is_plane_stress) {
    std::ranges::move(of_locking, std::back_inserter(into.warnings));
    return material;
  }
  for (auto* constants : {&material.elastic, &material.viscous})
    for (Lame<double>& of : *constants) of = plane_stress(of);
  return material;
}

/// Names elements whose own Courant step is below a hundredth of the usual one. Bound of their stiffness:
/// (lambda + 2 mu) V sum |g_i|^2, g_i = c_i / Delta the gradients of their linear functions; of their inertia: their lightest
/// vertex.
template <std::size_t P>
void warn_of_slivers(const Value& value, const Cells<P>& cells, const Particles& particles,
                     const Material& material, std::vector<std::string>& warnings) {
  std::vector<double> rate;
  for (std::size_t e = 0; e < cells.size(); ++e) {
    const auto c =
        detail::cofactors(detail::edges<double, P - 1>(corners_of<P - 1>(cells[e], particles.rest)));
    Vector<double, P - 1> last = Vector<double, P - 1>::Zero();
    double squares = 0, lightest = infinite;
    for (const auto& own : c) {
      squares += own.squaredNorm();
      last += own;
    }
    const double determinant =
        detail::edges<double, P - 1>(corners_of<P - 1>(cells[e], particles.rest))[0].dot(c[0]);
    for (const int i : cells[e]) lightest = std::min(lightest, particles.mass[i]);
    const auto& [lambda, mu] = material.elastic[e];
    rate.push_back(
        std::sqrt((std::abs(lambda) + 2 * mu) * (squares + last.squaredNorm()) / determinant / lightest));
  }
  if (rate.empty()) return;
  std::vector<double> sorted = rate;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  const double usual = *middle;
  const auto count = std::ranges::count_if(rate, [&](double r) { return r > 100 * usual; });
  if (count == 0) return;
  const auto worst = static_cast<std::size_t>(std::ranges::max_element(rate) - rate.begin());
  warnings.push_back(path_of(value, worst) + ": " +
                     (count == 1 ? "a sliver" : "the worst of " + std::to_string(count) + " slivers") +
                     ": its own Courant step is some " + shown(std::round(rate[worst] / usual)) +
                     " times shorter than the usual one, and so are all steps of one clock");
}

/// Elements that are flat or inside out where they begin.
template <std::size_t P>
void require_positive(const Value& value, const Cells<P>& cells, const Particles& particles) {
  for (std::size_t e = 0; e < cells.size(); ++e) {
    const auto now = detail::edges<double, P - 1>(corners_of<P - 1>(cells[e], particles.state.position)),
               then = detail::edges<double, P - 1>(corners_of<P - 1>(cells[e], particles.rest));
    const double ratio = now[0].dot(detail::cofactors(now)[0]) / then[0].dot(detail::cofactors(then)[0]);
    if (!(ratio > 0))
      throw SceneError(path_of(value, e) + ": begins with " + shown(ratio) +
                       " times its volume at rest; must be > 0 for neo_hookean: use stable_neo_hookean");
  }
}

/// Adds elements of law L and their viscosity.
template <ForceLaw L, ForceLaw Viscous>
void add_solid(const Value& force, ForcesRead& into, bool has_plane_stress = false,
               bool must_be_positive = false) {
  constexpr std::size_t P = L::participants;
  const Value listed = force.at("elements", "mesh");
  const Cells<P> cells = read_elements<P>(listed, into.particles, into.drawn);
  require_rest_shapes<P - 1>(listed, cells, into.particles.rest);
  const Material material = read_material(force, into, cells.size(), has_plane_stress);
  if (must_be_positive) require_positive<P>(listed, cells, into.particles);
  warn_of_slivers<P>(listed, cells, into.particles, material, into.warnings);
  const auto constants = [&](const std::vector<Lame<double>>& of) {
    std::vector<std::array<double, L::material.size()>> all;
    for (const auto& [lambda, mu] : of)
      if constexpr (P == 4)
        all.push_back({lambda, mu});
      else
        all.push_back({lambda, mu, material.thickness});
    return all;
  };
  Solid& solid = into.drawn.solids.emplace_back(Solid{force.at("type").text(), {}, material.thickness});
  for (const auto& cell : cells) solid.cells.insert(solid.cells.end(), cell.begin(), cell.end());
  checked(force, [&] {
    into.system.add_at_rest<L>(cells, into.particles.rest, constants(material.elastic));
    if (is_viscous(material.viscous))
      into.system.add_at_rest<Viscous>(cells, into.particles.rest, constants(material.viscous));
    return true;
  });
}

/// Runs one of two, for the dimension of space.
template <class Space, class Plane>
void by_dimension(const Value& force, const ForcesRead& into, Space in_space, Plane in_the_plane) {
  require_dimension(force, into.particles.dimension, 2, 3);
  if (into.particles.dimension == 3)
    in_space();
  else
    in_the_plane();
}

void read_neo_hookean(const Value& force, ForcesRead& into) {
  by_dimension(
      force, into, [&] { add_solid<NeoHookean, KelvinVoigt>(force, into, false, true); },
      [&] { add_solid<PlaneNeoHookean, PlaneKelvinVoigt>(force, into, false, true); });
}

void read_stable_neo_hookean(const Value& force, ForcesRead& into) {
  const bool barrier = force.at("barrier", true).boolean();
  by_dimension(
      force, into,
      [&] {
        if (barrier)
          add_solid<StableNeoHookean, KelvinVoigt>(force, into);
        else
          add_solid<PolynomialNeoHookean, KelvinVoigt>(force, into);
      },
      [&] {
        if (barrier)
          add_solid<PlaneStableNeoHookean, PlaneKelvinVoigt>(force, into);
        else
          add_solid<PlanePolynomialNeoHookean, PlaneKelvinVoigt>(force, into);
      });
}

void read_stvk(const Value& force, ForcesRead& into) {
  by_dimension(
      force, into, [&] { add_solid<Stvk, KelvinVoigt>(force, into, true); },
      [&] { add_solid<PlaneStvk, PlaneKelvinVoigt>(force, into, true); });
}

void read_corotated(const Value& force, ForcesRead& into) {
  by_dimension(
      force, into, [&] { add_solid<Corotated, KelvinVoigt>(force, into); },
      [&] { add_solid<PlaneCorotated, PlaneKelvinVoigt>(force, into); });
}

// ---- loads on faces --------------------------------------------------------------------------------------

std::array<int, 3> sorted(std::array<int, 3> face) {
  std::ranges::sort(face);
  return face;
}

/// "faces": "boundary", a part of it, or a list; turned so that they go left as seen from outside.
Cells<3> read_faces(const Value& value, const Particles& particles) {
  require_dimension(value, particles.dimension, 3, 3);
  if (particles.mesh.tetrahedra.empty())
    value.refuse("left out with its force: these particles have no tetrahedra");
  const Cells<3> outside = boundary(particles.mesh.tetrahedra, particles.rest);
  if (outside.empty()) value.refuse("left out with its force: the tetrahedra have no face of their own");
  if (value.is_object()) return selected<3>(value, outside, particles);
  if (!value.is_array()) {
    if (!value.is_string())
      value.refuse("\"boundary\", an object with inside or outside, or a list of faces");
    value.one_of({"boundary"});
    return outside;
  }
  std::map<std::array<int, 3>, std::array<int, 3>> turned;
  for (const auto& face : outside) turned[sorted(face)] = face;
  Cells<3> faces;
  for (std::size_t e = 0; e < value.size(); ++e) {
    const auto found = turned.find(sorted(read_members<3>(value.at(e), particles.rest.rows())));
    if (found == turned.end()) value.at(e).refuse("a face of exactly one tetrahedron");
    faces.push_back(found->second);
  }
  require_no_repeats<3>(value, faces);
  return faces;
}

void read_traction(const Value& force, ForcesRead& into) {
  const Cells<3> faces = read_faces(force.at("faces", "boundary"), into.particles);
  const auto t = force.at("stress").vector(3);
  checked(force, [&] {
    into.system.add_at_rest<Traction>(faces, into.particles.rest, {{t[0], t[1], t[2]}});
    return true;
  });
}

/// Whether each edge is run through both ways.
bool is_closed(const Cells<3>& faces) {
  std::multiset<std::array<int, 2>> edges;
  for (const auto& face : faces)
    for (int i = 0; i < 3; ++i) edges.insert({face[i], face[(i + 1) % 3]});
  return std::ranges::all_of(
      edges, [&](const auto& edge) { return edges.count(edge) == edges.count({edge[1], edge[0]}); });
}

void read_pressure(const Value& force, ForcesRead& into) {
  const Value listed = force.at("faces", "boundary");
  const Cells<3> faces = read_faces(listed, into.particles);
  const auto pressure = force.at("pressure").numbers(faces.size(), any_number, "face");
  std::vector<std::array<double, 1>> parameters;
  for (const double p : pressure) parameters.push_back({p});
  into.warnings.push_back(listed.path() + (is_closed(faces) ? ": what" : ": the surface is open; what") +
                          " the pressure works is missing in the sums of energies");
  into.system.add<Pressure>(faces, parameters);
}

}  // namespace

std::vector<ForceRecord> solid_records() {
  const SceneKeys elastic = joined(
      {elastic_keys(),
       {{"thickness", "[m], > 0, of triangles", "none in space; in the plane that of the particles, or 1"},
        {"plane", "in the plane: `strain`; of `stvk` also `stress`", "none in space; strain in the plane"}}});
  const SceneKey faces{
      "faces",
      "`boundary`: all faces of one tetrahedron; `{\"inside\": [low, high]}` or `outside`: those whose "
      "middle at rest is in a box of two corners, or not; or a list of three particles each",
      "boundary"};
  return {
      {"neo_hookean",
       "Elastic tetrahedra or triangles (plane strain) that resist compression to a point without bounds: "
       "they never "
       "turn inside out",
       elastic, read_neo_hookean},
      {"stable_neo_hookean",
       "Elastic elements that may turn inside out and come back: Smith, de Goes and Kim 2018",
       joined({elastic,
               {{"barrier", "true: with their logarithm against total collapse; false: a polynomial, cheaper",
                 "true"}}}),
       read_stable_neo_hookean},
      {"stvk",
       "Elastic elements linear in Green's strain (St. Venant-Kirchhoff): soft under strong compression, "
       "where they "
       "may turn inside out and stay so",
       elastic, read_stvk},
      {"corotated",
       "Elastic elements linear in the strain that is left when their rotation is taken out; they may turn "
       "inside out, but "
       "have a kink where two of their stretches add up to zero (a mirror image is one)",
       elastic, read_corotated},
      {Traction::name,
       "A load on faces of tetrahedra that keeps its direction",
       {faces, {"stress", "force for each area at rest [Pa], three components", "required"}},
       read_traction},
      {Pressure::name,
       "A pressure from outside on faces of tetrahedra, that follows them",
       {faces, {"pressure", "[Pa]: one for all or one for each face", "required"}},
       read_pressure}};
}

}  // namespace jetlag
