// SPDX-License-Identifier: MIT
// The register of built-in scenes: to add one, write its file, declare it in built_in.hpp and add its line here.
#include "scenes/built_in/built_in.hpp"

namespace jetlag {

const std::vector<BuiltInScene>& built_in_scenes() {
  static const std::vector<BuiltInScene> scenes{body(),       ellipse(), two_body(),     cloth(),     chain(),
                                                stiff_spot(), beam(),    spinning_bar(), inclusion(), flag(),
                                                cradle(),     drape(),   pile()};
  return scenes;
}

}  // namespace jetlag
