// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/contact/shape_list.h"

#include "shape/convex/convex_words.h"
#include "shape/superellipsoid/superellipsoid_words.h"

#include <utility>

namespace Talus {
namespace {

/// Made at the first question: static objects of other files may ask, and add to it.
struct AllShapes {
  std::vector<ShapeWord> words = convex_words();
  Collisions collisions;

  AllShapes()
  {
    for (ShapeWord &word : superellipsoid_words()) words.push_back(std::move(word));
    add_convex_collisions(collisions);
    add_superellipsoid_collisions(collisions);
  }
};

AllShapes &list()
{
  static AllShapes all;
  return all;
}

}    // namespace

const std::vector<ShapeWord> &shape_words()
{
  return list().words;
}

const Collisions &collisions_of_shapes()
{
  return list().collisions;
}

AddedShape::AddedShape(const ShapeWord &word, void (*add_collisions)(Collisions &table))
{
  list().words.push_back(word);
  add_collisions(list().collisions);
}

}    // namespace Talus
