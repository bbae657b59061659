// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of a large body, one for each type of particles.

#include "system/bodies/large_body.h"

#include "system/step/granular_system.h"

#include "body/shape/mesh_shape.h"
#include "laws/second_order_laws.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

using namespace LAMMPS_NS;

namespace Talus {

void LargeBody::set_laws()
{
  LawTable table;
  table.reset(atom->ntypes);
  for (int i = 1; i <= atom->ntypes; i++) {    // only the rows (t, t) are used
    ContactSides sides = sides_of(i);
    if (sides.law().cohesion().shares_liquid)
      error->all(
          FLERR,
          "Fix large/body {}: a body has no liquid to 'share': leave 'share' out of its law, "
          "bridges then have the given volume, of a wet surface",
          fix->id);
    if (system.integrators().order() == 2)
      sides.a.law = sides.b.law = second_order_law(sides.law());
    for (int j = i; j <= atom->ntypes; j++) table.set(i, j, sides.law(), sides.coefficients());
  }
  table.finish();
  contacts.set_laws(table);
  announce_laws();
}

void LargeBody::check_heat() const
{
  if (!temperature) return;
  temperature->check(lmp, std::string("Fix large/body ") + fix->id);
  if (!contacts.law_table().conducts_heat())
    error->all(FLERR,
               "Fix large/body {}: it has a temperature, and no law of its contacts conducts heat: "
               "add 'heat radius' or 'heat area' to the law, or remove 'temperature'",
               fix->id);
  if (!atom->temperature_flag || !atom->heatflow_flag)
    error->all(FLERR,
               "Fix large/body {}: heat is conducted to particles that have a temperature: add "
               "'fix ID all property/atom temperature heatflow ghost yes'",
               fix->id);
}

/* Types that follow each other and have one law share a line. */

void LargeBody::announce_laws()
{
  constexpr int most = 10;
  std::string text;
  int lines = 0;
  for (int first = 1, last; first <= atom->ntypes; first = last + 1) {
    const auto law_with = [this](int type) { return sides_of(type).describe(note_on(type)); };
    const std::string law = law_with(first);
    for (last = first; last < atom->ntypes && law_with(last + 1) == law;) last++;
    if (lines++ >= most) continue;
    const std::string types =
        first == last ? fmt::format("type {}", first) : fmt::format("types {}*{}", first, last);
    text += fmt::format("Talus {}: {}: {}\n", name(), types, law);
  }
  if (lines > most) text += fmt::format("Talus {}: ... {} more laws\n", name(), lines - most);
  if (comm->me == 0 && text != announced) utils::logmesg(lmp, text);
  announced = text;
}

std::string LargeBody::reason_against_second_order()
{
  for (int type = 1; type <= atom->ntypes; type++) {
    const std::string reason =
        Talus::reason_against_second_order(law_of(type), coefficients_of(type));
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

/* The laws of pairs, once that with particles of this type is known. */

const PairCoeffs &LargeBody::pairs_with(int type) const
{
  const PairCoeffs &pairs = system.laws();
  const auto [i, j] = std::minmax(type, type_of_laws);
  if (pairs.num_types() == 0 || !pairs.known(i, j))
    error->all(
        FLERR,
        "Fix large/body {}: the body has the laws of type {}, and there is none for types {} "
        "and {}: set 'pair_style gran/penalty' and 'pair_coeff {} {} ...'",
        fix->id, type_of_laws, i, j, i, j);
  return pairs;
}

/* Without a temperature a body conducts no heat. */

ContactLaw LargeBody::law_of(int type) const
{
  if (type_of_laws == 0) return specs[type].law;
  ContactLaw law = pairs_with(type).law(std::min(type, type_of_laws), std::max(type, type_of_laws));
  if (!temperature) law.choose(Stage::HEAT, &ContactLaw().heat());
  return law;
}

/* A body given by numbers is used as given; a body given by its material is mixed with the material
   of the particles. Friction and resistance of particles whose own law has none are those of the
   body. */

ContactSides LargeBody::sides_of(int type) const
{
  if (type_of_laws > 0) {
    ContactSides sides =
        pairs_with(type).sides(std::min(type, type_of_laws), std::max(type, type_of_laws));
    sides.a.law = sides.b.law = law_of(type);
    return sides;
  }
  const ContactSpec &body = specs[type];
  if (!body.is_material()) return {body, body, FrictionMix::MINIMUM};

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
  if (body.given.has("real E"))
    for (const char *name : {"real E", "real nu"})
      if (own->given.has(name)) particle.given[name] = own->given.value(name);
  if (body.law.normal().cohesive) particle.given.erase("limit_damping");
  for (const auto &[stage, name] : {std::pair(Stage::ROLLING, "mu_r"), {Stage::TWISTING, "mu_s"}})
    if (own->law[stage].reads(name)) particle.given[name] = own->given.value(name);
  return {body, particle, system.laws().mix};
}

/* Where its numbers are from, as for pairs. */

std::string LargeBody::note_on(int type) const
{
  if (type_of_laws == 0) return specs[type].is_material() ? "; mixed" : "";
  return pairs_with(type).note_on(std::min(type, type_of_laws), std::max(type, type_of_laws));
}

double LargeBody::contact_period(int type, double mass, double radius, double overlap)
{
  const double k = tangent_stiffness(law_of(type), coefficients_of(type), overlap, mass, radius);
  return k > 0.0 ? std::sqrt(mass / k) : 0.0;
}

}    // namespace Talus
