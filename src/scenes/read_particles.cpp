// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <cmath>
#include <system_error>

#include "jetlag/base/text.hpp"
#include "jetlag/model/lumped_mass.hpp"
#include "jetlag/scenes/error.hpp"
#include "jetlag/truncation/draws.hpp"
#include "scenes/choices.hpp"
#include "scenes/parts.hpp"

namespace jetlag {

namespace {

/// A vector for each particle: an array of vectors.
Coordinates<double> read_rows(const Value& rows, int dimension) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (count > max_particles) rows.refuse("at most " + std::to_string(max_particles) + " particles");
  Coordinates<double> all(count, dimension);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto row = rows.at(static_cast<std::size_t>(i)).vector(dimension);
    all.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), dimension);
  }
  return all;
}

/// {"spin": [rad/s], "about": a point, "drift": [m/s]}: v_i = drift + spin x (x_i - about). In the plane spin is a number.
void read_spin(const Value& value, Particles& particles) {
  value.only({"spin", "about", "drift"});
  const int dimension = particles.dimension;
  const Coordinates<double>& x = particles.state.position;
  const Value spin = value.at("spin");
  if (dimension == 1) spin.refuse("left out on a line, where nothing turns");
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();
  if (dimension == 2)
    omega[2] = spin.number();
  else
    omega = Eigen::Map<const Eigen::Vector3d>(spin.vector(3).data());
  const Eigen::Map<const Eigen::VectorXd> mass(particles.mass.data(),
                                               static_cast<Eigen::Index>(particles.mass.size()));
  const Eigen::RowVectorXd middle = mass.transpose() / mass.sum() * x;
  const auto about =
      value.at("about", std::vector<double>(middle.data(), middle.data() + dimension)).vector(dimension);
  const auto drift = value.at("drift", std::vector<double>(dimension, 0.0)).vector(dimension);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    Eigen::Vector3d arm = Eigen::Vector3d::Zero();
    for (int c = 0; c < dimension; ++c) arm[c] = x(i, c) - about[c];
    const Eigen::Vector3d v = omega.cross(arm);
    for (int c = 0; c < dimension; ++c) particles.state.velocity(i, c) = drift[c] + v[c];
  }
}

/// "velocity": a vector for each particle, one vector for all, {"normal": deviation}, or a spin. Fixed particles are at rest.
void read_velocity(const Value& value, std::uint64_t seed, Particles& particles) {
  Coordinates<double>& velocity = particles.state.velocity;
  const auto count = static_cast<std::size_t>(velocity.rows());
  const bool listed = value.is_array() && value.size() > 0 && value.at(0).is_array();
  if (value.is_object() && value.has("spin")) {
    read_spin(value, particles);
  } else if (value.is_object()) {
    if (!value.has("normal")) value.refuse("an object with spin or normal, a vector, or a list of vectors");
    const double deviation = value.only({"normal"}).at("normal").number(non_negative);
    for (std::size_t i = 0; i < count; ++i)
      for (int c = 0; c < particles.dimension; ++c)
        velocity(i, c) = deviation * standard_normal(seed, static_cast<std::uint32_t>(i), c);
  } else if (listed) {
    if (value.size() != count) value.refuse("as many velocities as particles, " + std::to_string(count));
    velocity = read_rows(value, particles.dimension);
  } else {
    const auto all = value.vector(particles.dimension);
    velocity.rowwise() = Eigen::Map<const Eigen::RowVectorXd>(all.data(), particles.dimension);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!particles.fixed[i]) continue;
    if (listed && !velocity.row(i).isZero(0.0)) value.at(i).refuse("zero, because the particle is fixed");
    velocity.row(i).setZero();
  }
}

/// "fix_below", "fix_above": holds what lies within a distance of the lowest or highest vertex, along "fix_axis".
void fix_ends(const Value& value, Particles& particles) {
  const std::vector<std::string> axes{"x", "y", "z"};
  const std::string usual = axes[std::min(1, particles.dimension - 1)];
  const std::string named =
      value.at("fix_axis", usual).one_of({axes.begin(), axes.begin() + particles.dimension});
  const auto height = particles.state.position.col(std::ranges::find(axes, named) - axes.begin());
  if (const auto below = value.find("fix_below")) {
    const double limit = height.minCoeff() + below->number(non_negative);
    for (Eigen::Index i = 0; i < height.size(); ++i)
      if (height[i] <= limit) particles.fixed[i] = true;
  }
  if (const auto above = value.find("fix_above")) {
    const double limit = height.maxCoeff() - above->number(non_negative);
    for (Eigen::Index i = 0; i < height.size(); ++i)
      if (height[i] >= limit) particles.fixed[i] = true;
  }
}

/// Numbers within the range of double may be made into others that are not.
void require_finite(const Value& particles, const char* key, const Coordinates<double>& rows) {
  if (rows.allFinite() && rows.cwiseAbs().maxCoeff() < 1e150) return;
  for (const char* maker : {key, "mesh", "ellipsoid", "ellipse", "box", "sheet"})
    if (particles.has(maker))
      throw SceneError(particles.path() + "." + maker +
                       ": makes numbers beyond 1e150, whose squares overflow; must be " + "smaller");
}

/// "mass", or that of the elements of the mesh by "density" and "thickness".
void read_mass(const Value& value, Particles& particles) {
  const Mesh& mesh = particles.mesh;
  const auto count = static_cast<std::size_t>(particles.rest.rows());
  const Range any{1e-300, 1e300, true, true, "a number > 0, from 1e-300 to 1e300"};
  const auto density = value.find("density"), thickness = value.find("thickness");
  if (thickness && (!density || mesh.triangles.empty()))
    thickness->refuse(density ? "left out: these particles have no triangles" : "left out where density is");
  if (!density) {
    particles.mass = value.at("mass", 1.0).numbers(count, any, "particle");
    return;
  }
  if (value.has("mass")) density->refuse("left out beside mass, or mass beside it");
  const double rho = density->number(any);
  if (mesh.tetrahedra.empty() && mesh.triangles.empty())
    density->refuse("left out, and mass in its place: these particles have no tetrahedra or triangles");
  particles.mass.assign(count, 0.0);
  const auto add = [&](const std::vector<double>& more) {
    for (std::size_t i = 0; i < count; ++i) particles.mass[i] += more[i];
  };
  checked(*density, [&] {
    if (!mesh.tetrahedra.empty()) add(lumped_masses(particles.rest, mesh.tetrahedra, rho));
    return true;
  });
  if (!mesh.triangles.empty()) {
    const Value of_sheets = particles.dimension == 2 ? value.at("thickness", 1.0) : value.at("thickness");
    particles.thickness = of_sheets.number(positive);
    checked(*density, [&] {
      add(lumped_masses(particles.rest, mesh.triangles, rho, *particles.thickness));
      return true;
    });
  }
  for (std::size_t i = 0; i < count; ++i)
    if (!any.contains(particles.mass[i]))
      throw SceneError(density->path() + ": gives particle " + std::to_string(i) + " a mass of " +
                       shown(particles.mass[i]) + " kg" +
                       (particles.mass[i] == 0
                            ? ", where it is in no element or its elements have no volume to speak of"
                            : "") +
                       "; must be > 0, from 1e-300 to 1e300; or list mass");
}

/// The key that says where particles come from: of the first generator that is there, or "position".
std::string origin_of(const Value& particles) {
  for (const Choice& choice : particle_choices())
    if (choice.name != "position" && particles.has(choice.name)) return choice.name;
  return "position";
}

}  // namespace

const std::vector<Choice>& particle_choices() {
  static const SceneKey mass{"mass", "[kg], 1e-300 to 1e300: one for all or a list", "1"},
      velocity{
          "velocity",
          "[m/s], one vector for all or a list; `{\"normal\": deviation}`: normal numbers; `{\"spin\": w, "
          "\"about\": point, \"drift\": v}`: drift + spin x (x - about), spin [rad/s] a vector, in the "
          "plane a number, about the centre of mass where it is left out",
          "0"},
      density{"density",
              "[kg/m^3], > 0, of tetrahedra or triangles, in place of mass: each hands its mass to its "
              "vertices in "
              "equal parts",
              "none"},
      thickness{"thickness", "[m], > 0, of triangles beside density; also for forces that say none",
                "none without density; required for sheets in space; 1 in the plane"},
      rest{"rest", "positions [m] at which elements of solids are at rest, a vector for each particle",
           "none: where they begin"},
      fixed{"fixed", "a list of particles that do not move", "none"};
  static const auto generator = [](const SceneKeys& own, const SceneKey& springs) {
    return joined(
        {own,
         {mass,
          density,
          thickness,
          rest,
          velocity,
          fixed,
          {"fix_below", "fixes what is within this distance of the lowest [m], along `fix_axis`", "none"},
          {"fix_above", "the same of the highest", "none"},
          {"fix_axis", "`x`, `y` or `z`", "y"},
          springs}});
  };
  static const SceneKey edges{"springs", "which edges there are for springs: `edges`", "edges"};
  static const std::string radii =
      "an object: `radii` [m] along the axes, `cells` (how many across and along), "
      "`cut` (two fractions of the second radius, 0 to 1, where it is cut off)";
  static const std::vector<Choice> choices = {
      {"position",
       {{"position", "[m], a vector for each particle", "required"},
        {"tetrahedra",
         "elements of solids in space: lists of four particles, with (x_1 - x_0) . ((x_2 - x_0) x (x_3 - "
         "x_0)) > 0 "
         "at rest",
         "none"},
        {"triangles",
         "elements in the plane, counterclockwise at rest, or of cloth in space: lists of three particles",
         "none"},
        velocity,
        mass,
        density,
        thickness,
        rest,
        fixed}},
      {"box",
       generator({{"box",
                   "tetrahedra, in the plane triangles: an object with `lengths` [m] along the axes, "
                   "`cells` along each, and its lowest `corner` [m] (the origin where it is left out). "
                   "Each cell is cut along its diagonal (1, 1, 1) (Kuhn's mesh)",
                   "required"}},
                 edges)},
      {"sheet",
       generator(
           {{"sheet",
             "triangles in space at z = 0: an object with `lengths` [m] along x and y, `cells` along each, "
             "a `pattern` (`equilateral`, where triangles are so if cells are sqrt(3)/2 as high as wide; "
             "`crisscross`; `uniform`), and its lowest `corner` [m] (the origin where it is left out)",
             "required"}},
           edges)},
      {"mesh", generator({{"mesh",
                           "a Medit file (.mesh) of tetrahedra or a Wavefront file (.obj) of a surface, "
                           "beside the scene or with its path; sections "
                           "of other things are passed over, tetrahedra of negative volume turned round",
                           "required"}},
                         edges)},
      {"ellipsoid", generator({{"ellipsoid", radii, "required"}}, edges)},
      {"ellipse", generator({{"ellipse", radii, "required"}}, edges)},
      {"grid",
       generator({{"grid", "counts along one, two or three axes", "required"},
                  {"spacing", "between neighbours [m], > 0", "required"}},
                 {"springs", "`edges`: of neighbours; `cloth`: also diagonals and over two", "edges"})}};
  return choices;
}

Particles read_particles(const Value& value, int dimension, std::uint64_t seed,
                         const std::filesystem::path& folder) {
  if (!value.is_object())
    value.refuse("an object: positions, or a generator such as mesh, grid, ellipse, ellipsoid");
  Particles particles;
  particles.dimension = dimension;
  const std::string origin = origin_of(value);
  std::vector<std::string_view> keys;
  for (const SceneKey& key : named(particle_choices(), origin).keys) keys.push_back(key.key);
  value.only(keys);
  if (origin == "position") particles.state.position = read_rows(value.at("position"), dimension);
  if (origin == "position" && particles.state.position.rows() == 0)
    value.at("position").refuse("at least one particle");
  particles.mesh = read_mesh(origin, value, particles.state.position.rows(), dimension, folder);
  if (!value.has("position")) {
    particles.state.position = particles.mesh.position;
    if (!value.has("grid")) value.at("springs", "edges").one_of({"edges"});
  }
  const auto count = static_cast<std::size_t>(particles.state.position.rows());

  particles.own = count;
  if (origin == "grid")
    for (std::size_t axis = 0; axis < value.at("grid").size(); ++axis)
      particles.grid.push_back(static_cast<int>(value.at("grid").at(axis).integer(1, max_particles)));
  particles.rest = particles.state.position;
  if (const auto rest = value.find("rest")) {
    if (rest->size() != count) rest->refuse("as many positions as particles, " + std::to_string(count));
    particles.rest = read_rows(*rest, dimension);
  }
  read_mass(value, particles);
  particles.fixed.assign(count, false);
  const Value fixed = value.at("fixed", JsonText{"[]"});
  for (std::size_t i = 0; i < fixed.size(); ++i)
    particles.fixed[fixed.at(i).integer(0, static_cast<std::int64_t>(count) - 1)] = true;
  if (origin != "position") fix_ends(value, particles);
  particles.state.velocity = Coordinates<double>::Zero(particles.state.position.rows(), dimension);
  read_velocity(value.at("velocity", std::vector<double>(dimension, 0.0)), seed, particles);
  require_finite(value, value.has("position") ? "position" : "grid", particles.state.position);
  require_finite(value, "rest", particles.rest);
  require_finite(value, "velocity", particles.state.velocity);
  return particles;
}

}  // namespace jetlag
