// SPDX-License-Identifier: MIT
#pragma once
// The registers of what a scene chooses from, beside its method: forces, controls, truncation laws, generators of
// particles. Each has a record with its name, its keys and its reader: scenes are checked by it, and pages print it.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jetlag/control/control.hpp"
#include "jetlag/truncation/sequential.hpp"
#include "scenes/keys.hpp"
#include "scenes/parts.hpp"
#include "scenes/reader.hpp"

namespace jetlag {

struct ControlRecord {
  std::string name;  // in a scene
  std::string what;  // one line
  SceneKeys keys;    // beside type and courant, without "control."
  std::unique_ptr<Control> (*read)(const Value& control, const TruncationLaw& law);
  bool reads_variance = false;  // of the law
};
const std::vector<ControlRecord>& control_records();

struct LawRecord {
  std::string name;  // in a scene
  std::string what;  // one line
  SceneKeys keys;    // without "integrator."
  Truncation (*read)(const Value& integrator);
};
const std::vector<LawRecord>& law_records();

/// What the forces of a scene are read into.
struct ForcesRead {
  const Particles& particles;
  const std::vector<double>& up;  // a direction, shape (dimension)
  System<double>& system;
  Drawn drawn{};
  std::vector<std::string> warnings{};
  std::vector<std::shared_ptr<ContactRecord>> contacts{};
  std::optional<double> rigidity{};  // of the last membrane of one material, as a plate [N m]
};

struct ForceRecord {
  std::string name;  // in a scene
  std::string what;  // one line
  SceneKeys keys;    // beside type, without "forces[]."
  void (*read)(const Value& force, ForcesRead& into);
};
const std::vector<ForceRecord>& force_records();  // all of them
std::vector<ForceRecord> solid_records();         // of tetrahedra, triangles and their faces
std::vector<ForceRecord> cloth_records();         // of sheets of triangles in space
std::vector<ForceRecord> molecular_records();     // of bonds
std::vector<ForceRecord> contact_records();       // of surfaces that touch

/// Where particles come from: the key that says so is the name of the choice.
const std::vector<Choice>& particle_choices();

/// What obstacles are made of, likewise.
const std::vector<Choice>& obstacle_choices();

/// The keys of a scene beside those of these registers; with a point those of a part of it.
const SceneKeys& scene_keys();

}  // namespace jetlag
