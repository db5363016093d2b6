#include "src2d/dynamics/spring_forces.h"

#include <optional>

namespace merge2d {
namespace {

Vec2 velocityAt(const State& state, BodyId body, const Vec2& p) {
  return state.rigid(body).velocityAt(p);
}

/// 1/m seen along `direction` at a place `arm` from the centre of mass of a body, 0 when it does
/// not respond; with no direction the largest of all.
double inverseMassAt(const State& state, BodyId id, const Vec2& arm,
                     const std::optional<Vec2>& direction) {
  const Body& body = state[id];
  if (!state.responds(id)) return 0.0;
  const double lever = direction ? cross(arm, *direction) : arm.norm();
  return 1.0 / body.mass + lever * lever / body.inertia;
}

SpringEnd endOf(const State& state, BodyId body, const Vec2& anchor) {
  const Pose pose = state.pose(body);
  const Vec2 at = pose * anchor;
  return {body, at, at - pose.position};
}

SpringStretch stretchOf(const State& state, const TimedSpring& spring) {
  SpringStretch s;
  s.from = endOf(state, BodyId{static_cast<std::uint32_t>(spring.body)}, spring.anchor);
  s.other = spring.to_body >= 0;
  if (s.other) {
    s.to = endOf(state, BodyId{static_cast<std::uint32_t>(spring.to_body)}, spring.to);
  } else {
    s.to.at = spring.to;
  }
  const Vec2 along = s.to.at - s.from.at;
  s.length = along.norm();
  if (s.length > 1e-12) s.direction = along / s.length;
  return s;
}

/// The change of the velocity of each end by an explicit step of a spring, relative to that
/// velocity, summed per body. A spring without length acts in any direction.
void addGains(const State& state, const TimedSpring& spring, const SpringStretch& s,
              std::vector<double>& gain) {
  std::optional<Vec2> direction;
  if (spring.rest_length != 0.0) direction = s.direction;
  const double strength = state.h * spring.damping + state.h * state.h * spring.stiffness;
  const auto add = [&](const SpringEnd& end) {
    gain[index(end.body)] += strength * inverseMassAt(state, end.body, end.arm, direction);
  };
  add(s.from);
  if (s.other) add(s.to);
}

double gainOf(const SpringStretch& s, const std::vector<double>& gain) {
  return gain[index(s.from.body)] + (s.other ? gain[index(s.to.body)] : 0.0);
}

/// A spring and the bodies at its ends by themselves, as if nothing else acted on them.
class SpringPair {
 public:
  SpringPair(const State& state, const TimedSpring& spring, const SpringStretch& s)
      : h_(state.h),
        stiffness_(spring.stiffness),
        rest_(spring.rest_length),
        way_(s.length * s.direction),
        a_(endOf(state, s.from)) {
    if (s.other) b_ = endOf(state, s.to);
    // Seen from where the whole stands still: what an end that does not respond does is no energy
    // of the spring.
    const Vec2 frame = a_.mass == 0.0 ? a_.velocity()
                       : b_.mass == 0.0
                           ? b_.velocity()
                           : Vec2((a_.mass * a_.v + b_.mass * b_.v) / (a_.mass + b_.mass));
    for (End* end : {&a_, &b_}) {
      end->v -= frame;
      if (end->mass == 0.0) *end = {};
    }
  }

  /// ½ k s² + ½ Σ (m v² + I ω²) + ½ h P, with the stretch s and the power P of the spring [J]. Of a
  /// linear spring an explicit step (first velocities, then positions) leaves it exactly as it is.
  double energy() const {
    const double stretch = way_.norm() - rest_;
    const Vec2 pull = stiffness_ * stretch * way_.stableNormalized();
    const double power = pull.dot(a_.velocity() - b_.velocity());
    return 0.5 * stiffness_ * stretch * stretch + a_.energy() + b_.energy() + 0.5 * h_ * power;
  }

  /// The same after a step under the force on the first body.
  SpringPair after(const Vec2& force) const {
    SpringPair next = *this;
    next.a_.push(h_ * force);
    next.b_.push(-h_ * force);
    next.way_ += next.b_.move(h_) - next.a_.move(h_);
    return next;
  }

 private:
  struct End {
    double mass = 0.0, inertia = 0.0;  ///< 0: does not respond
    Vec2 arm = Vec2::Zero(), v = Vec2::Zero();
    double omega = 0.0;

    Vec2 velocity() const { return v + cross(omega, arm); }
    double energy() const { return 0.5 * (mass * v.squaredNorm() + inertia * omega * omega); }
    void push(const Vec2& impulse) {
      if (mass == 0.0) return;
      v += impulse / mass;
      omega += cross(arm, impulse) / inertia;
    }
    /// The way of the end [m].
    Vec2 move(double h) {
      const Vec2 before = arm;
      arm = Rotation::of(h * omega) * arm;
      return h * v + arm - before;
    }
  };

  static End endOf(const State& state, const SpringEnd& end) {
    const Rigid& r = state.rigid(end.body);
    End e{.arm = end.arm, .v = r.velocityAt(end.at - end.arm), .omega = r.omega};
    if (state.responds(end.body)) {
      e.mass = state[end.body].mass;
      e.inertia = state[end.body].inertia;
    }
    return e;
  }

  double h_, stiffness_, rest_;
  Vec2 way_;  ///< from the first end to the other [m]
  End a_, b_;
};

/// Whether an explicit step of a spring adds energy to its bodies: their ends turn far in it.
bool addsEnergy(const State& state, const TimedSpring& spring, const SpringStretch& s,
                const Vec2& force) {
  // With 0.02 soft springs that wind a body up lose energy too, with 0.1 stiff ones gain 80 %.
  constexpr double kGain = 0.05;
  const SpringPair pair(state, spring, s);
  return pair.after(force).energy() > (1.0 + kGain) * pair.energy();
}

/// The parts of the force on the first body.
struct SpringForce {
  Vec2 pull = Vec2::Zero();    ///< by the stretch [N]
  Vec2 damped = Vec2::Zero();  ///< the velocity that its damping ends [m/s]
  Vec2 along = Vec2::Zero();   ///< the velocity that an implicit step ends [m/s]
};

/// A spring without length damps every motion of its end, a long one only along itself. So does an
/// implicit step between two bodies: across the spring it would turn both.
SpringForce forceOf(const State& state, const TimedSpring& spring, const SpringStretch& s) {
  Vec2 velocity = -velocityAt(state, s.from.body, s.from.at);
  if (s.other) velocity += velocityAt(state, s.to.body, s.to.at);
  const Vec2 along = velocity.dot(s.direction) * s.direction;
  return {spring.stiffness * (s.length - spring.rest_length) * s.direction,
          spring.rest_length == 0.0 ? velocity : along,
          spring.rest_length == 0.0 && !s.other ? velocity : along};
}

/// Springs that are together too stiff for an explicit step would gain energy until they explode:
/// they get the force of an implicit one. One that adds energy as its ends turn gets the damping of
/// an implicit step beside its pull, so that it holds a body at rest as before.
Vec2 stableForce(const State& state, const TimedSpring& spring, const SpringStretch& s,
                 double gain) {
  const auto [pull, damped, along] = forceOf(state, spring, s);
  const Vec2 implicit =
      (spring.damping * damped + state.h * spring.stiffness * along) / (1.0 + gain);
  if (gain > 1.0) return pull / (1.0 + gain) + implicit;
  const Vec2 force = pull + spring.damping * damped;
  return addsEnergy(state, spring, s, force) ? Vec2(pull + implicit) : force;
}

void addSpring(const State& state, const TimedSpring& spring, std::uint32_t number,
               const SpringStretch& s, Scratch& scratch) {
  const Vec2 force = stableForce(state, spring, s, gainOf(s, scratch.spring_gain));
  scratch.loads.push_back({s.from.body, force, cross(s.from.arm, force)});
  if (s.other) scratch.loads.push_back({s.to.body, -force, cross(s.to.arm, -force)});
  scratch.springs.push_back({.number = number,
                             .body = s.from.body,
                             .other = s.other ? s.to.body : BodyId{},
                             .to_world = !s.other,
                             .from = s.from.at,
                             .to = s.to.at,
                             .force = force.dot(s.direction)});
}

bool acts(const State& state, const TimedSpring& spring) {
  return !spring.removed && state.bodies[spring.body].alive;
}

}  // namespace

void addSprings(const State& state, const Actions& actions, Scratch& scratch) {
  if (actions.springs.empty()) return;
  auto& gain = scratch.spring_gain;
  gain.resize(state.bodies.size(), 0.0);
  for (const TimedSpring& spring : actions.springs) {
    gain[spring.body] = 0.0;
    if (spring.to_body >= 0) gain[static_cast<std::size_t>(spring.to_body)] = 0.0;
  }
  // Where the ends of a spring are takes longer than all else about it, above all in collections.
  scratch.stretches.clear();
  for (const TimedSpring& spring : actions.springs) {
    if (!acts(state, spring)) continue;
    scratch.stretches.push_back(stretchOf(state, spring));
    addGains(state, spring, scratch.stretches.back(), gain);
  }
  auto stretch = scratch.stretches.begin();
  for (std::uint32_t i = 0; i < actions.springs.size(); ++i) {
    if (!acts(state, actions.springs[i])) continue;
    addSpring(state, actions.springs[i], i, *stretch++, scratch);
  }
}

double springEnergy(const State& state, const Actions& actions) {
  double energy = 0.0;
  for (const TimedSpring& spring : actions.springs) {
    if (spring.removed) continue;
    const double stretch = stretchOf(state, spring).length - spring.rest_length;
    energy += 0.5 * spring.stiffness * stretch * stretch;
  }
  return energy;
}

}  // namespace merge2d
