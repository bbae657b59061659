// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Contacts of several holders, some of which take theirs and some not, while particles move, against a
// map: a contact is with its holder or in the lists, never twice.

#include "history/contact_memory.h"
#include "random_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

using namespace Talus;

namespace {

constexpr int particles = 20;

/// Of each particle one value or none.
class Body final : public ContactMemory::Holder {
 public:
  Body(std::int64_t partner, std::uint64_t kind) : name(partner), feature(kind) {}
  std::map<int, double> held;

  bool owns(const ContactLists::Contact &one) const override
  {
    return one.partner == name && one.feature == feature;
  }
  void put_aside(ContactLists &to) override
  {
    for (const auto &[particle, value] : held) *to.add(particle, name, feature, 1) = value;
    held.clear();
  }
  void take(ContactMemory &memory)
  {
    for (int i = 0; i < particles; i++)
      memory.lists().for_each(i, [&](const ContactLists::Contact &one) {
        if (owns(one)) held[i] = *one.value;
      });
    memory.are_taken(*this);
  }

 private:
  std::int64_t name;
  std::uint64_t feature;
};

class Memory : public testing::Test {
 protected:
  Memory()
  {
    memory.pairs().resize(particles);
    for (int n = 0; n < 4; n++) make();
  }
  ~Memory() override
  {
    for (auto &one : bodies) memory.remove(*one);
  }

  /// One and the same name has contacts with spheres and with shapes.
  void make()
  {
    const auto number = static_cast<std::int64_t>(bodies.size());
    bodies.push_back(std::make_unique<Body>(-1 - number / 2, number % 2 ? ContactLists::of_shape
                                                                        : std::uint64_t{0}));
    memory.add(*bodies.back());
  }

  void step(std::size_t n)
  {
    if (bodies[n]->is_at_rest()) bodies[n]->take(memory);
    const int i = random.below(particles);
    if (random.chance(0.4)) {
      bodies[n]->held.erase(i);
      model[n].erase(i);
    } else {
      bodies[n]->held[i] = model[n][i] = random.uniform(-1.0, 1.0);
    }
  }

  void move(int from, int to)
  {
    memory.put_aside();
    memory.pairs().copy(from, to);
    memory.pairs().forget(from);
    for (auto &[n, of_body] : model) {
      of_body.erase(to);
      if (const auto one = of_body.find(from); one != of_body.end()) of_body[to] = one->second;
      of_body.erase(from);
    }
  }

  void expect_model(std::size_t n)
  {
    std::map<int, double> found = bodies[n]->held;
    for (int i = 0; bodies[n]->is_at_rest() && i < particles; i++)
      memory.lists().for_each(i, [&](const ContactLists::Contact &one) {
        if (!bodies[n]->owns(one)) return;
        EXPECT_EQ(found.count(i), 0U) << "twice";
        found[i] = *one.value;
      });
    EXPECT_EQ(found, model[n]);
  }

  RandomSource random{3};
  ContactMemory memory;
  std::vector<std::unique_ptr<Body>> bodies;
  std::map<std::size_t, std::map<int, double>> model;
};

TEST_F(Memory, HasEachContactOnce)
{
  for (int round = 0; round < 3000; round++) {
    const auto n = static_cast<std::size_t>(random.below(static_cast<int>(bodies.size())));
    switch (random.below(8)) {
    case 0:
      move(random.below(10), 10 + random.below(10));
      break;
    case 1:
      memory.put_aside();
      break;
    case 2:    // a command is deleted, and one with its name defined
      memory.remove(*bodies[n]);
      bodies[n]->held.clear();
      model[n].clear();
      memory.add(*bodies[n]);
      break;
    default:
      step(n);
    }
    for (std::size_t k = 0; k < bodies.size(); k++) expect_model(k);
    ASSERT_FALSE(HasFailure()) << "round " << round;
  }
}

TEST_F(Memory, IsRestored)
{
  for (int n = 0; n < 40; n++) step(n % 4);
  SavedState saved;
  StateExchange saving(saved);
  memory.exchange_state(saving);
  const auto then = model;
  for (int n = 0; n < 40; n++) step(n % 4);
  StateExchange restoring(static_cast<const SavedState &>(saved));
  memory.exchange_state(restoring);
  for (auto &one : bodies) one->held.clear();    // they take theirs out of it
  model = then;
  for (std::size_t k = 0; k < bodies.size(); k++) expect_model(k);
}

TEST_F(Memory, IsEmptyWhenAllHaveTakenTheirs)
{
  for (int n = 0; n < 40; n++) step(n % 4);
  memory.put_aside();
  EXPECT_FALSE(memory.lists().empty());
  memory.drop_spheres();
  for (auto &one : bodies) one->take(memory);
  EXPECT_TRUE(memory.lists().empty());
}

TEST(ContactMemory, NamesAreNegativeAndDiffer)
{
  std::map<std::int64_t, int> seen;
  for (int n = 0; n < 10000; n++) {
    const std::int64_t name = ContactMemory::name_of("floor" + std::to_string(n));
    EXPECT_LT(name, 0);
    EXPECT_EQ(seen[name]++, 0);
  }
}

}    // namespace
