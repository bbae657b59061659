// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What contact points of shapes keep: no law is taken that has more (Talus has none, but others may add theirs); and from
// where the search of the next step begins.

#include "laws/law_list.h"
#include "shape/contact/point_batch.h"
#include "shape/contact/point_contact.h"

#include <gtest/gtest.h>

#include <vector>

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

TEST(PointHistory, keepsWhereASearchBegan)
{
  PointContact point{};
  point.name = 5;
  ContactLists lists;
  lists.grow(2);
  EXPECT_FALSE(keep_history(point, 1, 7, lists));    // nothing to keep
  point.begins_search = true;
  point.start = {0.6, 0.0, 0.8};
  point.normal = {0.0, 0.8, 0.6};
  EXPECT_TRUE(keep_history(point, 1, 7, lists));
  point.begins_search = false;
  point.history[2] = 3.0;
  EXPECT_TRUE(keep_history(point, 1, 9, lists));

  std::vector<PointContact> found;
  lists.for_each(1, [&](const ContactLists::Contact &one) { found.push_back(stored_point(one)); });
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, 5U);
  EXPECT_TRUE(found[0].begins_search);
  EXPECT_EQ(found[0].start.x, 0.6);
  EXPECT_EQ(found[0].start.z, 0.8);
  EXPECT_EQ(found[0].normal.y, 0.8);
  EXPECT_EQ(found[0].normal.z, 0.6);
  EXPECT_FALSE(found[1].begins_search);
  EXPECT_EQ(found[1].history[2], 3.0);
}
