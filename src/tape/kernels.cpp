// SPDX-License-Identifier: MIT
// The choice of instruction set, made once, at run time.
#include "jetlag/tape/kernels.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace jetlag {

#if defined(__x86_64__)
namespace sse2 {
extern const KernelTable<double> table;
}
namespace avx2 {
extern const KernelTable<double> table;
}
namespace avx512 {
extern const KernelTable<double> table;
}
#endif

template <>
const KernelTable<double>& scalar_kernels<double>() {
  static const auto table = detail::make_kernels<detail::ScalarLane<double>, double, 1>("scalar", Rules{});
  return table;
}

std::vector<const KernelTable<double>*> available_kernels() {
  std::vector<const KernelTable<double>*> tables{&scalar_kernels<double>()};
#if defined(__x86_64__)
  tables.push_back(&sse2::table);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) tables.push_back(&avx2::table);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    tables.push_back(&avx512::table);
#endif
  return tables;
}

namespace {
const KernelTable<double>& chosen() {
  const auto tables = available_kernels();
  const char* wanted = std::getenv("JETLAG_INSTRUCTION_SET");
  if (!wanted) return *tables.back();
  std::string names;
  for (const auto* table : tables) {
    if (std::string_view(wanted) == table->instruction_set) return *table;
    names += std::string(names.empty() ? "" : ", ") + table->instruction_set;
  }
  throw std::invalid_argument("JETLAG_INSTRUCTION_SET: '" + std::string(wanted) + "' is not one of " + names +
                              " (what this machine runs)");
}
}  // namespace

template <>
const KernelTable<double>& kernels<double>() {
  static const KernelTable<double>& table = chosen();
  return table;
}

}  // namespace jetlag
