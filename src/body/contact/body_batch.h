// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of particles with a large body on their way through the kernel: one batch for each
// thread. Everything is computed in the frame of the body, where the body is at rest and the
// histories turn with it; forces are turned back.

#ifndef TALUS_BODY_CONTACT_BODY_BATCH_H
#define TALUS_BODY_CONTACT_BODY_BATCH_H

#include "base/aligned_vector.h"
#include "body/contact/body_load.h"
#include "body/contact/body_particle_view.h"
#include "body/contact/contact_memory.h"
#include "body/contact/sparse_history.h"
#include "body/motion/body_state.h"
#include "body/shape/large_body_shape.h"
#include "laws/contact_batch.h"
#include "laws/contact_energy.h"
#include "material/law_table.h"
#include "particles/record.h"

namespace Talus {

/// What a part of the body felt in one step.
struct TouchedPart {
  int part;
  double normal_force;      ///< > 0: pressed
  Vector3<double> shear;    ///< tangential force on the body, its frame
  double shear_power;       ///< that force times the velocity of the surfaces past each other
};

/// One evaluation of all contacts of a body.
struct BodyTask {
  const LawTable &laws;
  const BodyFrame &frame;
  const BodyParticleView &view;
  double dt;
  bool advance;    ///< false: histories are only read
  bool exact;      ///< sum the load without rounding as well
  bool record_parts;
  EnergyAccount *energies;    ///< nullptr, or receives them: from one thread only
  bool with_history, with_impact, with_resistance;    ///< of any law

  /// Row of the table for a particle; types are not read where all have the same law.
  int row_of(int atom) const
  {
    return laws.uniform() ? 0 : laws.row(view.type[atom], view.type[atom]);
  }
};

class BodyBatch {
 public:
  BodyBatch();

  void start(bool exact);

  /// Adds a contact of a particle, with the history and impact that it continues. `slot`: where the
  /// new ones go: the candidate in `sparse`, or the index in `remembered`. The batch is computed
  /// when it is full.
  void add(const BodyTask &task, int law, int atom, const SurfaceContact &contact,
           const Record &history, const Record &impact, int slot);
  /// Computes what is left of this law. Call before contacts of another one are added.
  void flush(const BodyTask &task, int law);

  /// Where histories go: records by candidate, or lists of this batch.
  SparseHistory *sparse = nullptr;
  AlignedVector<RememberedContact> remembered;

  BodyLoad load;
  ExactLoad exact;
  AlignedVector<TouchedPart> touched;
  double largest_overlap = 0.0;    ///< over radius; only with energies

 private:
  void keep_history(int lane, bool with_impact);
  void apply(const BodyTask &task, int lane, const ContactLaw &law);
  void add_virial(const BodyParticleView &view, int atom, const Vector3<double> &branch,
                  const Vector3<double> &force);
  void record(const BodyTask &task, int lane);

  ContactBatch batch;
  int filled = 0;
  int atom_of_lane[ContactBatch::width], slot_of_lane[ContactBatch::width],
      part_of_lane[ContactBatch::width];
};

}    // namespace Talus

#endif
