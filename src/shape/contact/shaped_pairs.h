// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts between particles of which at least one has a shape. Knows nothing of LAMMPS.
//
//   at a rebuild   save() or save_in_periodic_box() (if points are current), set_pairs(), restore()
//   every step     compute()
//
// The first body of a pair is the particle with the lower ID, on all ranks and for ever: so
// normals, names and histories never change sides. Pairs are computed in chunks, each with its
// points, by any number of threads; then each particle sums its pairs in ascending ID of the partner, a pair's
// points in the order of the narrow phase. So forces have the same bits on any number of ranks and
// threads. A pair across two ranks is computed by both.

#ifndef TALUS_SHAPE_CONTACT_SHAPED_PAIRS_H
#define TALUS_SHAPE_CONTACT_SHAPED_PAIRS_H

#include "shape/contact/contact_points.h"
#include "shape/contact/shape_table.h"
#include "shape/contact/shaped_view.h"
#include "shape/contact/solid.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace Talus {

class ShapedPairs : public ContactPoints {
 public:
  explicit ShapedPairs(const ShapeTable &shape_table) : shapes(shape_table) {}

  /// New pairs, local indices of owned particles and ghosts. `tag`: of all of these. Histories are
  /// zero until restore(). Pairs of a particle with its own image are left out.
  void set_pairs(const ShapedView &view, const std::vector<std::array<int, 2>> &pairs,
                 const std::vector<std::int64_t> &tag, const LawTable &laws);
  /// Each pair finds its points in the list of one of its particles that is owned. `name_of`: the IDs
  /// that particles had when histories were saved, 0 of new ones.
  void restore(const ContactLists &from, const std::function<std::int64_t(int)> &name_of);
  /// As save(). Where periodic borders are, the ranks on both sides know a contact from positions
  /// that differ by rounding: the rank of the first particle decides, and tells the others by
  /// messages[rank].
  using Messages = std::map<int, std::vector<double>>;
  void save_in_periodic_box(ContactLists &to, int this_rank,
                            const std::function<int(int ghost)> &owner_of,
                            Messages &messages) const;
  void receive(const std::vector<double> &message, ContactLists &to) const;

  struct Step {
    double dt;
    bool advance;    ///< false while a run is set up: histories are only read
    int threads;
    WorkAccount *account = nullptr;    ///< receives the work
    float weight_of_changes = 0.0F;    ///< see ContactStep
  };
  /// Adds forces and torques to those of owned particles.
  void compute(const ShapedView &view, const LawTable &laws, const Step &step);

  /// For snapshots: points of all pairs, which are the same when they are restored.
  void exchange_state(StateExchange &x)
  {
    ContactPoints::exchange_state(x);
    x(searches, results, solids, dt);
  }

  /// Of the last compute(): visit(i, j, force on i, i is owned, j is owned) for pairs that touch.
  template <class Visit> void for_each_force(Visit visit) const
  {
    for (std::size_t p = 0; p < list.size(); p++)
      if (results[p].points) visit(list[p].first, list[p].second, results[p].force);
  }
  /// visit(contact) for each contact point of the same. `laws`: of that step.
  using VisitContact = ComputedContacts::VisitContact;
  void for_each_contact(const LawTable &laws, const VisitContact &visit) const;

  /// The pair of rounded particles whose cores overlapped most since set_pairs(): by how much
  /// (length; 0: none), over the smaller of both radii, and local indices of both.
  struct CoreOverlap {
    double depth = 0.0, ratio = 0.0;
    int first = 0, second = 0;
  };
  CoreOverlap deepest_core_overlap() const;

  /// Of the last compute(), what two ranks have counts half: all pairs, those that touch, and contact
  /// points.
  struct Count {
    double pairs = 0.0, contacts = 0.0, points = 0.0;
  };
  Count count() const;
  double memory_usage() const;

 private:
  /// How the contacts of a pair are found.
  struct Search {
    int row;    ///< of the table of laws
    Collisions::Collision collision;
    SeparatingDirection direction{};
    double core_depth = 0.0, core_ratio = 0.0;    ///< largest since set_pairs()
  };
  struct Result {
    Vector3<double> force, torque_first, torque_second;    ///< on the first particle; about centers
    int points = 0;
  };
  /// Of one owned particle: which pair, and whether it is the second there.
  struct Side {
    int pair;
    bool second;
  };

  void set_sides(const ShapedView &view, const std::vector<std::int64_t> &tag);
  void place_solids(const ShapedView &view, int threads);
  void find_contacts(const LawTable &laws, bool advance, const Chunk &chunk, Scratch &with);
  void take_pair(const ShapedView &view, double weight_of_changes, Chunk &chunk, int p,
                 const ShapeContacts &found);
  void sum_points(const Chunk &chunk);
  void add_to_particles(const ShapedView &view, int threads) const;

  const ShapeTable &shapes;
  double dt = 0.0;                 ///< of the last compute()
  std::vector<Search> searches;    ///< by pair
  std::vector<Result> results;     ///< the same
  std::vector<int> particles;      ///< owned ones that have pairs
  std::vector<int> first_side;     ///< of each of these in `sides`, and one more
  std::vector<Side> sides;
  std::vector<int> used;        ///< all that have pairs, owned or ghosts
  std::vector<Solid> solids;    ///< by local index, of those that have pairs
};

}    // namespace Talus

#endif
