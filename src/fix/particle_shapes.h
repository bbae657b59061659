// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of fix shape/gran that describe shapes, see doc/fix_shape_gran.md.

#ifndef LMP_PARTICLE_SHAPES_H
#define LMP_PARTICLE_SHAPES_H

#include "base/words.h"
#include "shaped/shape_table.h"

#include "pointers.h"

#include <optional>
#include <vector>

namespace LAMMPS_NS {

class ParticleShapes : protected Pointers {
 public:
  ParticleShapes(LAMMPS *lmp, Talus::Words &words) : Pointers(lmp), words(words) {}

  /// Reads `type N ...` and `contacts ...` until the end. Collective; errors end in Words::fail().
  Talus::ShapeTable parse();

 private:
  void parse_type(Talus::ShapeTable &table);
  Talus::ConvexShape make_shape();

  Talus::Words &words;

  // of the type that is being read
  enum class Kind { BOX, POLYHEDRON, VERTICES };
  struct Given {
    Kind kind = Kind::BOX;
    Talus::Vector3<double> edges{};
    std::string file, content;
    std::vector<Talus::Vector3<double>> vertices;
    double scale = 1.0, radius = 0.0;
  } given;
  Talus::NarrowPhase parse_method();
  void parse_kind();
};

}    // namespace LAMMPS_NS

#endif
