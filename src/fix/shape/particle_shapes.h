// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The words of fix shape/gran that describe shapes, see doc/fix_shape_gran.md.

#ifndef LMP_PARTICLE_SHAPES_H
#define LMP_PARTICLE_SHAPES_H

#include "base/words.h"
#include "shape/contact/shape_table.h"
#include "shape/shape_description.h"

#include "pointers.h"

#include <memory>

namespace LAMMPS_NS {

class ParticleShapes : protected Pointers {
 public:
  ParticleShapes(LAMMPS *lmp, Talus::Words &words) : Pointers(lmp), words(words) {}

  /// Reads `type N ...` and `contacts ...` until the end. Collective; errors end in Words::fail().
  Talus::ShapeTable parse();

 private:
  /// Keywords of all shapes, of the type that is being read.
  struct Given {
    double density = 0.0;
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
    int seed = 0;    ///< of random orientations; 0: the one above
  };

  void parse_type(Talus::ShapeTable &table);
  std::unique_ptr<Talus::ShapeDescription> parse_shape();
  Given parse_keywords(Talus::ShapeDescription &description);
  void parse_orientation(Given &given);
  Talus::NarrowPhase parse_method();

  Talus::Words &words;
};

}    // namespace LAMMPS_NS

#endif
