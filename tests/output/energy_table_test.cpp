// SPDX-License-Identifier: MIT
#include "jetlag/output/energy_table.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "output/scratch.hpp"

namespace jetlag::testing {
namespace {

using EnergyTable = Scratch;

TEST_F(EnergyTable, ReadsBack) {
  const std::vector<EnergyRow> rows = {{0.0, {0.1, 0.2}, 0.0}, {1.0 / 3.0, {1e-300, -2.5e17}, -1.0 / 7.0}};
  write_energy_csv(folder / "energy.csv", rows);
  std::ifstream table(folder / "energy.csv");
  std::string header;
  std::getline(table, header);
  EXPECT_EQ(header, "time,kinetic,potential,total,relative_error");
  for (const auto& [time, energy, error] : rows)
    for (const double expected : {time, energy.kinetic, energy.potential, energy.total(), error}) {
      double value = -1;
      table >> value;
      EXPECT_EQ(value, expected);
      table.get();
    }
  EXPECT_EQ(table.peek(), std::char_traits<char>::eof());
}

TEST_F(EnergyTable, HasAnEmptyFieldForANumberThatIsNotFinite) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  write_energy_csv(folder / "energy.csv", {{1.0, {2.0, 3.0}, nan}});
  EXPECT_EQ(content(folder / "energy.csv"), "time,kinetic,potential,total,relative_error\n1,2,3,5,\n");
}

}  // namespace
}  // namespace jetlag::testing
