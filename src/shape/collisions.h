// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The table that tells which function finds the contacts of a shape with another shape, a sphere or a
// surface of a large body: one entry for two classes, in either order.
//
//   bool capsule_and_sphere(const Placed<Capsule> &, const Placed<Sphere> &, const CollisionRequest &, ShapeContacts &);
//   bool capsule_and_plane(const Placed<Capsule> &, const Placed<FlatSurface> &, const CollisionRequest &,
//                          ShapeContacts &);
//   table.add<capsule_and_sphere, capsule_and_plane>();
//
// Such a function clears and fills `contacts` and returns whether there are any. Normals point to the
// first of both, which is the particle with a shape. Contacts of two particles are in the axes of space;
// those with a surface in the frame of the large body, where its pose is the identity. They should be
// continuous in the poses, and depend on nothing else but, by rounding, the start of the request: neither on calls
// before nor on the thread.

#ifndef TALUS_SHAPE_COLLISIONS_H
#define TALUS_SHAPE_COLLISIONS_H

#include "shape/geometry.h"
#include "shape/pose.h"
#include "shape/shape_contact.h"

#include <map>
#include <typeindex>
#include <typeinfo>
#include <utility>

namespace Talus {

/// How the contacts of two convex particles are found.
enum class NarrowPhase {
  FEATURES,    ///< see convex/collide.h
  MPR          ///< one point per pair, by Minkowski Portal Refinement
};

/// One of the two, with its pose.
template <class Kind> struct Placed {
  const Kind &geometry;
  const Pose &pose;
};

struct CollisionRequest {
  /// The elastic force of a contact grows as overlap^force_exponent (1: linear, 3/2: hertz), which
  /// weights may depend on.
  double force_exponent = 1.0;
  NarrowPhase method = NarrowPhase::FEATURES;
  SeparatingDirection *direction = nullptr;    ///< of two particles: to be read and written
  /// The normal of the step before, where it is kept (see ShapeContact::begins_search); nullptr: none.
  const Vector3<double> *start = nullptr;
};

/// One of several pairs whose contacts are asked for together: `contacts` has been cleared and is to be filled.
struct CollisionJob {
  const Geometry *a, *b;
  const Pose *pose_a, *pose_b;
  SeparatingDirection *direction;
  ShapeContacts *contacts;
  const Vector3<double> *start;
};

class Collisions {
 public:
  /// Finds the contacts of several pairs of the same two classes, in this order, as the function of one pair does:
  /// to the same bits, whatever the others are.
  using OfMany = void (*)(const CollisionJob *jobs, int count);

  using Function = bool (*)(const Geometry &a, const Pose &pose_a, const Geometry &b,
                            const Pose &pose_b, const CollisionRequest &request,
                            ShapeContacts &contacts);

  /// Adds functions as above. Of two for the same classes the later one counts.
  template <auto... functions> void add() { (Adder<functions>::add(*this), ...); }

  /// For two classes that have a function already: the same for several pairs, if that pays.
  template <class A, class B> void add_many(OfMany many) { of_many[{typeid(A), typeid(B)}] = many; }

  /// Contacts of two things whose classes are known to the table.
  class Collision {
   public:
    Collision() = default;
    Collision(Function collision_function, bool is_exchanged, OfMany many_function) :
        function(collision_function), many(many_function), exchanged(is_exchanged)
    {
    }
    /// nullptr: pairs are to be looked at one by one.
    OfMany of_many() const { return many; }
    /// false: they cannot touch, and operator() must not be called.
    explicit operator bool() const { return function != nullptr; }
    /// Normals point to a; names and the direction are those of a and b.
    bool operator()(const Geometry &a, const Pose &pose_a, const Geometry &b, const Pose &pose_b,
                    const CollisionRequest &request, ShapeContacts &contacts) const;

   private:
    Function function = nullptr;
    OfMany many = nullptr;
    bool exchanged = false;
  };
  Collision find(const Geometry &a, const Geometry &b) const;

 private:
  template <auto function> struct Adder;

  using Classes = std::pair<std::type_index, std::type_index>;
  std::map<Classes, Function> functions;
  std::map<Classes, OfMany> of_many;
};

/* How a function with classes of its own is called. */

template <class A, class B,
          bool (*function)(const Placed<A> &, const Placed<B> &, const CollisionRequest &,
                           ShapeContacts &)>
struct Collisions::Adder<function> {
  static bool call(const Geometry &a, const Pose &pose_a, const Geometry &b, const Pose &pose_b,
                   const CollisionRequest &request, ShapeContacts &contacts)
  {
    return function({static_cast<const A &>(a), pose_a}, {static_cast<const B &>(b), pose_b},
                    request, contacts);
  }
  static void add(Collisions &to) { to.functions[{typeid(A), typeid(B)}] = call; }
};

}    // namespace Talus

#endif
