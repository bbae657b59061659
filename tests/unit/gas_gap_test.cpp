// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Heat through the gas of a gap: against the integral equation of Batchelor and O'Brien, a film by quadrature, kernels,
// and what acts where bodies are apart.

#include "contacts_by_words.h"
#include "laws/second_order_laws.h"
#include "shape/contact/point_batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace contacts;

namespace {

constexpr double pi = 3.14159265358979323846;
const std::string elastic = "hertz/material 1e8 0.8 0.3 ";

double flow(const Pair &pair, double gap)
{
  ContactState<double> s = pair.at(gap);
  s.temperature_difference = 1.0;
  return single_contact(pair.law, pair.row, s, 1.0e-5).heat_flow;
}

/// Against a flat body.
double flow_from_wall(const Pair &pair, double gap)
{
  ContactState<double> s = pair.at(gap);
  s.temperature_difference = 1.0;
  s.inverse_radius = 1.0 / pair.radius;
  s.inverse_distance = 0.0;
  return single_contact(pair.law, pair.row, s, 1.0e-5).heat_flow;
}

/// Two half spaces of conductivity k with a gap s(r) between them that is filled with gas. Lengths in units of R/alpha,
/// gaps in those of R/alpha^2: the flux f of the unit k_gas alpha^2/R has
///
///   1 = s(x) f(x) + 1/pi integral of f(y)/|x - y| over the plane,   H = 2 integral of x f dx
///
/// by rings with constant f.
class HalfSpaces {
 public:
  explicit HalfSpaces(std::vector<double> edges) : edge(std::move(edges)) {}

  /// H less 2 ln of the largest radius.
  double solve(const std::function<double(double)> &gap) const
  {
    const std::size_t n = edge.size() - 1;
    std::vector<std::vector<double>> rows(n, std::vector<double>(n + 1, 0.0));
    for (std::size_t i = 0; i < n; i++) {
      for (std::size_t j = 0; j < n; j++) rows[i][j] = potential(middle(i), j);
      rows[i][i] += gap(middle(i));
      rows[i][n] = 1.0;
    }
    double sum = 0.0;
    const std::vector<double> f = solution(rows);
    for (std::size_t i = 0; i < n; i++)
      sum += f[i] * (edge[i + 1] * edge[i + 1] - edge[i] * edge[i]);
    return sum - 2.0 * std::log(edge.back());
  }

 private:
  double middle(std::size_t i) const { return 0.5 * (edge[i] + edge[i + 1]); }

  /// Of a ring with the density pi^-1, at the radius x: graded towards the middle of the ring.
  double potential(double x, std::size_t ring) const
  {
    static const double node[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                  0.9602898564975363},
                        weight[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                    0.1012285362903763};
    const double half = 0.5 * (edge[ring + 1] - edge[ring]);
    double sum = 0.0;
    for (const double side : {-1.0, 1.0})
      for (int q = 0; q < 8; q++) {
        const double t = 0.5 * (1.0 + (q % 2 ? 1.0 : -1.0) * node[q / 2]);
        const double y = middle(ring) + side * half * t * t * t, r = (x - y) / (x + y);
        sum += 4.0 * elliptic(std::fabs(r)) / (x + y) * y * half * 1.5 * t * t * weight[q / 2];
      }
    return sum / pi;
  }

  /// Complete integral of the first kind, by its complementary modulus.
  static double elliptic(double modulus)
  {
    double a = 1.0, b = modulus;
    for (int n = 0; n < 9; n++) {
      const double mean = 0.5 * (a + b);
      b = std::sqrt(a * b);
      a = mean;
    }
    return 0.5 * pi / a;
  }

  static std::vector<double> solution(std::vector<std::vector<double>> &a)
  {
    const std::size_t n = a.size();
    for (std::size_t k = 0; k < n; k++)
      for (std::size_t i = k + 1; i < n; i++) {
        const double factor = a[i][k] / a[k][k];
        for (std::size_t j = k; j <= n; j++) a[i][j] -= factor * a[k][j];
      }
    std::vector<double> x(n);
    for (std::size_t i = n; i-- > 0;) {
      x[i] = a[i][n];
      for (std::size_t j = i + 1; j < n; j++) x[i] -= a[i][j] * x[j];
      x[i] /= a[i][i];
    }
    return x;
  }

  std::vector<double> edge;
};

void add_geometric(std::vector<double> &edges, double from, double begin, double end, int count)
{
  for (int n = 0; n <= count; n++)
    edges.push_back(from + begin * std::pow(end / begin, static_cast<double>(n) / count));
}

// Radii of 1 mm, alpha = 1e4, a column of half a radius: H of the law in units of pi k_gas R.
class AgainstHalfSpaces : public ::testing::Test {
 protected:
  static constexpr double radius = 1e-3, alpha = 1e4, gas = 0.02;
  const Pair pair{elastic + "heat gas 200 0.02 0.5 1", radius, radius};
  const double outer = 2.0 * std::log(0.5 * alpha);

  double of_law(double gap) const { return flow(pair, gap) / (pi * gas * radius) - outer; }
};

TEST_F(AgainstHalfSpaces, PointsAndGaps)
{
  std::vector<double> edges{0.0};
  add_geometric(edges, 0.0, 1e-4, 1e5, 160);
  const HalfSpaces spaces(edges);
  EXPECT_NEAR(spaces.solve([](double x) { return x * x; }), -3.9, 0.06);    // of the paper
  for (const double lambda : {0.0, 1.0, 10.0, 100.0, 1e3, 1e4}) {
    const double expected = spaces.solve([&](double x) { return lambda + x * x; });
    EXPECT_NEAR(of_law(lambda * radius / (alpha * alpha)), expected, 0.15) << lambda;
  }
}

TEST_F(AgainstHalfSpaces, Contacts)
{
  for (const double beta : {0.3, 3.0, 30.0, 300.0}) {
    std::vector<double> edges;
    for (int n = 0; n < 60; n++) edges.push_back(beta * std::sin(0.5 * pi * n / 60));
    edges.push_back(beta);
    add_geometric(edges, beta, 1e-6 * beta, 1e5 * std::max(1.0, beta), 120);
    const double expected = HalfSpaces(edges).solve([&](double x) {
      const double r = x / beta;
      return r <= 1.0 ? 0.0
                      : beta * beta * 2.0 / pi *
                            (std::sqrt(r * r - 1.0) - (2.0 - r * r) * std::acos(1.0 / r));
    });
    const double a = beta * radius / alpha, overlap = 2.0 * a * a / radius;
    EXPECT_NEAR(of_law(-overlap), expected, 0.15 + 2e-3 * beta) << beta;
  }
}

// Where solids conduct beyond measure and the gap is wide: a film between paraboloids.
TEST(GasGap, IsAFilm)
{
  const double k = 1e9, gas = 0.03, column = 0.7;
  std::ostringstream words;
  words << elastic << "heat gas " << k << " " << gas << " " << column << " 1";
  for (const double other : {1e-3, 2.5e-3, 2e-2}) {
    const Pair pair(words.str(), 1e-3, other);
    const double effective = 1e-3 * other / (1e-3 + other);
    for (const double gap : {1e-5, 1e-4, 4e-4}) {
      const auto film = [&](double r) {
        return gas * 2.0 * pi * r / (gap + 0.5 * r * r / effective);
      };
      const double expected = integral(film, 0.0, column * 1e-3);
      EXPECT_NEAR(flow(pair, gap), expected, 1e-6 * expected) << other << " " << gap;
    }
  }
  const Pair pair(words.str(), 1e-3, 1e-3);
  const auto film = [&](double r) { return gas * 2.0 * pi * r / (1e-4 + 0.5 * r * r / 1e-3); };
  const double expected = integral(film, 0.0, column * 1e-3);
  EXPECT_NEAR(flow_from_wall(pair, 1e-4), expected, 1e-6 * expected);
}

TEST(GasGap, ReachesInProportionToTheRadius)
{
  const Pair pair(elastic + "heat gas 1 0.02 0.7 0.5", 1e-3, 3e-3);
  EXPECT_TRUE(pair.law.reaches());
  EXPECT_NEAR(pair.reach(), 0.5 * 1.5e-3, 1e-18);
  EXPECT_NEAR(pulloff_distance_of(pair.law, pair.row, 1e-3), 0.5 * 2e-3, 1e-18);
}

// One conductance, without a jump at touch.
TEST(GasGap, IsContinuousAtTouch)
{
  const Pair pair(elastic + "heat gas 10 0.02 0.7 0.5", 1e-3, 2e-3);
  const double at_touch = flow(pair, 1e-15);
  EXPECT_NEAR(flow(pair, -1e-15), at_touch, 1e-3 * at_touch);
  EXPECT_GT(flow(pair, -1e-6), at_touch);
  EXPECT_LT(flow(pair, 1e-6), at_touch);
}

// Resistance, friction, adhesion and impacts end where surfaces part, whatever the laws are.
TEST(GasGap, OnlyHeatPassesThroughIt)
{
  for (const std::string law :
       {"hooke 1e4 20", "hertz 1e6 0.5 damping tsuji adhesion constant 1e-3",
        "plaincoulomb 2e4 5 0.5", "dmt 1e7 0.5 0.3 0.1",
        "hooke/material 1e7 0.6 0.3 1 tangential multistep NULL NULL 0.5 rolling 0.1 delayed "
        "spinning 0.1 delayed",
        "hertz 1e6 50 tangential mindlin 1e6 1 0.5 rolling sds 1e3 1 0.1 twisting marshall"}) {
    const Pair pair(law + " heat gas 10 0.02 0.7 0.5", 1e-3, 2e-3), dry(law, 1e-3, 2e-3);
    ContactBatch batch = pair.touching_and_apart();
    ContactBatch without = batch;
    accounting_kernel(pair.law, true, true)(batch, 0, ContactBatch::width, &pair.row, 1e-5);
    for (int k = 0; k < ContactBatch::width; k++) {
      if (k % 2) continue;
      EXPECT_EQ(batch.heat_flow[k], 10.0 * flow(pair, 1e-6 * (k + 1))) << law;
      for (int d = 0; d < 3; d++) {
        EXPECT_EQ(batch.force[d][k], 0.0) << law;
        EXPECT_EQ(batch.torque_per_radius[d][k], 0.0) << law;
        EXPECT_EQ(batch.twisting_torque[d][k], 0.0) << law;
        EXPECT_EQ(batch.work[d][k], 0.0) << law;
      }
      for (int n = 0; n < pair.law.history().size; n++) EXPECT_EQ(batch.history[n][k], 0.0) << law;
      EXPECT_EQ(pair.stored(1e-6 * (k + 1)), 0.0) << law;
    }
    // what touches has the forces that it has without heat
    for (int k = 0; k < ContactBatch::width; k += 2) without.overlap[k] = 1e-6;
    accounting_kernel(dry.law, true, true)(without, 0, ContactBatch::width, &dry.row, 1e-5);
    for (int k = 1; k < ContactBatch::width; k += 2)
      for (int d = 0; d < 3; d++) EXPECT_EQ(batch.force[d][k], without.force[d][k]) << law;
  }
}

TEST(GasGap, IsRefusedWhereItCannotBe)
{
  const Pair pair(elastic + "heat gas 1 0.02 0.7 0.5", 1e-3, 1e-3);
  EXPECT_NE(reason_against_second_order(pair.law, pair.row).find("heat gas"), std::string::npos);
  EXPECT_NE(PointBatch::refusal(pair.law).find("conducts heat"), std::string::npos);
  const auto has = [](const std::string &words, const std::string &text) {
    const std::string problem = problem_of(words);
    EXPECT_NE(problem.find(text), std::string::npos) << words << ": " << problem;
  };
  has("jkr 1e5 1 0.3 1 heat gas 1 0.02 0.7 0.5", "only after they have");
  has(elastic + "heat gas 1 0.02 0.7 0.5 adhesion willett 0.07 0 volume 1e-12", "willett only");
  has(elastic + "heat gas 0 0.02 0.7 0.5", "conductivity k of the grains");
  has(elastic + "heat gas 1 0 0.7 0.5", "conductivity of the gas");
  has(elastic + "heat gas 1 0.02 0 0.5", "radius of the column");
  has(elastic + "heat gas 1 0.02 0.7 -1", "reach over the radius");
}

}    // namespace
