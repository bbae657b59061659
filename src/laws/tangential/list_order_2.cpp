// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of friction for integrators of second order, each as the law that it stands for declares
// it. A file of its own: they take long to compile.

#include "laws/law_definition.h"
#include "laws/tangential/dashpot.h"
#include "laws/tangential/granular.h"
#include "laws/tangential/multistep.h"
#include "laws/tangential/none.h"
#include "laws/tangential/second_order.h"
#include "laws/tangential/tanh.h"

namespace Talus {
namespace {

template <Friction kind, class Granular = void> const Law *choose(bool adhesive)
{
  return adhesive ? &law<SecondOrder<kind, Granular, Adhesion::YES>>
                  : &law<SecondOrder<kind, Granular, Adhesion::NO>>;
}

}    // namespace

const Law *TangentialNone::order_2(bool adhesive)
{
  return choose<Friction::NONE>(adhesive);
}

const Law *Dashpot::order_2(bool adhesive)
{
  return choose<Friction::DASHPOT>(adhesive);
}

const Law *Tanh::order_2(bool adhesive)
{
  return adhesive ? nullptr : &law<SecondOrder<Friction::TANH>>;
}

const Law *multistep_order_2(bool adhesive)
{
  return choose<Friction::SPRING>(adhesive);
}

const Law *LinearNoHistory::order_2(bool adhesive)
{
  return choose<Friction::DASHPOT, LinearNoHistory>(adhesive);
}

const Law *LinearHistory::order_2(bool adhesive)
{
  return choose<Friction::SPRING, LinearHistory>(adhesive);
}

const Law *Mindlin::order_2(bool adhesive)
{
  return choose<Friction::SPRING, Mindlin>(adhesive);
}

const Law *MindlinForce::order_2(bool adhesive)
{
  return choose<Friction::SPRING, MindlinForce>(adhesive);
}

const Law *MindlinRescale::order_2(bool adhesive)
{
  return choose<Friction::SPRING, MindlinRescale>(adhesive);
}

const Law *MindlinRescaleForce::order_2(bool adhesive)
{
  return choose<Friction::SPRING, MindlinRescaleForce>(adhesive);
}

}    // namespace Talus
