// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "fix/body/large_body_words.h"

#include "fix/body/body_motion_words.h"
#include "fix/body/large_body_shapes.h"

#include "laws/contact_words.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "utils.h"

#include <algorithm>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

LargeBodySpec LargeBodyWords::parse()
{
  has_law.assign(atom->ntypes + 1, false);
  spec.laws.resize(atom->ntypes + 1);
  spec.shape = LargeBodyShapes(lmp, words).parse(find_two_sided());
  BodyMotionWords motion(lmp, words);
  while (!words.at_end()) {
    words.about("");
    if (words.take("contact")) {
      parse_contact();
    } else if (words.take("type")) {
      parse_type();
    } else if (words.take("temperature")) {
      words.about("temperature");
      spec.temperature = NumberOrVariable::from(words, "temperature T");
    } else if (words.take("two-sided") || motion.parse(spec.motion) || parse_surface()) {
      continue;
    } else {
      words.fail(
          0, "unknown word '" + words.peek() +
                 "', expected contact, type, two-sided, move, servo, surface_velocity, gravity, "
                 "load, temperature, pressure, wear, vtk, or in a contact " +
                 contact_keywords);
    }
  }
  if (spec.motion.surface_velocity && !spec.shape->is_flat())
    error->all(FLERR, "fix large/body: surface_velocity is for plane, rectangle and mesh: give a "
                      "cylinder or cone that turns 'move rotate'");
  need_all_laws();
  check_heat();
  motion.check(spec.motion, *spec.shape);
  return std::move(spec);
}

/* A property of the shape, so it is looked for before the shape is made. */

bool LargeBodyWords::find_two_sided() const
{
  Words ahead = words;
  while (!ahead.at_end()) {
    if (ahead.take("two-sided")) return true;
    ahead.skip(1);
  }
  return false;
}

/* ---- laws ---------------------------------------------------------------------------------- */

void LargeBodyWords::parse_contact()
{
  if (spec.type_of_laws) refuse_two_laws(1);
  int lo = 1, hi = atom->ntypes;
  words.about("contact");
  if (words.take("types"))
    utils::bounds(FLERR, words.text("types, e.g. 1 or 1*3"), 1, atom->ntypes, lo, hi, error);
  const int at_normal = words.index();
  const ContactSpec parsed = Talus::parse_contact(words, 1.0 / force->nktv2p);
  if (takes_moduli_of_types(parsed))
    words.fail(words.index() - at_normal,
               "E and nu = NULL are those of two types of particles, in pair_coeff: write numbers, "
               "or give the body a 'type'");
  for (int type = lo; type <= hi; type++) {
    spec.laws[type] = parsed;
    has_law[type] = true;
  }
}

/* The law with particles of another type is that of pair_coeff. */

void LargeBodyWords::parse_type()
{
  words.about("type");
  const int type = words.integer("atom type", 1);
  if (type > atom->ntypes)
    words.fail(1, fmt::format("there are {} atom types: make one for the body in create_box",
                              atom->ntypes));
  if (spec.type_of_laws || std::find(has_law.begin(), has_law.end(), true) != has_law.end())
    refuse_two_laws(2);
  spec.type_of_laws = type;
}

void LargeBodyWords::refuse_two_laws(int back) const
{
  words.fail(back, "the laws of a body are those of 'type', once, or of 'contact': remove one");
}

void LargeBodyWords::need_all_laws() const
{
  for (int type = 1; type <= atom->ntypes; type++)
    if (!spec.type_of_laws && !has_law[type])
      error->all(FLERR,
                 "fix large/body: no contact law for particles of type {}: add 'contact "
                 "NORMAL args ...' or 'contact types {} NORMAL args ...', or 'type N'",
                 type, type);
}

void LargeBodyWords::check_heat()
{
  const bool conducts = std::any_of(spec.laws.begin(), spec.laws.end(),
                                    [](const ContactSpec &one) { return one.law.conducts_heat(); });
  if (conducts && !spec.temperature)
    error->all(FLERR, "fix large/body: a law with 'heat', and the body has no temperature: add "
                      "'temperature T', or remove 'heat'");
  spec.surface.with_heat = spec.temperature.has_value();
}

/* ---- surface ------------------------------------------------------------------------------- */

bool LargeBodyWords::parse_surface()
{
  if (words.take("pressure")) {
    words.about("pressure");
    const int choice = words.choice("value", {"yes", "no", "average"});
    need_mesh();
    spec.surface.averages = choice == 2;
    if (choice != 1) spec.surface.with_loads = true;
    return true;
  }
  if (words.take("wear")) {
    words.about("wear");
    spec.surface.wear = words.positive("coefficient k");
    need_mesh();
    spec.surface.with_loads = true;
    return true;
  }
  if (!words.take("vtk")) return false;
  parse_picture();
  return true;
}

void LargeBodyWords::need_mesh() const
{
  if (!spec.shape->as_mesh())
    words.fail(2, "only the triangles of a mesh are looked at one by one");
}

void LargeBodyWords::parse_picture()
{
  words.about("vtk");
  spec.surface.interval = words.integer("interval N", 1);
  const std::string file = words.text("file");
  if (file.find('*') == std::string::npos)
    words.fail(1, "the name of the file needs a * for the time step");
  if (file.size() < 4 || file.compare(file.size() - 4, 4, ".vtp") != 0)
    words.fail(1, "the name of the file must end in .vtp");
  spec.surface.file = file;
}

}    // namespace Talus
