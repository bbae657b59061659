// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE

#include "shape/superellipsoid/superellipsoid_words.h"

#include "shape/superellipsoid/superellipsoid.h"

namespace Talus {
namespace {

class SuperellipsoidDescription : public ShapeDescription {
 public:
  SuperellipsoidDescription(const ShapeReader &from, const std::string &word, bool has_exponents)
  {
    half = {from.words.positive(word + " a"), from.words.positive(word + " b"),
            from.words.positive(word + " c")};
    if (!has_exponents) return;
    n1 = from.words.number(word + " n1");
    n2 = from.words.number(word + " n2");
  }
  std::vector<std::string> keywords() const override { return {"curvature"}; }
  void read(const std::string & /*keyword*/, Words &words) override
  {
    constexpr SurfaceRadius kinds[] = {SurfaceRadius::MEAN, SurfaceRadius::GAUSSIAN,
                                       SurfaceRadius::VOLUME};
    radius = kinds[words.choice("curvature", {"mean", "gaussian", "volume"})];
  }
  std::shared_ptr<const Shape> make() const override
  {
    return std::make_shared<const Superellipsoid>(half, n1, n2, radius);
  }

 private:
  Vector3<double> half{};
  double n1 = 2.0, n2 = 2.0;
  SurfaceRadius radius = SurfaceRadius::MEAN;
};

std::unique_ptr<ShapeDescription> read_ellipsoid(const ShapeReader &from)
{
  return std::make_unique<SuperellipsoidDescription>(from, "ellipsoid", false);
}

std::unique_ptr<ShapeDescription> read_superellipsoid(const ShapeReader &from)
{
  return std::make_unique<SuperellipsoidDescription>(from, "superellipsoid", true);
}

}    // namespace

std::vector<ShapeWord> superellipsoid_words()
{
  return {{"ellipsoid", read_ellipsoid}, {"superellipsoid", read_superellipsoid}};
}

}    // namespace Talus
