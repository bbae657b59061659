// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What contact points of shapes keep: no law is taken that has more. Talus has none, but others may add theirs.

#include "laws/law_list.h"
#include "shape/contact/point_batch.h"
#include "shape/contact/point_contact.h"

#include <gtest/gtest.h>

using namespace Talus;

TEST(PointHistory, holdsThatOfEachLawOfTalus)
{
  int taken = 0;
  for (const Law *normal : laws_of(Stage::NORMAL))
    for (const Law *tangential : laws_of(Stage::TANGENTIAL)) {
      ContactLaw law;
      law.choose(Stage::NORMAL, normal);
      law.choose(Stage::TANGENTIAL, tangential);
      if (!PointBatch::refusal(law).empty()) continue;
      EXPECT_LE(law.history().size, point_history_size);
      taken++;
    }
  EXPECT_GT(taken, 10);
}

TEST(PointHistory, ofALawThatHasMoreIsRefused)
{
  for (int even = 0; even < 12; even++) {
    Law added = *find_law(Stage::TANGENTIAL, "multistep");
    added.even_history = even;
    ContactLaw law;
    law.choose(Stage::TANGENTIAL, &added);
    const int size = law.history().size;
    EXPECT_EQ(
        PointBatch::refusal(law),
        size <= point_history_size
            ? ""
            : "has laws with " + std::to_string(size) +
                  " values of history, and points of shapes keep 8: take another tangential law");
    if (even == 11) {
      EXPECT_GT(size, point_history_size);
    }
  }
}
