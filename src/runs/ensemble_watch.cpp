// SPDX-License-Identifier: MIT
#include "runs/ensemble_watch.hpp"

#include <charconv>
#include <cmath>

#include "jetlag/scenes/error.hpp"

namespace jetlag {

Watch read_watch(const Scene& scene, const std::string& text) {
  if (text.empty()) return {};
  const int dimension = scene.system->dimension(), particles = scene.system->particles();
  const std::string components = std::string("xyz").substr(0, dimension);
  const auto refuse = [&](const std::string& why) {
    throw SceneError("--watch: got " + text +
                     "; must be PARTICLE or PARTICLE.COMPONENT, a moving particle from 0 to " +
                     std::to_string(particles - 1) + " and a component of " + components + why);
  };
  Watch watch;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), watch.particle);
  const std::string rest(end, text.data() + text.size());
  if (error != std::errc() || watch.particle < 0 || watch.particle >= particles) refuse("");
  if (scene.system->fixed()[watch.particle]) refuse("; this particle is fixed");
  if (rest.empty()) return watch;
  const auto component = rest.size() == 2 && rest[0] == '.' ? components.find(rest[1]) : std::string::npos;
  if (component == std::string::npos) refuse("");
  watch.component = static_cast<int>(component);
  return watch;
}

std::size_t watched(const EnsembleResult& result, const Watch& watch) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t q = 0; q < result.quantities.size(); ++q) {
    const Quantity& quantity = result.quantities[q];
    if (quantity.particle < 0 || quantity.of_velocity) continue;
    if (watch.particle >= 0 && quantity.particle != watch.particle) continue;
    if (watch.component >= 0 && quantity.component != watch.component) continue;
    const double spread = result.frames.back().samples[q].spread;
    if (most < 0 || spread > most) {
      best = q;
      most = std::isfinite(spread) ? spread : 0;
    }
  }
  return best;
}

}  // namespace jetlag
