// SPDX-License-Identifier: MIT
#pragma once
// The methods that are compared: as in a scene file, without the step.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace jetlag {

struct Competitor {
  std::string family;  // methods of one family share a curve
  std::string name;
  nlohmann::ordered_json integrator, control;
  bool random = false;   // differs from seed to seed
  bool has_step = true;  // control.step is to be filled in
  bool is_taylor = true;
  nlohmann::ordered_json schedule{};  // lockstep where null
};

std::vector<Competitor> competitors();

}  // namespace jetlag
