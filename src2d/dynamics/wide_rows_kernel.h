/// The rows of four contacts at once: the same operations in the same order in each lane as in
/// rows.cpp and contact_block.h. Included by wide_kernels.cpp once for each set of instructions,
/// after wide_kernel.h; so it includes nothing, and has no `#pragma once`.

/// std::max(a, b) and std::min(a, b)
inline void maximum(Four& to, const Four& a, const Four& b) { to = a < b ? b : a; }
inline void minimum(Four& to, const Four& a, const Four& b) { to = b < a ? b : a; }

/// merge2d::onGrid
inline void toGrid(Four& x) {
  constexpr double kShift = 0x1.8p10, kReach = 0x1p9;
  if (allOf((x < kReach) & (x > -kReach))) {
    x = (x + kShift) - kShift;
  } else {
    x = Four{onGrid(x[0]), onGrid(x[1]), onGrid(x[2]), onGrid(x[3])};
  }
}

/// Normals and lever arms: merge2d::setArms.
inline void setArms(const FourContacts& of, WideBlock& k) {
  k.nx = of.c * of.nx - of.s * of.ny;
  k.ny = of.s * of.nx + of.c * of.ny;
  const Four tx = -k.ny, ty = k.nx;
  for (int i = 0; i < k.points; ++i) {
    Four x = of.c * of.px[i] - of.s * of.py[i], y = of.s * of.px[i] + of.c * of.py[i];
    toGrid(x);
    toGrid(y);
    const Four ax = of.x + x - of.center_ax, ay = of.y + y - of.center_ay;
    const Four bx = of.x + x - of.center_bx, by = of.y + y - of.center_by;
    k.arm_an[i] = ax * k.ny - ay * k.nx;
    k.arm_bn[i] = bx * k.ny - by * k.nx;
    k.arm_at[i] = ax * ty - ay * tx;
    k.arm_bt[i] = bx * ty - by * tx;
  }
}

/// merge2d::contactBias
inline void setBias(const FourContacts& of, const RowSettings& settings, WideBlock& k) {
  for (int i = 0; i < k.points; ++i) {
    const Four& gap = of.gap[i];
    Four correction;
    maximum(correction, settings.erp * gap / settings.h, Four{} - settings.max_correction);
    k.bias[i] = gap > Four{} ? gap / settings.h : correction;
  }
}

/// merge2d::contactSoftness of the bodies' own masses, and no more than under a blow.
inline void setSoftness(const FourContacts& of, const RowSettings& settings,
                        const FourVelocities& a, const FourVelocities& b, WideBlock& k) {
  const Four dx = b.vx - a.vx, dy = b.vy - a.vy;
  Four speed{};
  Mask rests = of.gap[0] <= Four{};
  for (int i = 0; i < k.points; ++i) {
    const Four n = k.nx * dx + k.ny * dy + k.arm_bn[i] * b.omega - k.arm_an[i] * a.omega;
    maximum(speed, speed, -n);
    if (i > 0) rests |= of.gap[i] <= Four{};
  }
  const Four inv_mass = 1.0 / of.mass_a + 1.0 / of.mass_b;
  const Four most_sinking = kSinkOfSmall * of.size * settings.erp;
  const Four compliance = settings.compliance * settings.fall > most_sinking
                              ? most_sinking / settings.fall
                              : Four{} + settings.compliance;
  Four softness = compliance * inv_mass;
  const Four under_blow = settings.margin * inv_mass / (settings.h * speed);
  Four least;
  minimum(least, softness, under_blow);
  softness = speed > Four{} ? least : softness;
  k.softness = rests ? softness : Four{};
}

/// merge2d::fillMasses
inline void fillMasses(const FourVelocities& a, const FourVelocities& b, const Four& inv_inertia_a,
                       const Four& inv_inertia_b, WideBlock& k) {
  const Four inv_mass = a.inv_mass + b.inv_mass;
  for (int i = 0; i < k.points; ++i) {
    k.inv_kt[i] = 1.0 / (inv_mass + inv_inertia_a * k.arm_at[i] * k.arm_at[i] +
                         inv_inertia_b * k.arm_bt[i] * k.arm_bt[i]);
  }
  k.k11 = inv_mass + inv_inertia_a * k.arm_an[0] * k.arm_an[0] +
          inv_inertia_b * k.arm_bn[0] * k.arm_bn[0] + k.softness;
  k.too_close = 0;
  if (k.points < 2) return;
  k.k22 = inv_mass + inv_inertia_a * k.arm_an[1] * k.arm_an[1] +
          inv_inertia_b * k.arm_bn[1] * k.arm_bn[1] + k.softness;
  k.k12 = inv_mass + inv_inertia_a * k.arm_an[0] * k.arm_an[1] +
          inv_inertia_b * k.arm_bn[0] * k.arm_bn[1];
  const Four det = k.k11 * k.k22 - k.k12 * k.k12;
  const Mask close = det < 1e-6 * k.k11 * k.k22;
  k.inv_det = 1.0 / det;
  for (int lane = 0; lane < 4; ++lane) {
    if (close[lane] != 0) k.too_close = static_cast<std::uint8_t>(k.too_close | 1U << lane);
  }
}

inline void makeRowsWide(const FourContacts& of, const RowSettings& settings,
                         const SolverVelocity* u, WideBlock& k) {
  FourVelocities a, b;
  gather(a, u, k.a);
  gather(b, u, k.b);
  FourInertias rest_a, rest_b;
  gather(rest_a, u, k.a);
  gather(rest_b, u, k.b);
  setArms(of, k);
  setBias(of, settings, k);
  setSoftness(of, settings, a, b, k);
  fillMasses(a, b, rest_a.inv_inertia, rest_b.inv_inertia, k);
}

/// merge2d::contactVelocity
inline void velocitiesWide(const WideBlock& k, const SolverVelocity* u, FourContactVelocities& to) {
  FourVelocities a, b;
  gather(a, u, k.a);
  gather(b, u, k.b);
  FourInertias rest_a, rest_b;
  gather(rest_a, u, k.a);
  gather(rest_b, u, k.b);
  const Four dx = b.vx - a.vx, dy = b.vy - a.vy;
  const Four v_n = k.nx * dx + k.ny * dy, v_t = k.nx * dy - k.ny * dx;
  for (int i = 0; i < k.points; ++i) {
    to.n[i] = v_n + k.arm_bn[i] * b.omega - k.arm_an[i] * a.omega;
    to.t[i] = v_t + k.arm_bt[i] * b.omega - k.arm_at[i] * a.omega + rest_a.surface + rest_b.surface;
  }
}
