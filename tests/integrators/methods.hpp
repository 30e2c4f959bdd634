// SPDX-License-Identifier: MIT
#pragma once
// The family of integrators, for the laws that all of them obey: what each promises in its record.

#include <ostream>
#include <vector>

#include "scenes/methods/methods.hpp"

namespace jetlag::testing {

/// A promise of a method; random: it draws, so that laws about errors take the root mean square over seeds.
struct Promised : Promise {
  bool random = false;
};
inline void PrintTo(const Promised& method, std::ostream* out) { *out << method.name; }

inline std::vector<Promised> all_methods() {
  std::vector<Promised> all;
  for (const MethodRecord& record : method_records())
    for (const Promise& promise : record.promises) all.push_back({promise, record.draws});
  return all;
}

}  // namespace jetlag::testing
