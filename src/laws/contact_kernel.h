// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The computation of a batch of contacts: the stages of their law, one after the other, each over
// all contacts; a batch and what stages leave for each other fit into the first cache. For the few
// most common laws there is one function with all stages in it (see
// fused_kernels.h), with the same bits.

#ifndef TALUS_LAWS_CONTACT_KERNEL_H
#define TALUS_LAWS_CONTACT_KERNEL_H

#include "laws/approach.h"
#include "laws/contact_batch.h"
#include "laws/contact_law.h"
#include "laws/tangential/sliding.h"

#include <array>

namespace Talus {

enum class ReadBehindTouch;

class ContactKernel {
 public:
  /// Computes the contacts begin ... end-1 of a batch; both are multiples of `lanes`.
  ///   table  coefficients, laid out for the law; a uniform kernel uses table[0] for every contact,
  ///          the others table[batch.coefficients[k]]
  ///   dt     time step (time units of the caller)
  void operator()(ContactBatch &batch, int begin, int end, const ContactCoefficients *table,
                  double dt) const
  {
    for (int n = 0; n < count; n++) {
      const Step &step = steps[n];
      step.run(batch, begin, end, {table, uniform, step.first_coefficient, step.history_index, dt});
    }
  }

  bool operator==(const ContactKernel &other) const;

 private:
  friend ContactKernel contact_kernel(const ContactLaw &, bool, bool);
  friend ContactKernel staged_kernel(const ContactLaw &, bool, bool);
  friend ContactKernel accounting_kernel(const ContactLaw &, bool, bool);
  void add(StageFunction run, int first_coefficient = 0, const HistoryIndices &history_index = {})
  {
    steps[count++] = {run, first_coefficient, history_index};
  }

  void add(const ContactKernel &other)
  {
    for (int n = 0; n < other.count; n++) steps[count++] = other.steps[n];
  }

  /// What comes first of laws of second order.
  void add_end_of_contact(const ContactLaw &law);
  /// What comes before a stage that acts where bodies are apart, see end_of_touch.h.
  template <ReadBehindTouch read> void add_end_of_touch(const ContactLaw &law, bool advance);

  struct Step {
    StageFunction run;
    int first_coefficient;
    HistoryIndices history_index;
  };
  std::array<Step, num_stages + 9> steps{};    // and what is before and behind the stages
  int count = 0;
  bool uniform = false;
};

/// The kernel of a law.
///   uniform  every contact has the coefficients table[0]
///   advance  true in a step of a run: the history advances; false while setting up: it is only
///   read
ContactKernel contact_kernel(const ContactLaw &law, bool uniform, bool advance);

/// The same, stage by stage in any case.
ContactKernel staged_kernel(const ContactLaw &law, bool uniform, bool advance);

/// The kernel that finds ContactBatch::work as well: forces and histories have the same bits.
ContactKernel accounting_kernel(const ContactLaw &law, bool uniform, bool advance);

/// One contact alone, history only read, up to a stage: for queries. Same bits as the kernels.
ContactLanes<double> single_contact(const ContactLaw &law, const ContactCoefficients &coefficients,
                                    const ContactState<double> &state, double dt,
                                    const HistoryValues &history = {}, Stage last = Stage::HEAT);

}    // namespace Talus

#endif
