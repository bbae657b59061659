// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/shape/particle_shapes.h"

#include "shape/contact/shape_list.h"
#include "shape/convex/collide.h"
#include "system/host/shared_file.h"

#include "atom.h"
#include "utils.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

using namespace LAMMPS_NS;
using namespace Talus;

ShapeTable ParticleShapes::parse()
{
  ShapeTable table(collisions_of_shapes());
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
  const auto description = parse_shape();
  const int at_shape = words.index();
  const Given given = parse_keywords(*description);
  try {
    const auto shape = std::make_shared<ParticleShape>(description->make(), given.density);
    shape->set_fixed(given.orientation);
    if (given.seed) shape->set_random(static_cast<std::uint64_t>(given.seed));
    for (int type = lo; type <= hi; type++) table.set(type, shape);
  } catch (const std::runtime_error &problem) {
    words.fail(words.index() - at_shape + 1, problem.what());
  }
}

std::unique_ptr<ShapeDescription> ParticleShapes::parse_shape()
{
  const auto read_file = [this](const std::string &name) {
    return read_everywhere(lmp, words, name);
  };
  std::vector<std::string> known;
  for (const ShapeWord &one : shape_words()) known.push_back(one.name);
  return shape_words()[words.choice("shape", known)].read({words, read_file});
}

ParticleShapes::Given ParticleShapes::parse_keywords(ShapeDescription &description)
{
  Given given;
  std::vector<std::string> known = description.keywords();
  known.insert(known.end(), {"density", "orient"});
  while (!words.at_end() && !words.is_next("type") && !words.is_next("contacts")) {
    words.about("type");
    const std::string keyword = known[words.choice("keyword", known)];
    if (keyword == "density")
      given.density = words.positive("density rho");
    else if (keyword == "orient")
      parse_orientation(given);
    else
      description.read(keyword, words);
  }
  if (!(given.density > 0.0)) words.fail(1, "no density is given: add 'density rho'");
  return given;
}

void ParticleShapes::parse_orientation(Given &given)
{
  if (words.choice("orientation", {"random", "quat"}) == 0) {
    given.seed = words.integer("seed", 1);
    return;
  }
  double q[4];
  for (double &component : q) component = words.number("orient quat w x y z");
  given.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  if (!(given.orientation.norm() > 0.0)) words.fail(1, "a quaternion must not be zero");
  given.orientation.normalize();
  given.seed = 0;
}
