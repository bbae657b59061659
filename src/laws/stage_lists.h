// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The laws of each stage, in the order in which messages name them; the first one is what a contact
// has if nothing else was asked for. One source for each, in the folder of the stage: that of a law
// that is changed is compiled again, and no other. Only law_list.cpp asks.

#ifndef TALUS_LAWS_STAGE_LISTS_H
#define TALUS_LAWS_STAGE_LISTS_H

#include <vector>

namespace Talus {

struct Law;

std::vector<const Law *> normal_laws();
std::vector<const Law *> damping_laws();
std::vector<const Law *> tangential_laws();
std::vector<const Law *> rolling_laws();
std::vector<const Law *> twisting_laws();
std::vector<const Law *> cohesion_laws();
std::vector<const Law *> heat_laws();

}    // namespace Talus

#endif
