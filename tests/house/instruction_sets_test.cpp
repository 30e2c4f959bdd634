// SPDX-License-Identifier: MIT
// Code compiled for one instruction set cannot be linked in place of plain code.
//
// The linker keeps one copy of an inline function or template instantiation, from whichever object file comes
// first. Were that copy one with AVX-512 instructions, the library would crash on older machines, far from the
// kernels. So every symbol that the object file of an instruction set offers to the linker names that set.
#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// What a command prints.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  std::string text;
  std::array<char, 4096> buffer;
  while (pipe && std::fgets(buffer.data(), buffer.size(), pipe.get())) text += buffer.data();
  return text;
}

using Symbols = std::map<std::string, std::vector<std::string>>;

/// The symbols of each member of an archive, from what  nm --defined-only --extern-only  prints:
///
///   kernels_avx2.cpp.o:
///   0000000000000000 W _ZN6jetlag3runINS_4avx24LaneEEEvi
Symbols read_symbols(const std::string& listing) {
  Symbols symbols;
  std::string member;
  std::istringstream lines(listing);
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(".o:"))
      member = line.substr(0, line.size() - 1);
    else if (const auto type = line.find(' '); type != std::string::npos && line.size() > type + 3)
      symbols[member].push_back(line.substr(type + 3));
  }
  return symbols;
}

/// Data that the compiler adds on its own: marks of AddressSanitizer, the pointer to the exception handler.
bool added_by_compiler(const std::string& symbol) {
  return symbol.starts_with("__odr_asan") || symbol == "DW.ref.__gxx_personality_v0";
}

/// Symbols that do not name the namespace of the instruction set. They are read as the linker sees them, where
/// avx2:: is 4avx2: the nm of Debian 12 cannot demangle the templates of clang 19.
std::vector<std::string> unmarked(const std::vector<std::string>& symbols,
                                  const std::string& instruction_set) {
  const std::string name = std::to_string(instruction_set.size()) + instruction_set;
  std::vector<std::string> found;
  for (const std::string& symbol : symbols)
    if (symbol.find(name) == std::string::npos && !added_by_compiler(symbol)) found.push_back(symbol);
  return found;
}

using testing::ElementsAre;
using testing::IsEmpty;

#if defined(__x86_64__)
TEST(InstructionSets, NameAllThatTheyOfferToTheLinker) {
  const auto symbols =
      read_symbols(output_of(JETLAG_NM " --defined-only --extern-only '" JETLAG_LIBRARY "'"));
  for (const std::string set : {"avx2", "avx512"})
    for (const std::string file : {"kernels_", "ensemble_lanes_"}) {
      const auto member = symbols.find(file + set + ".cpp.o");
      ASSERT_NE(member, symbols.end()) << file << set;
      EXPECT_THAT(unmarked(member->second, set), IsEmpty()) << file << set;
    }
}
#endif

TEST(InstructionSets, AreToldApartInAListing) {
  const auto symbols = read_symbols(
      "\nkernels_avx2.cpp.o:\n"
      "0000000000000000 W _ZN6jetlag3runINS_4avx24LaneEEEvi\n"
      "0000000000000010 V _ZN6jetlag6sharedE\n"
      "0000000000000020 B __odr_asan._ZN6jetlag5tableE\n"
      "\nkernels_avx512.cpp.o:\n"
      "0000000000000000 R _ZN6jetlag6avx5125tableE\n");
  EXPECT_THAT(unmarked(symbols.at("kernels_avx2.cpp.o"), "avx2"), ElementsAre("_ZN6jetlag6sharedE"));
  EXPECT_THAT(unmarked(symbols.at("kernels_avx512.cpp.o"), "avx512"), IsEmpty());
}

}  // namespace
