#include "src2d/dynamics/newton.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "src2d/dynamics/body_matrix.h"

namespace merge2d {
namespace {

constexpr double kRigid = 1e-4;      ///< C of a rigid row, of its K
constexpr double kConverged = 1e-9;  ///< gradient, of the momenta that balance
constexpr double kSettled = 1e-5;    ///< velocity of rigid rows, of the fastest change
constexpr double kStalls = 0.7;      ///< part of it that is left after a futile round
constexpr int kMostRounds = 20, kMostSteps = 60, kMostTrials = 40;
constexpr std::uint32_t kFixed = ~0u;

/// w = d·(v_b − v_a) + r_b ω_b − r_a ω_a + bias, with the softness C.
struct Row {
  std::uint32_t a = kFixed, b = kFixed;  ///< places among the bodies of the island
  Twist j_a, j_b;                        ///< the Jacobian's parts
  double bias = 0.0;
  double own = 0.0, softness = 0.0;  ///< its own one, and C, which may be larger
  double lower = 0.0, upper = 0.0;   ///< of γ, where no cone bounds it
  std::uint32_t block_a = 0, block_b = 0, block_ab = 0;  ///< of the matrix
  double mu = -1.0;  ///< of the cone that this row and the next one share; or none
};

/// The slope −dγ/dw of one or two rows.
struct Slope {
  double nn = 0.0, nt = 0.0, tt = 0.0;
};

double dot(const Twist& x, const Twist& y) { return x.vx * y.vx + x.vy * y.vy + x.omega * y.omega; }
void add(Twist& x, const Twist& y, double s) {
  x.vx += s * y.vx;
  x.vy += s * y.vy;
  x.omega += s * y.omega;
}

/// On the cone |γ_t| ≤ μ γ_n, in the metric of the softness.
Slope project(const Row& n, const Row& t, double& gamma_n, double& gamma_t) {
  if (std::abs(gamma_t) <= n.mu * gamma_n) return {1.0 / n.softness, 0.0, 1.0 / t.softness};
  const double edge = std::copysign(n.mu, gamma_t);
  const double square = n.softness + edge * edge * t.softness;
  gamma_n = std::max(0.0, (n.softness * gamma_n + edge * t.softness * gamma_t) / square);
  gamma_t = edge * gamma_n;
  if (gamma_n == 0.0) return {};
  return {1.0 / square, edge / square, edge * edge / square};
}

Slope project(const Row& row, double& gamma) {
  const double wanted = gamma;
  gamma = std::clamp(wanted, row.lower, row.upper);
  return {gamma == wanted ? 1.0 / row.softness : 0.0, 0.0, 0.0};
}

class Newton {
 public:
  Newton(std::span<const std::uint32_t> bodies, const std::vector<SolverVelocity>& u) : u_(u) {
    place_.assign(u.size(), kFixed);
    for (const std::uint32_t body : bodies) {
      const SolverVelocity& of = u[body];
      place_[body] = static_cast<std::uint32_t>(free_.size());
      free_.push_back({of.vx, of.vy, of.omega});
      mass_.push_back({1.0 / of.inv_mass, 1.0 / of.inv_mass, 1.0 / of.inv_inertia});
    }
  }

  void addBlock(const ContactBlock& k) {
    for (int i = 0; i < k.count; ++i) {
      const double belts = u_[k.a].surface + u_[k.b].surface;
      Row n = makeRow(k.a, k.b, k.nx, k.ny, k.arm_an[i], k.arm_bn[i], k.bias[i], k.softness);
      Row t = makeRow(k.a, k.b, -k.ny, k.nx, k.arm_at[i], k.arm_bt[i], belts, 0.0);
      if (k.bilateral) {
        n.lower = t.lower = -kUnbounded;
        n.upper = t.upper = kUnbounded;
      } else {
        n.mu = k.mu;
        n.softness = t.softness = std::max(n.softness, t.softness);
      }
      rows_.push_back(n), rows_.push_back(t);
      gamma_.push_back(k.lambda_n(i)), gamma_.push_back(k.lambda_t(i));
    }
    if (!k.rolls()) return;
    Row r = makeRow(k.a, k.b, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0);
    r.upper = k.rolling() * std::max(0.0, k.lambda_n(0));  // of the load of the last step
    r.lower = -r.upper;
    rows_.push_back(r), gamma_.push_back(k.lambda[3]);
  }

  void addJoint(const JointBlock& k) {
    k.forEachRow([&](std::size_t i) {
      const JointRow& of = k.rows[i];
      Row r = makeRow(k.a, k.b, of.dx, of.dy, of.arm_a, of.arm_b, of.bias, of.softness);
      const bool bounded = i >= static_cast<std::size_t>(k.coupled);
      r.lower = bounded ? of.lower : -kUnbounded;
      r.upper = bounded ? of.upper : kUnbounded;
      rows_.push_back(r), gamma_.push_back(k.lambda[i]);
    });
  }

  /// Rounds end where the rigid rows are slower than the tolerance. Where bodies slide they may
  /// never be: then a search ends when a round has hardly helped.
  void run(double tolerance) {
    start();
    holdImpulses();
    double left = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kMostRounds; ++round) {
      findImpulses(0.0);
      for (int step = 0; step < kMostSteps && !hasConverged(); ++step) {
        findDirection();
        if (!moveAlong()) break;
      }
      const double before = std::exchange(left, holdImpulses());
      if (left <= std::max(tolerance, kSettled * fastest()) ||
          (tolerance > 0.0 && left > kStalls * before))
        break;
    }
  }

  void takeImpulses(ContactBlock& k) {
    for (int i = 0; i < k.count; ++i) {
      k.lambda_n(i) = gamma_[next_++];
      k.lambda_t(i) = gamma_[next_++];
    }
    if (k.rolls()) k.lambda[3] = gamma_[next_++];
  }
  void takeImpulses(JointBlock& k) {
    k.forEachRow([&](std::size_t i) { k.lambda[i] = gamma_[next_++]; });
  }

 private:
  static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

  /// A body that does not respond adds its velocity to the bias.
  Row makeRow(std::uint32_t a, std::uint32_t b, double dx, double dy, double arm_a, double arm_b,
              double bias, double softness) const {
    Row row{place_[a], place_[b], {-dx, -dy, -arm_a}, {dx, dy, arm_b}};
    double k = 0.0;
    const auto meet = [&](std::uint32_t body, const Twist& j) {
      const SolverVelocity& of = u_[body];
      if (place_[body] == kFixed) {
        row.bias += dot(j, {of.vx, of.vy, of.omega});
      } else {
        k += of.inv_mass * (j.vx * j.vx + j.vy * j.vy) + of.inv_inertia * j.omega * j.omega;
      }
    };
    meet(a, row.j_a);
    meet(b, row.j_b);
    row.bias += bias;
    row.own = softness;
    row.softness = std::max(softness, kRigid * k);
    return row;
  }

  /// The velocity along a row that the twists of the bodies give, without its bias.
  double along(const Row& row, const std::vector<Twist>& of) const {
    double w = 0.0;
    if (row.a != kFixed) w += dot(row.j_a, of[row.a]);
    if (row.b != kFixed) w += dot(row.j_b, of[row.b]);
    return w;
  }

  void start() {
    u_now_ = free_;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto push = [&](std::uint32_t place, const Twist& j) {
        if (place == kFixed) return;
        const Twist& m = mass_[place];
        add(u_now_[place], {j.vx / m.vx, j.vy / m.vy, j.omega / m.omega}, gamma_[i]);
      };
      push(rows_[i].a, rows_[i].j_a);
      push(rows_[i].b, rows_[i].j_b);
    }
    w_.resize(rows_.size());
    dw_.resize(rows_.size());
    slopes_.resize(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) w_[i] = along(rows_[i], u_now_) + rows_[i].bias;
  }

  /// C acts on the change of the impulses, where a row is not as soft as that. Returns the largest
  /// velocity that this leaves [m/s].
  double holdImpulses() {
    double most = 0.0;
    held_.resize(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const double now = (rows_[i].softness - rows_[i].own) * gamma_[i];
      most = std::max(most, std::abs(now - held_[i]));
      held_[i] = now;
    }
    return most;
  }

  /// The fastest change of a velocity in this step [m/s].
  double fastest() const {
    double most = 0.0;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      most = std::max(
          {most, std::abs(u_now_[i].vx - free_[i].vx), std::abs(u_now_[i].vy - free_[i].vy)});
    }
    return most;
  }

  /// γ at w + s Δw; returns Σ γ Δw.
  double findImpulses(double s) {
    double power = 0.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      gamma_[i] = (held_[i] - w_[i] - s * dw_[i]) / rows_[i].softness;
      if (rows_[i].mu < 0.0) {
        slopes_[i] = project(rows_[i], gamma_[i]);
      } else {
        gamma_[i + 1] = (held_[i + 1] - w_[i + 1] - s * dw_[i + 1]) / rows_[i + 1].softness;
        slopes_[i] = project(rows_[i], rows_[i + 1], gamma_[i], gamma_[i + 1]);
        power += gamma_[i] * dw_[i];
        ++i;
      }
      power += gamma_[i] * dw_[i];
    }
    return power;
  }

  /// M (u − u*) − Jᵀγ, beside the momenta that balance in it, in the metric of M⁻¹.
  bool hasConverged() {
    gradient_.assign(free_.size(), {});
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Row& row = rows_[i];
      if (row.a != kFixed) add(gradient_[row.a], row.j_a, -gamma_[i]);
      if (row.b != kFixed) add(gradient_[row.b], row.j_b, -gamma_[i]);
    }
    double contacts = 0.0, inertia = 0.0, rest = 0.0;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const Twist& m = mass_[i];
      const auto square = [&](const Twist& p) {
        return p.vx * p.vx / m.vx + p.vy * p.vy / m.vy + p.omega * p.omega / m.omega;
      };
      const Twist p{m.vx * (u_now_[i].vx - free_[i].vx), m.vy * (u_now_[i].vy - free_[i].vy),
                    m.omega * (u_now_[i].omega - free_[i].omega)};
      contacts += square(gradient_[i]);
      inertia += square(p);
      add(gradient_[i], p, 1.0);
      rest += square(gradient_[i]);
    }
    return rest <= kConverged * kConverged * std::max(contacts, inertia);
  }

  void layOut() {
    for (const Row& row : rows_) {
      if (row.a != kFixed && row.b != kFixed) hessian_.share(row.a, row.b);
    }
    hessian_.layOut(static_cast<std::uint32_t>(mass_.size()));
    for (Row& row : rows_) {
      if (row.a != kFixed) row.block_a = hessian_.blockOf(row.a, row.a);
      if (row.b != kFixed) row.block_b = hessian_.blockOf(row.b, row.b);
      if (row.a != kFixed && row.b != kFixed) row.block_ab = hessian_.blockOf(row.a, row.b);
    }
  }

  /// Adds the part of Jᵀ G J of two rows between the same bodies.
  void fill(const Row& x, const Row& y, double g) {
    const auto vec = [](const Twist& j) { return BodyMatrix::Vec{j.vx, j.vy, j.omega}; };
    if (x.a != kFixed) hessian_.add(x.block_a, vec(x.j_a), vec(y.j_a), g);
    if (x.b != kFixed) hessian_.add(x.block_b, vec(x.j_b), vec(y.j_b), g);
    if (x.a == kFixed || x.b == kFixed) return;
    if (x.a > x.b) {
      hessian_.add(x.block_ab, vec(x.j_a), vec(y.j_b), g);
    } else {
      hessian_.add(x.block_ab, vec(x.j_b), vec(y.j_a), g);
    }
  }

  /// H = M + Jᵀ G J.
  void fillHessian() {
    hessian_.clear();
    for (std::uint32_t i = 0; i < mass_.size(); ++i) {
      hessian_.add(i, {mass_[i].vx, mass_[i].vy, mass_[i].omega});
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      fill(rows_[i], rows_[i], slopes_[i].nn);
      if (rows_[i].mu < 0.0) continue;
      const Row &n = rows_[i], &t = rows_[++i];
      fill(n, t, slopes_[i - 1].nt);
      fill(t, n, slopes_[i - 1].nt);
      fill(t, t, slopes_[i - 1].tt);
    }
  }

  /// d = −H⁻¹ g.
  void findDirection() {
    if (is_new_) layOut();
    fillHessian();
    if (std::exchange(is_new_, false)) cholesky_.analyzePattern(hessian_.matrix());
    cholesky_.factorize(hessian_.matrix());
    Eigen::VectorXd g(static_cast<Eigen::Index>(3 * mass_.size()));
    for (std::size_t i = 0; i < gradient_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(3 * i);
      g[at] = -gradient_[i].vx, g[at + 1] = -gradient_[i].vy, g[at + 2] = -gradient_[i].omega;
    }
    const Eigen::VectorXd d = cholesky_.solve(g);
    direction_.resize(mass_.size());
    for (std::size_t i = 0; i < direction_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(3 * i);
      direction_[i] = {d[at], d[at + 1], d[at + 2]};
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) dw_[i] = along(rows_[i], direction_);
  }

  /// The slope of the cost along the direction, at `s` of it.
  double slopeAt(double s) {
    double slope = -findImpulses(s);
    for (std::size_t i = 0; i < mass_.size(); ++i) {
      const Twist &m = mass_[i], &d = direction_[i], &u = u_now_[i], &f = free_[i];
      slope += m.vx * d.vx * (u.vx + s * d.vx - f.vx) + m.vy * d.vy * (u.vy + s * d.vy - f.vy) +
               m.omega * d.omega * (u.omega + s * d.omega - f.omega);
    }
    return slope;
  }

  /// To the minimum of the cost, whose slope grows along the direction. False where there is none.
  bool moveAlong() {
    const double begin = slopeAt(0.0);
    if (!(begin < 0.0)) return false;
    double low = 0.0, at_low = begin, high = 1.0, at_high = slopeAt(1.0);
    for (int i = 0; at_high < 0.0 && i < kMostTrials; ++i) {
      low = high, at_low = at_high;
      high *= 2.0, at_high = slopeAt(high);
    }
    double s = high;
    for (int i = 0; i < kMostTrials && std::abs(at_high) > kConverged * -begin; ++i) {
      s = (low * at_high - high * at_low) / (at_high - at_low);
      if (i % 3 == 2) s = 0.5 * (low + high);  // where one end would stay for long
      const double slope = slopeAt(s);
      if (std::abs(slope) <= kConverged * -begin) break;
      (slope < 0.0 ? low : high) = s;
      (slope < 0.0 ? at_low : at_high) = slope;
    }
    findImpulses(s);
    for (std::size_t i = 0; i < direction_.size(); ++i) add(u_now_[i], direction_[i], s);
    for (std::size_t i = 0; i < rows_.size(); ++i) w_[i] += s * dw_[i];
    return true;
  }

  const std::vector<SolverVelocity>& u_;
  std::vector<std::uint32_t> place_;  ///< per body: among those of the island, or fixed
  std::vector<Twist> free_, mass_;    ///< per body: velocity without impulses; m, m, I
  std::vector<Row> rows_;
  std::vector<double> gamma_, held_, w_, dw_;  ///< per row
  std::vector<Slope> slopes_;                  ///< at the first row of each cone, and at the others
  std::vector<Twist> u_now_, gradient_, direction_;
  BodyMatrix hessian_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky_;
  bool is_new_ = true;
  std::size_t next_ = 0;
};

}  // namespace

void solveByNewton(std::span<ContactBlock> blocks, std::span<JointBlock> joints,
                   std::span<const std::uint32_t> bodies, std::vector<SolverVelocity>& u,
                   double tolerance) {
  Newton newton(bodies, u);
  for (const ContactBlock& k : blocks) newton.addBlock(k);
  for (const JointBlock& k : joints) newton.addJoint(k);
  newton.run(tolerance);
  for (ContactBlock& k : blocks) newton.takeImpulses(k);
  for (JointBlock& k : joints) newton.takeImpulses(k);
  for (const ContactBlock& k : blocks) applyImpulses(k, u[k.a], u[k.b]);
  for (const JointBlock& k : joints) applyJointImpulses(k, {}, u[k.a], u[k.b]);
}

}  // namespace merge2d
