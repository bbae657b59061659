// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the accelerated variants of the stock pair styles share. Stock is the class of LAMMPS: the
// commands, restart files and outputs are its own, the contacts are computed by GranularSystem.
// Where that is not possible the methods of Stock are used, see reason_for_stock().

#ifndef LMP_ACCELERATED_PAIR_H
#define LMP_ACCELERATED_PAIR_H

#include "pair/pair_of_system.h"

#include <optional>
#include <string>

namespace LAMMPS_NS {

template <class Stock> class AcceleratedPair : public PairOfSystem<Stock> {
 public:
  /// Decides at the first call, for good, whether the style is accelerated.
  void init_style() override;
  double init_one(int, int) override;
  void compute(int, int) override;
  double single(int, int, int, int, double, double, double, double &) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;

  std::string plain_style() const override { return plain; }
  std::string reason_for_stock() const override { return stock_reason.value_or("no run yet"); }

 protected:
  /// `plain_style`: name of the style without suffix, as scripts have it.
  AcceleratedPair(LAMMPS *lmp, const char *plain_style);
  /// In the destructor of the derived class, unless it is a copy.
  void leave_system();
  bool in_system() const { return stock_reason && stock_reason->empty(); }

  // ---- what the styles differ in

  /// "", or which of the models that the script asks for only the stock style has.
  virtual std::string reason_of_models() const = 0;
  /// In init_style(), before the pair style of the system is initialized: the laws of all pairs of
  /// types that are set.
  virtual void set_laws() = 0;
  /// In init_one() of an accelerated style: the cutoff (length), and the law if the pair is mixed.
  virtual double init_pair_of_types(int i, int j) = 0;
  /// Values of a contact in restart files of the stock style, as words of FixPairHistory; "" if it
  /// keeps none.
  virtual std::string stock_history() const = 0;
  /// Fills svector; without a contact with zeros.
  virtual void report_single(const std::optional<SinglePair> &pair) = 0;
  /// What others of LAMMPS expect of a style whose own methods are used.
  virtual void become_stock() {}

 private:
  void decide();
  std::string find_reason_for_stock() const;
  std::string reason_of_fixes() const;
  std::string reason_that_came_later() const;

  void keep_stock_history(const std::string &values);

  std::string plain, history_id, kept_values;
  bool attached;
  std::optional<std::string> stock_reason;    // from the first init_style() on
};

}    // namespace LAMMPS_NS

#endif
