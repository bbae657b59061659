// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The word SHAPE of fix large/body and its arguments.

#ifndef TALUS_FIX_BODY_LARGE_BODY_SHAPES_H
#define TALUS_FIX_BODY_LARGE_BODY_SHAPES_H

#include "base/words.h"
#include "body/shape/mesh_shape.h"
#include "body/shape/stl_file.h"
#include "pointers.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

class LargeBodyShapes : protected Pointers {
 public:
  LargeBodyShapes(LAMMPS *lmp, Talus::Words &words) : Pointers(lmp), words(words) {}

  /// Reads the shape and its arguments. Call on all ranks.
  std::unique_ptr<Talus::LargeBodyShape> parse(bool two_sided);

 private:
  using Shape = std::unique_ptr<Talus::LargeBodyShape>;
  Shape plane(bool two_sided);
  Shape rectangle(bool two_sided);
  Shape box();
  Shape ball();
  Shape cylinder();
  Shape cone();
  Shape mesh(bool two_sided);
  Shape region();
  Shape custom();
  bool parse_inside();
  Talus::PeriodicEdges periodic_edges() const;
  double continued(double length, const Talus::Vector3<double> &center,
                   const Talus::Vector3<double> &direction) const;
  enum class Side { INSIDE, OUTSIDE, OPEN };
  Side parse_side();
  Talus::StlContent stl(const std::string &file);
  bool take_side(std::string &side);
  static std::string what_is_open(const Talus::MeshReport &report);
  void tell(const Talus::MeshShape &shape, const std::string &side);

  Talus::Words &words;
};

}    // namespace LAMMPS_NS

#endif
