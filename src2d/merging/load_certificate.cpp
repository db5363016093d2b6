#include "src2d/merging/load_certificate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "src2d/dynamics/joint_rows.h"
#include "src2d/merging/nonnegative_fit.h"

namespace merge2d {
namespace {

constexpr double kOuterWeight = 0.05;  ///< of a velocity from outside, beside those of the frame

bool isAwake(const State& state, BodyId b) {
  return state.isCollection(state[b].rigid) && !state.rigid(b).asleep;
}

std::uint32_t slotOf(const State& state, BodyId b) {
  return static_cast<std::uint32_t>(index(state[b].rigid) - state.bodies.size());
}

/// Adds impulses per body, in the order in which they come.
class OuterLoads {
 public:
  OuterLoads(const State& state, Scratch& scratch)
      : state_(state), loads_(scratch.outer_loads), place_(scratch.load_place) {
    loads_.clear();
    place_.resize(state.bodies.size(), 0);
  }

  void add(BodyId b, const Vec2& impulse, double moment) {
    if (!isAwake(state_, b)) return;
    std::uint32_t& place = place_[index(b)];
    if (place == 0) {
      loads_.push_back({.slot = slotOf(state_, b), .member = state_[rigidOf(b)].member});
      place = static_cast<std::uint32_t>(loads_.size());
    }
    loads_[place - 1].impulse += impulse;
    loads_[place - 1].moment += moment;
  }

  void finish() {
    for (const OuterLoad& l : loads_) {
      place_[index(state_.collections[l.slot].members[l.member])] = 0;
    }
    std::ranges::sort(loads_, {}, [](const OuterLoad& l) { return packed(l.slot, l.member); });
  }

 private:
  const State& state_;
  std::vector<OuterLoad>& loads_;
  std::vector<std::uint32_t>& place_;  ///< per body: one more than its place in loads_, or 0
};

void addContacts(const State& state, const Scratch& scratch, OuterLoads& loads) {
  for (const BodyPair& pair : scratch.pairs) {
    if (!isAwake(state, pair.a) && !isAwake(state, pair.b)) continue;
    const Pose pose_a = state.pose(pair.a);
    const Vec2 x_b = state.pose(pair.b).position;
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
      const Contact& contact = state.contacts[state.contacts.order[i]];
      const Vec2 n = pose_a.rotation * contact.normal, t = perpendicular(n);
      for (int k = 0; k < contact.count; ++k) {
        const ContactPoint& point = contact.points[static_cast<std::size_t>(k)];
        if (point.lambda_n == 0.0 && point.lambda_t == 0.0) continue;
        const Vec2 p = pose_a * point.position, impulse = point.lambda_n * n + point.lambda_t * t;
        loads.add(pair.a, -impulse, -cross(p - pose_a.position, impulse));
        loads.add(pair.b, impulse, cross(p - x_b, impulse));
      }
      const double rolling = rollingImpulse(state, contact);
      if (rolling == 0.0) continue;
      loads.add(pair.a, Vec2::Zero(), -rolling);
      loads.add(pair.b, Vec2::Zero(), rolling);
    }
  }
}

/// On a body of mass and inertia 1 an impulse is a change of velocity.
void addJoints(const State& state, OuterLoads& loads) {
  for (std::uint32_t i = 0; i < state.joints.size(); ++i) {
    const Joint& joint = state.joints[i];
    if (!holds(state, joint) || isInside(state, joint)) continue;
    if (!isAwake(state, joint.a) && (joint.to_world || !isAwake(state, joint.b))) continue;
    const Vec2 x_a = state.pose(joint.a).position;
    const Vec2 x_b = joint.to_world ? Vec2(Vec2::Zero()) : state.pose(joint.b).position;
    SolverVelocity a{.inv_mass = 1.0, .inv_inertia = 1.0}, b = a;
    JointBlock k =
        makeJointBlock(state, joint, placeOf(state, joint, {}, x_a, x_b), JointRows::Soft, a, b);
    k.lambda = joint.lambda;
    applyJointImpulses(k, {}, a, b);
    loads.add(joint.a, {a.vx, a.vy}, a.omega);
    if (!joint.to_world) loads.add(joint.b, {b.vx, b.vy}, b.omega);
  }
}

}  // namespace

void listOuterLoads(const State& state, Scratch& scratch) {
  OuterLoads loads(state, scratch);
  for (const Load& load : scratch.loads) {
    loads.add(load.body, state.h * load.force, state.h * load.torque);
  }
  for (const Kick& kick : scratch.kicks) {
    loads.add(kick.body, kick.impulse,
              cross(kick.at - state.pose(kick.body).position, kick.impulse));
  }
  addContacts(state, scratch, loads);
  if (!state.joints.empty()) addJoints(state, loads);
  loads.finish();
}

namespace {

/// The velocity that a frame will have at the end of this step, at its centre.
struct FrameMotion {
  Vec2 v = Vec2::Zero();
  double omega = 0.0;
};

FrameMotion motionAfter(const State& state, const Collection& c, std::span<const OuterLoad> outer) {
  const Rigid& r = state[c.rigid];
  if (!r.floating()) {
    if (r.anchor == kWorldFrame) return {};
    const Rigid& anchor = state[rigidOf(c.anchor)];
    return {anchor.v, anchor.omega};
  }
  Vec2 p = Vec2::Zero();
  double l = 0.0;
  for (const OuterLoad& load : outer) {
    const Vec2 arm = r.rotation * (state[c.members[load.member]].local - r.center);
    p += load.impulse;
    l += load.moment + cross(arm, load.impulse);
  }
  return {r.v + state.h * state.gravity + r.inv_mass * p, r.omega + r.inv_inertia * l};
}

/// The velocities that an outer load gives its member, in the collection's frame.
Twist gainOf(const State& state, const Collection& c, const CollectionLoad& load,
             const OuterLoad& outer) {
  const Body& body = state[c.members[outer.member]];
  const Vec2 v = load.back * outer.impulse / body.mass;
  return {v.x(), v.y(), outer.moment / body.inertia * load.size};
}

double dot(const Twist& x, const Twist& y) { return x.vx * y.vx + x.vy * y.vy + x.omega * y.omega; }
double dot(const FrameLoad& x, const FrameLoad& y) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace

CollectionLoad loadOn(const State& state, const Scratch& scratch, const Collection& c) {
  const auto slot = static_cast<std::uint32_t>(&c - state.collections.data());
  const auto& all = scratch.outer_loads;
  const auto first = std::ranges::lower_bound(all, slot, {}, &OuterLoad::slot);
  const auto last = std::ranges::upper_bound(all, slot, {}, &OuterLoad::slot);
  const Rigid& r = state[c.rigid];
  const OrientedBox& box = state.extent(r).box;
  CollectionLoad load;
  load.outer = std::span(all).subspan(static_cast<std::size_t>(first - all.begin()),
                                      static_cast<std::size_t>(last - first));
  load.back = r.rotation.inverse();
  load.size = box.half.norm();
  const FrameMotion after = motionAfter(state, c, load.outer);
  // v(x) = v + ω × (x − c) of both, the earlier one with the rotation before the last step.
  const Rotation turn = load.back * r.previous_rotation;
  const double along = -r.omega * turn.s, across = r.omega * turn.c - after.omega;
  const Vec2 arm = box.frame.position - r.center;
  const Vec2 d = load.back * Vec2(r.v + state.h * state.gravity - after.v) + along * arm +
                 across * perpendicular(arm);
  load.frame = {d.x(), d.y(), along * load.size, across * load.size,
                (r.omega - after.omega) * load.size};
  load.norm = std::sqrt(dot(load.frame, load.frame));
  double outer = 0.0;
  for (const OuterLoad& o : load.outer) {
    if (o.member == c.certificate.front().heaviest) continue;
    const Twist gain = gainOf(state, c, load, o);
    outer += dot(gain, gain);
  }
  load.outer_norm = std::sqrt(outer);
  return load;
}

namespace {

constexpr std::size_t kWitnesses = LoadCertificate::kMost;

/// x · xᵢ of a load and a witness.
double product(const State& state, const Collection& c, const CollectionLoad& load,
               const Witness& witness) {
  double sum = dot(load.frame, witness.frame);
  const auto& columns = c.certificate.front().columns;
  std::size_t k = 0;
  for (const OuterLoad& o : load.outer) {
    while (k < columns.size() && columns[k] < o.member) ++k;
    if (k == columns.size()) break;
    if (columns[k] != o.member) continue;
    sum += kOuterWeight * kOuterWeight * dot(gainOf(state, c, load, o), witness.outer[k]);
  }
  return sum;
}

double product(const Witness& x, const Witness& y) {
  double sum = dot(x.frame, y.frame);
  for (std::size_t k = 0; k < x.outer.size(); ++k) {
    sum += kOuterWeight * kOuterWeight * dot(x.outer[k], y.outer[k]);
  }
  return sum;
}

}  // namespace

namespace {

/// A load beside those of the witnesses.
struct Projection {
  LoadCertificate::Weights weights{};
  double left = 0.0;  ///< |x − Σ wᵢ xᵢ|², of which rounding may leave less than nothing
};

/// The nearest combination of the first `n` loads of `gram` to one of products `b` and square `xx`.
Projection project(std::span<const double> gram, const LoadCertificate::Weights& b, std::size_t n,
                   double xx) {
  Projection p{nonNegativeFit(gram, b, n), xx};
  for (std::size_t i = 0; i < n; ++i) {
    p.left -= 2.0 * p.weights[i] * b[i];
    for (std::size_t j = 0; j < n; ++j) {
      p.left += p.weights[i] * p.weights[j] * gram[i * kWitnesses + j];
    }
  }
  return p;
}

}  // namespace

bool covers(const State& state, Collection& c, const CollectionLoad& load) {
  constexpr double kFrame = 0.9e-3, kOuter = 3e-2;  // of the load that may be left over
  constexpr double kLeast = 2e-6;                   // [m/s]
  LoadCertificate& proof = c.certificate.front();
  const std::size_t n = proof.witnesses.size();
  if (n == 0) return false;
  LoadCertificate::Weights b{};
  for (std::size_t i = 0; i < n; ++i) b[i] = product(state, c, load, proof.witnesses[i]);
  const double outer = kOuterWeight * load.outer_norm;
  const Projection p = project(proof.gram, b, n, load.norm * load.norm + outer * outer);
  const double most = std::max(kLeast, kFrame * load.norm + kOuter * outer);
  if (p.left > most * most) return false;
  proof.lambda_stale |= p.weights != proof.weights;
  proof.weights = p.weights;
  return true;
}

bool leadsTo(const State& state, const Collection& c, const CollectionLoad& load) {
  const ProofSearch& search = c.certificate.front().search;
  const double outer = kOuterWeight * load.outer_norm,
               square = load.norm * load.norm + outer * outer;
  const double left =
      square - 2.0 * product(state, c, load, search.load) + product(search.load, search.load);
  return left <= search.way * search.way;
}

namespace {

void fillGram(LoadCertificate& proof) {
  const std::size_t n = proof.witnesses.size();
  proof.gram.resize(kWitnesses * kWitnesses);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      proof.gram[i * kWitnesses + j] = product(proof.witnesses[i], proof.witnesses[j]);
    }
  }
}

/// How far a witness is from the cone of the others, squared.
double worthOf(const LoadCertificate& proof, std::size_t which) {
  std::array<double, kWitnesses * kWitnesses> gram{};
  LoadCertificate::Weights b{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < proof.witnesses.size(); ++i) {
    if (i == which) continue;
    std::size_t m = 0;
    for (std::size_t j = 0; j < proof.witnesses.size(); ++j) {
      if (j != which) gram[n * kWitnesses + m++] = proof.gram[i * kWitnesses + j];
    }
    b[n++] = proof.gram[i * kWitnesses + which];
  }
  const double xx = proof.gram[which * kWitnesses + which];
  return project(gram, b, n, xx).left / xx;
}

/// Drops the witness without which the others lose least.
void makePlace(LoadCertificate& proof) {
  if (proof.witnesses.size() < kWitnesses) return;
  std::size_t least = 0;
  double worth = 1e300;
  for (std::size_t i = 0; i < proof.witnesses.size(); ++i) {
    const double of = worthOf(proof, i);
    if (of < worth) {
      worth = of;
      least = i;
    }
  }
  proof.witnesses.erase(proof.witnesses.begin() + static_cast<std::ptrdiff_t>(least));
  fillGram(proof);
}

/// The columns of the certificate, and those of this load too.
void addColumns(LoadCertificate& proof, const CollectionLoad& load) {
  std::vector<std::uint32_t> columns = proof.columns;
  for (const OuterLoad& o : load.outer) {
    if (o.member != proof.heaviest) columns.push_back(o.member);
  }
  std::ranges::sort(columns);
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  if (columns == proof.columns) return;
  for (Witness& witness : proof.witnesses) {
    std::vector<Twist> outer(columns.size());
    for (std::size_t k = 0; k < proof.columns.size(); ++k) {
      const auto at = std::ranges::lower_bound(columns, proof.columns[k]) - columns.begin();
      outer[static_cast<std::size_t>(at)] = witness.outer[k];
    }
    witness.outer = std::move(outer);
  }
  proof.columns = std::move(columns);
}

}  // namespace

void readImpulses(const Collection& c, Witness& to) {
  to.lambda.clear();
  to.lambda.reserve(c.blocks.size() + c.joints.size());
  for (const ContactBlock& k : c.blocks) to.lambda.push_back(k.lambda);
  for (const JointBlock& k : c.joints) to.lambda.push_back(k.lambda);
}

void swapImpulses(Collection& c, Witness& with) {
  std::size_t at = 0;
  for (ContactBlock& k : c.blocks) std::swap(k.lambda, with.lambda[at++]);
  for (JointBlock& k : c.joints) std::swap(k.lambda, with.lambda[at++]);
}

namespace {

/// The nearest combination of the witnesses' loads, of whatever signs; a little damped, as loads
/// that hardly differ tell little.
Eigen::VectorXd combinationFor(const LoadCertificate& proof, const Witness& load) {
  constexpr double kDamping = 1e-8;  // of the largest square
  const auto n = static_cast<Eigen::Index>(proof.witnesses.size());
  Eigen::MatrixXd gram(n, n);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      gram(i, j) =
          proof.gram[static_cast<std::size_t>(i) * kWitnesses + static_cast<std::size_t>(j)];
    }
    b[i] = product(proof.witnesses[static_cast<std::size_t>(i)], load);
  }
  gram.diagonal().array() += kDamping * gram.diagonal().maxCoeff();
  return gram.ldlt().solve(b);
}

void limitImpulses(const Collection& c, Witness& load) {
  for (std::size_t b = 0; b < c.blocks.size(); ++b) {
    const ContactBlock& k = c.blocks[b];
    if (k.bilateral) continue;
    Impulses& lambda = load.lambda[b];
    for (std::size_t i = 0; i < 2; ++i) {
      lambda[i] = static_cast<int>(i) < k.count ? std::max(0.0, lambda[i]) : 0.0;
      const double most = k.mu * lambda[i];
      lambda[i + 2] = std::clamp(lambda[i + 2], -most, most);
    }
  }
}

}  // namespace

void predictImpulses(const Collection& c, Witness& load) {
  const LoadCertificate& proof = c.certificate.front();
  if (proof.witnesses.empty()) return;
  const Eigen::VectorXd w = combinationFor(proof, load);
  load.lambda.assign(c.blocks.size() + c.joints.size(), {});
  for (std::size_t i = 0; i < proof.witnesses.size(); ++i) {
    const double part = w[static_cast<Eigen::Index>(i)];
    for (std::size_t k = 0; k < load.lambda.size(); ++k) {
      for (std::size_t r = 0; r < 4; ++r) {
        load.lambda[k][r] += part * proof.witnesses[i].lambda[k][r];
      }
    }
  }
  limitImpulses(c, load);
}

void remember(Collection& c, Witness&& witness) {
  LoadCertificate& proof = c.certificate.front();
  makePlace(proof);
  proof.witnesses.push_back(std::move(witness));
  fillGram(proof);
  proof.weights = {};
  proof.weights[proof.witnesses.size() - 1] = 1.0;
  proof.lambda_stale = true;
}

Witness asWitness(const State& state, Collection& c, const CollectionLoad& load) {
  LoadCertificate& proof = c.certificate.front();
  addColumns(proof, load);
  Witness witness;
  witness.frame = load.frame;
  witness.outer.assign(proof.columns.size(), {});
  for (const OuterLoad& o : load.outer) {
    if (o.member == proof.heaviest) continue;
    const auto at = std::ranges::lower_bound(proof.columns, o.member) - proof.columns.begin();
    witness.outer[static_cast<std::size_t>(at)] = gainOf(state, c, load, o);
  }
  return witness;
}

namespace {

/// x + s (x − y), of what two witnesses say of their loads.
Witness extrapolated(const Witness& x, const Witness& y, double s) {
  const auto of = [&](double a, double b) { return a + s * (a - b); };
  Witness next = x;
  for (std::size_t i = 0; i < next.frame.size(); ++i) next.frame[i] = of(x.frame[i], y.frame[i]);
  for (std::size_t k = 0; k < next.outer.size(); ++k) {
    const Twist &a = x.outer[k], &b = y.outer[k];
    next.outer[k] = {of(a.vx, b.vx), of(a.vy, b.vy), of(a.omega, b.omega)};
  }
  return next;
}

Witness meanOf(const LoadCertificate& proof) {
  Witness mean = proof.witnesses.front();
  for (std::size_t n = 1; n < proof.witnesses.size(); ++n) {
    mean = extrapolated(mean, proof.witnesses[n], -1.0 / static_cast<double>(n + 1));
  }
  return mean;
}

}  // namespace

Witness beyond(const LoadCertificate& proof, const Witness& load, double part, double least,
               double& way) {
  const Witness mean = meanOf(proof);
  const double square = product(load, load) - 2.0 * product(load, mean) + product(mean, mean);
  const double distance = std::sqrt(std::max(square, 1e-300));
  way = std::max(part * distance, least * std::sqrt(product(load, load)));
  return extrapolated(load, mean, way / distance);
}

Twist loadOnMember(const State& state, const Collection& c, const Witness& load,
                   std::uint32_t member) {
  const OrientedBox& box = state.extent(c.rigid).box;
  const double size = box.half.norm();
  const Vec2 arm = state[c.members[member]].local - box.frame.position;
  const double along = load.frame[2] / size, across = load.frame[3] / size;
  Twist u{load.frame[0] + along * arm.x() - across * arm.y(),
          load.frame[1] + along * arm.y() + across * arm.x(), load.frame[4] / size};
  const auto& columns = c.certificate.front().columns;
  const auto at = std::ranges::lower_bound(columns, member);
  if (at != columns.end() && *at == member) {
    const Twist& e = load.outer[static_cast<std::size_t>(at - columns.begin())];
    u.vx += e.vx;
    u.vy += e.vy;
    u.omega += e.omega / size;
  }
  return u;
}

void loadMembers(const State& state, const Collection& c, const CollectionLoad& load,
                 std::vector<Twist>& out) {
  const OrientedBox& box = state.extent(c.rigid).box;
  out.resize(c.members.size());
  const FrameLoad& q = load.frame;
  const double along = q[2] / load.size, across = q[3] / load.size;
  for (std::size_t m = 0; m < out.size(); ++m) {
    const Vec2 arm = state[c.members[m]].local - box.frame.position;
    out[m] = {q[0] + along * arm.x() - across * arm.y(), q[1] + along * arm.y() + across * arm.x(),
              q[4] / load.size};
  }
  for (const OuterLoad& o : load.outer) {
    const Twist gain = gainOf(state, c, load, o);
    Twist& u = out[o.member];
    u.vx += gain.vx;
    u.vy += gain.vy;
    u.omega += gain.omega / load.size;
  }
}

void writeImpulses(Collection& c) {
  LoadCertificate& proof = c.certificate.front();
  if (!proof.lambda_stale || proof.witnesses.empty()) return;
  proof.lambda_stale = false;
  const auto combine = [&](std::size_t at, Impulses& lambda) {
    lambda = {};
    for (std::size_t i = 0; i < proof.witnesses.size(); ++i) {
      const double w = proof.weights[i];
      if (w == 0.0) continue;
      const Impulses& of = proof.witnesses[i].lambda[at];
      for (std::size_t r = 0; r < lambda.size(); ++r) lambda[r] += w * of[r];
    }
  };
  std::size_t at = 0;
  for (ContactBlock& k : c.blocks) combine(at++, k.lambda);
  for (JointBlock& k : c.joints) combine(at++, k.lambda);
}

}  // namespace merge2d
