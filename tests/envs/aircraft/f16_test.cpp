// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/f16.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace skein {
namespace {

bool StrictlyIncreasing(const std::vector<double>& axis) {
  return std::adjacent_find(axis.begin(), axis.end(), [](double a, double b) { return a >= b; }) ==
         axis.end();
}

TEST(F16, TablesHaveTheShapesOfTheirAxes) {
  const AerodynamicTables t = F16().aerodynamics;
  ASSERT_EQ(t.alpha_deg.size(), 20u);
  ASSERT_EQ(t.alpha_lef_deg.size(), 14u);
  ASSERT_EQ(t.beta_deg.size(), 19u);
  ASSERT_EQ(t.elevator_deg.size(), 5u);
  ASSERT_EQ(t.elevator_coarse_deg.size(), 3u);
  for (const auto* axis :
       {&t.alpha_deg, &t.alpha_lef_deg, &t.beta_deg, &t.elevator_deg, &t.elevator_coarse_deg}) {
    EXPECT_TRUE(StrictlyIncreasing(*axis));
  }
  for (const auto* table : {&t.Cx, &t.Cz, &t.Cm}) EXPECT_EQ(table->size(), 20u * 19 * 5);
  for (const auto* table : {&t.Cn, &t.Cl}) EXPECT_EQ(table->size(), 20u * 19 * 3);
  for (const auto* table :
       {&t.Cy, &t.Cy_r30, &t.Cn_r30, &t.Cl_r30, &t.Cy_a20, &t.Cn_a20, &t.Cl_a20}) {
    EXPECT_EQ(table->size(), 20u * 19);
  }
  for (const auto* table : {&t.Cx_lef, &t.Cz_lef, &t.Cm_lef, &t.Cy_lef, &t.Cn_lef, &t.Cl_lef,
                            &t.Cy_a20_lef, &t.Cn_a20_lef, &t.Cl_a20_lef}) {
    EXPECT_EQ(table->size(), 14u * 19);
  }
  for (const auto* table : {&t.Cxq, &t.Czq, &t.Cmq, &t.Cyp, &t.Cyr, &t.Cnr, &t.Cnp, &t.Clp, &t.Clr,
                            &t.dCn_beta, &t.dCl_beta, &t.dCm}) {
    EXPECT_EQ(table->size(), 20u);
  }
  for (const auto* table : {&t.dCxq_lef, &t.dCzq_lef, &t.dCmq_lef, &t.dCyp_lef, &t.dCyr_lef,
                            &t.dCnr_lef, &t.dCnp_lef, &t.dClp_lef, &t.dClr_lef}) {
    EXPECT_EQ(table->size(), 14u);
  }
  EXPECT_EQ(t.eta_el.size(), 5u);
}

TEST(F16, EngineTablesRiseWithPower) {
  const EngineTables t = F16().engine;
  ASSERT_EQ(t.idle_lbf.size(), t.altitude_ft.size() * t.mach.size());
  EXPECT_TRUE(StrictlyIncreasing(t.altitude_ft));
  EXPECT_TRUE(StrictlyIncreasing(t.mach));
  // The published idle thrust exceeds military thrust at 50,000 ft below Mach 0.4.
  const std::size_t last_row = t.idle_lbf.size() - t.mach.size();
  for (std::size_t i = 0; i < t.idle_lbf.size(); ++i) {
    if (i < last_row || t.mach[i - last_row] >= 0.4) {
      EXPECT_LT(t.idle_lbf[i], t.military_lbf[i]) << i;
    }
    EXPECT_LT(t.military_lbf[i], t.maximum_lbf[i]) << i;
  }
}

}  // namespace
}  // namespace skein
