// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/particle_shapes.h"

#include "system/shared_file.h"

#include "atom.h"
#include "utils.h"

#include <cmath>
#include <memory>
#include <stdexcept>

using namespace LAMMPS_NS;
using namespace Talus;

ShapeTable ParticleShapes::parse()
{
  ShapeTable table;
  while (!words.at_end()) {
    words.about("");
    if (words.choice("keyword", {"type", "contacts"}) == 0)
      parse_type(table);
    else
      table.set_method(parse_method());
  }
  if (table.is_empty()) words.fail(1, "no shape is given: add 'type N box a b c density rho'");
  return table;
}

NarrowPhase ParticleShapes::parse_method()
{
  words.about("contacts");
  if (words.choice("way to find contacts", {"features", "mpr"}) == 0) return NarrowPhase::FEATURES;
  if (!has_mpr())
    words.fail(1,
               "this Talus was built without libccd, which mpr needs: use 'contacts features', or "
               "install libccd (Debian: libccd-dev) and build Talus again");
  return NarrowPhase::MPR;
}

void ParticleShapes::parse_type(ShapeTable &table)
{
  int lo = 1, hi = atom->ntypes;
  words.about("type");
  utils::bounds(FLERR, words.text("types, e.g. 1 or 1*3"), 1, atom->ntypes, lo, hi, lmp->error);
  for (int type = lo; type <= hi; type++)
    if (table.of(type)) words.fail(1, "type " + std::to_string(type) + " has a shape already");
  given = Given{};
  parse_kind();
  const int at_shape = words.index();

  double density = 0.0;
  bool random = false;
  int seed = 0;
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  while (!words.at_end() && !words.is_next("type") && !words.is_next("contacts")) {
    words.about("type");
    const int which = words.choice("keyword", {"rounded", "scale", "density", "orient"});
    if (which == 0) {
      given.radius = words.not_negative("rounded r");
    } else if (which == 1) {
      if (given.kind == Kind::BOX) words.fail(1, "scale is for polyhedron and vertices");
      given.scale = words.positive("scale s");
    } else if (which == 2) {
      density = words.positive("density rho");
    } else if (words.choice("orientation", {"random", "quat"}) == 0) {
      random = true;
      seed = words.integer("seed", 1);
    } else {
      double q[4];
      for (double &component : q) component = words.number("orient quat w x y z");
      orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
      if (!(orientation.norm() > 0.0)) words.fail(1, "a quaternion must not be zero");
      orientation.normalize();
      random = false;
    }
  }
  if (!(density > 0.0)) words.fail(1, "no density is given: add 'density rho'");
  try {
    auto shape = std::make_shared<ParticleShape>(make_shape(), density);
    shape->set_fixed(orientation);
    if (random) shape->set_random(static_cast<std::uint64_t>(seed));
    for (int type = lo; type <= hi; type++) table.set(type, shape);
  } catch (const std::runtime_error &problem) {
    const std::string where = given.file.empty() ? "" : "'" + given.file + "': ";
    words.fail(words.index() - at_shape + 1, where + problem.what());
  }
}

void ParticleShapes::parse_kind()
{
  given.kind = static_cast<Kind>(words.choice("shape", {"box", "polyhedron", "vertices"}));
  if (given.kind == Kind::BOX) {
    given.edges = {words.positive("box a"), words.positive("box b"), words.positive("box c")};
  } else if (given.kind == Kind::POLYHEDRON) {
    given.file = words.text("an STL file");
    given.content = read_everywhere(lmp, words, given.file);
  } else {
    const int count = words.integer("number of vertices", 4);
    for (int n = 0; n < count; n++) given.vertices.push_back(words.vector("vertex x y z"));
  }
}

ConvexShape ParticleShapes::make_shape()
{
  switch (given.kind) {
  case Kind::BOX:
    return ConvexShape::box(given.edges, given.radius);
  case Kind::POLYHEDRON:
    return ConvexShape::stl(given.content, given.scale, given.radius);
  default:
    for (Vector3<double> &v : given.vertices) v = given.scale * v;
    return ConvexShape::polyhedron(given.vertices, given.radius);
  }
}
