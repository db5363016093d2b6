/// `solveBlock` for four blocks at once: the same operations in the same order in each lane, where
/// `solveBlock` branches both sides and a choice. Included by wide_kernels.cpp once for each set of
/// instructions, inside a namespace; so it includes nothing, and has no `#pragma once`.
///
/// GCC and clang make two or four machine instructions of one of these operations, as the processor
/// has them: SSE2, AVX2, NEON, or plain numbers in WebAssembly.

using Mask = decltype(Four{} < Four{});

/// Four bodies' velocities, by components.
struct FourVelocities {
  Four vx, vy, omega, inv_mass;
};

/// The rest of four bodies.
struct FourInertias {
  Four inv_inertia, surface;
};

/// Rows become columns.
inline void transpose(Four& p, Four& q, Four& r, Four& s) {
  const Four pq_low = __builtin_shufflevector(p, q, 0, 4, 2, 6);
  const Four pq_high = __builtin_shufflevector(p, q, 1, 5, 3, 7);
  const Four rs_low = __builtin_shufflevector(r, s, 0, 4, 2, 6);
  const Four rs_high = __builtin_shufflevector(r, s, 1, 5, 3, 7);
  p = __builtin_shufflevector(pq_low, rs_low, 0, 1, 4, 5);
  q = __builtin_shufflevector(pq_high, rs_high, 0, 1, 4, 5);
  r = __builtin_shufflevector(pq_low, rs_low, 2, 3, 6, 7);
  s = __builtin_shufflevector(pq_high, rs_high, 2, 3, 6, 7);
}

inline void load(Four& to, const double* from) { __builtin_memcpy(&to, from, sizeof to); }
inline void store(double* to, const Four& from) { __builtin_memcpy(to, &from, sizeof from); }

inline void gather(FourVelocities& to, const SolverVelocity* u,
                   const std::array<std::uint32_t, 4>& of) {
  load(to.vx, &u[of[0]].vx);
  load(to.vy, &u[of[1]].vx);
  load(to.omega, &u[of[2]].vx);
  load(to.inv_mass, &u[of[3]].vx);
  transpose(to.vx, to.vy, to.omega, to.inv_mass);
}

inline void gather(FourInertias& to, const SolverVelocity* u,
                   const std::array<std::uint32_t, 4>& of) {
  using Two = double __attribute__((vector_size(16)));
  Two p, q, r, s;
  __builtin_memcpy(&p, &u[of[0]].inv_inertia, sizeof p);
  __builtin_memcpy(&q, &u[of[1]].inv_inertia, sizeof q);
  __builtin_memcpy(&r, &u[of[2]].inv_inertia, sizeof r);
  __builtin_memcpy(&s, &u[of[3]].inv_inertia, sizeof s);
  const Four pr = __builtin_shufflevector(p, r, 0, 1, 2, 3);
  const Four qs = __builtin_shufflevector(q, s, 0, 1, 2, 3);
  to.inv_inertia = __builtin_shufflevector(pr, qs, 0, 4, 2, 6);
  to.surface = __builtin_shufflevector(pr, qs, 1, 5, 3, 7);
}

/// Bodies that do not respond are left alone: other threads read them.
inline void scatter(FourVelocities& from, SolverVelocity* u,
                    const std::array<std::uint32_t, 4>& of) {
  const Four inv_mass = from.inv_mass;
  transpose(from.vx, from.vy, from.omega, from.inv_mass);
  if (inv_mass[0] != 0.0) store(&u[of[0]].vx, from.vx);
  if (inv_mass[1] != 0.0) store(&u[of[1]].vx, from.vy);
  if (inv_mass[2] != 0.0) store(&u[of[2]].vx, from.omega);
  if (inv_mass[3] != 0.0) store(&u[of[3]].vx, from.inv_mass);
}

inline bool allOf(const Mask& m) { return (m[0] & m[1] & m[2] & m[3]) != 0; }

/// std::max(0.0, x)
inline void notNegative(Four& x) { x = x > Four{} ? x : Four{}; }

/// std::clamp(x, -limit, limit)
inline void clamp(Four& x, const Four& limit) {
  const Four least = -limit;
  x = x < least ? least : (limit < x ? limit : x);
}

/// The pressures of two points as `solveNormalPair` finds them, where not both press.
inline void solveByCases(const WideBlock& k, const Four& w1, const Four& w2, const Four& l1,
                         const Four& l2, Four& x1, Four& x2) {
  const Four zero{};
  const Four q1 = w1 - k.k11 * l1 - k.k12 * l2, q2 = w2 - k.k12 * l1 - k.k22 * l2;
  const Four only1 = -q1 / k.k11, leaves2 = k.k12 * only1 + q2;
  const Four only2 = -q2 / k.k22, leaves1 = k.k12 * only2 + q1;
  const Mask both = (x1 >= zero) & (x2 >= zero);
  const Mask first = (only1 >= zero) & (leaves2 >= zero);
  const Mask second = (only2 >= zero) & (leaves1 >= zero);
  const Mask none = (q1 >= zero) & (q2 >= zero);
  const Four miss1 = leaves2 < -q1 ? leaves2 : -q1, miss2 = leaves1 < -q2 ? leaves1 : -q2;
  const Mask nearer1 = miss1 >= miss2;
  Four least1 = only1, least2 = only2;
  notNegative(least1);
  notNegative(least2);
  const Four missed1 = nearer1 ? least1 : zero, missed2 = nearer1 ? zero : least2;
  const Four other1 = second ? zero : (none ? zero : missed1);
  const Four other2 = second ? only2 : (none ? zero : missed2);
  x1 = both ? x1 : (first ? only1 : other1);
  x2 = both ? x2 : (first ? zero : other2);
}

/// Four blocks while they are solved: velocities and impulses of both points, by components. All of
/// it stays in registers, as long as the functions that share it are inlined.
struct FourBlocks {
  FourVelocities a, b;
  FourInertias rest_a, rest_b;
  Four n1, n2, t1, t2;
  Four v_n, v_t;  ///< of the centres of mass against each other, with the belts
};

[[gnu::always_inline]] inline void read(FourBlocks& s, const WideBlock& k, const Impulses* impulses,
                                        const SolverVelocity* u) {
  gather(s.a, u, k.a);
  gather(s.b, u, k.b);
  gather(s.rest_a, u, k.a);
  gather(s.rest_b, u, k.b);
  load(s.n1, impulses[k.block[0]].data());
  load(s.n2, impulses[k.block[1]].data());
  load(s.t1, impulses[k.block[2]].data());
  load(s.t2, impulses[k.block[3]].data());
  transpose(s.n1, s.n2, s.t1, s.t2);
  const Four dx = s.b.vx - s.a.vx, dy = s.b.vy - s.a.vy;
  s.v_n = k.nx * dx + k.ny * dy;
  s.v_t = k.nx * dy - k.ny * dx + s.rest_a.surface + s.rest_b.surface;
}

/// Moves the centres of mass by what was added along normal and tangent, and writes all back.
[[gnu::always_inline]] inline void write(FourBlocks& s, const WideBlock& k, const Four& p_n,
                                         const Four& p_t, Impulses* impulses, SolverVelocity* u) {
  const Four px = k.nx * p_n - k.ny * p_t, py = k.ny * p_n + k.nx * p_t;
  s.a.vx -= s.a.inv_mass * px;
  s.a.vy -= s.a.inv_mass * py;
  s.b.vx += s.b.inv_mass * px;
  s.b.vy += s.b.inv_mass * py;
  scatter(s.a, u, k.a);
  scatter(s.b, u, k.b);
  transpose(s.n1, s.n2, s.t1, s.t2);
  store(impulses[k.block[0]].data(), s.n1);
  store(impulses[k.block[1]].data(), s.n2);
  store(impulses[k.block[2]].data(), s.t1);
  store(impulses[k.block[3]].data(), s.t2);
}

/// w + bias + Cλ of the normal of point `i`, whose impulse is `l`.
[[gnu::always_inline]] inline void normalVelocity(Four& w, const FourBlocks& s, const WideBlock& k,
                                                  int i, const Four& l) {
  w = s.v_n + k.arm_bn[i] * s.b.omega - k.arm_an[i] * s.a.omega + k.bias[i] + k.softness * l;
}

inline void solvePairs(const WideBlock& k, Impulses* impulses, SolverVelocity* u) {
  FourBlocks s;
  read(s, k, impulses, u);

  // Both normals.
  Four w1, w2;
  normalVelocity(w1, s, k, 0, s.n1);
  normalVelocity(w2, s, k, 1, s.n2);
  Four x1 = s.n1 - (k.k22 * w1 - k.k12 * w2) * k.inv_det;
  Four x2 = s.n2 - (k.k11 * w2 - k.k12 * w1) * k.inv_det;
  if (!allOf((x1 >= Four{}) & (x2 >= Four{}))) solveByCases(k, w1, w2, s.n1, s.n2, x1, x2);
  const Four p1 = x1 - s.n1, p2 = x2 - s.n2;
  s.n1 = x1;
  s.n2 = x2;
  s.a.omega -= s.rest_a.inv_inertia * (k.arm_an[0] * p1 + k.arm_an[1] * p2);
  s.b.omega += s.rest_b.inv_inertia * (k.arm_bn[0] * p1 + k.arm_bn[1] * p2);

  // Their friction, as one row: ManifoldFriction.
  const Four pressure = x1 + x2, half = Four{} + 0.5;
  const Mask presses = pressure > Four{};
  const Four of1 = presses ? x1 / pressure : half;
  const Four of2 = presses ? 1.0 - of1 : half;
  const Four arm_a = of1 * k.arm_at[0] + of2 * k.arm_at[1];
  const Four arm_b = of1 * k.arm_bt[0] + of2 * k.arm_bt[1];
  const Four inv_k = of1 * k.inv_kt[0] + of2 * k.inv_kt[1];
  Four both = s.t1 + s.t2 - inv_k * (s.v_t + arm_b * s.b.omega - arm_a * s.a.omega);
  clamp(both, k.mu * pressure);
  const Four f1 = of1 * both - s.t1, f2 = of2 * both - s.t2;
  s.t1 = of1 * both;
  s.t2 = of2 * both;
  s.a.omega -= s.rest_a.inv_inertia * (k.arm_at[0] * f1 + k.arm_at[1] * f2);
  s.b.omega += s.rest_b.inv_inertia * (k.arm_bt[0] * f1 + k.arm_bt[1] * f2);
  write(s, k, p1 + p2, f1 + f2, impulses, u);
}

/// Of single points; what else stands in their impulses stays.
inline void solveSingles(const WideBlock& k, Impulses* impulses, SolverVelocity* u) {
  FourBlocks s;
  read(s, k, impulses, u);
  Four w;
  normalVelocity(w, s, k, 0, s.n1);
  Four x = s.n1 - w / k.k11;
  notNegative(x);
  const Four p_n = x - s.n1;
  s.n1 = x;
  s.a.omega -= s.rest_a.inv_inertia * k.arm_an[0] * p_n;
  s.b.omega += s.rest_b.inv_inertia * k.arm_bn[0] * p_n;
  Four y = s.t1 - k.inv_kt[0] * (s.v_t + k.arm_bt[0] * s.b.omega - k.arm_at[0] * s.a.omega);
  clamp(y, k.mu * x);
  const Four p_t = y - s.t1;
  s.t1 = y;
  s.a.omega -= s.rest_a.inv_inertia * k.arm_at[0] * p_t;
  s.b.omega += s.rest_b.inv_inertia * k.arm_bt[0] * p_t;
  write(s, k, p_n, p_t, impulses, u);
}

inline void sweepWide(const WideBlock* first, const WideBlock* end_of_pairs, const WideBlock* last,
                      Impulses* impulses, SolverVelocity* u) {
  for (; first != end_of_pairs; ++first) solvePairs(*first, impulses, u);
  for (; first != last; ++first) solveSingles(*first, impulses, u);
}

/// `applyImpulses` for four blocks of two points or of one.
inline void warmStart(const WideBlock& k, int points, const Impulses* impulses, SolverVelocity* u) {
  FourBlocks s;
  read(s, k, impulses, u);
  for (int i = 0; i < points; ++i) {
    const Four &p_n = i == 0 ? s.n1 : s.n2, &p_t = i == 0 ? s.t1 : s.t2;
    const Four px = k.nx * p_n - k.ny * p_t, py = k.ny * p_n + k.nx * p_t;
    s.a.vx -= s.a.inv_mass * px;
    s.a.vy -= s.a.inv_mass * py;
    s.a.omega -= s.rest_a.inv_inertia * (k.arm_an[i] * p_n + k.arm_at[i] * p_t);
    s.b.vx += s.b.inv_mass * px;
    s.b.vy += s.b.inv_mass * py;
    s.b.omega += s.rest_b.inv_inertia * (k.arm_bn[i] * p_n + k.arm_bt[i] * p_t);
  }
  scatter(s.a, u, k.a);
  scatter(s.b, u, k.b);
}

inline void warmStartWide(const WideBlock* first, const WideBlock* end_of_pairs,
                          const WideBlock* last, Impulses* impulses, SolverVelocity* u) {
  for (; first != end_of_pairs; ++first) warmStart(*first, 2, impulses, u);
  for (; first != last; ++first) warmStart(*first, 1, impulses, u);
}
