// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of a large body, one for each type of particles.

#include "system/large_body.h"

#include "system/granular_system.h"

#include "body/shape/mesh_shape.h"
#include "laws/second_order_laws.h"

#include "atom.h"
#include "error.h"
#include "fix.h"

#include <cmath>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

void LargeBody::set_law(int type, const ContactSpec &spec)
{
  specs[type] = spec;
  spec_is_set[type] = true;
}

void LargeBody::set_laws()
{
  LawTable table;
  table.reset(atom->ntypes);
  const std::vector<ContactSpec> as_given = specs;
  if (system.integrators().order() == 2)
    for (ContactSpec &one : specs) one.law = second_order_law(one.law);
  for (int i = 1; i <= atom->ntypes; i++)    // only the rows (t, t) are used
    for (int j = i; j <= atom->ntypes; j++) table.set(i, j, specs[i].law, coefficients_of(i));
  specs = as_given;
  table.finish();
  contacts.set_laws(table);
}

std::string LargeBody::reason_against_second_order()
{
  for (int type = 1; type <= atom->ntypes; type++) {
    const std::string reason =
        Talus::reason_against_second_order(specs[type].law, coefficients_of(type));
    if (!reason.empty()) return reason;
  }
  if (!with_history)
    return "was defined before the integrator and keeps no history without friction: define it "
           "after";
  return "";
}

std::string LargeBody::note_on_second_order() const
{
  const MeshShape *mesh = body_shape->as_mesh();
  if (!mesh || !mesh->has_jumps()) return "";
  return "where particles go from facet to facet of a hollow that stands for a curved surface the "
         "force turns at once, and the error is of first order: less with more facets";
}

/* A body given by numbers is used as given; a body given by its material is mixed with the material
   of the particles. Friction and resistance of particles whose own law has none are those of the
   body. */

ContactCoefficients LargeBody::coefficients_of(int type)
{
  const ContactSpec &body = specs[type];
  if (!body.is_material()) return contact_coefficients(body, body, FrictionMix::MINIMUM);

  const ContactSpec *own = system.laws().own(type);
  if (!own || !own->is_material())
    error->all(
        FLERR,
        "Fix large/body {}: the material law {} needs the material of particles of type {}: set "
        "'pair_style gran/penalty' and 'pair_coeff {} {}' with a material law",
        fix->id, body.law.normal().name, type, type, type);
  ContactSpec particle = body;
  for (const char *name : {"E", "nu", "e", "eta", "gamma", "mu", "limit_damping"})
    if (own->given.has(name)) particle.given[name] = own->given.value(name);
  if (body.law.normal().cohesive) particle.given.erase("limit_damping");
  for (const auto &[stage, name] : {std::pair(Stage::ROLLING, "mu_r"), {Stage::TWISTING, "mu_s"}})
    if (own->law[stage].reads(name)) particle.given[name] = own->given.value(name);
  return contact_coefficients(body, particle, system.laws().mix);
}

double LargeBody::contact_period(int type, double mass, double radius, double overlap)
{
  const double k = tangent_stiffness(specs[type].law, coefficients_of(type), overlap, mass, radius);
  return k > 0.0 ? std::sqrt(mass / k) : 0.0;
}

}    // namespace Talus
