#pragma once
/// Everything about a run that is a number or a switch: the scene's [solver], [merging],
/// [unmerging], [sleeping], [material] and [drawing] tables.

#include <string>

#include "src2d/core/vec.h"

namespace merge2d {

/// Which of the two savings are on (`--mode`).
enum class Mode { Reference, Sleep, Merge, MergeSleep };

constexpr bool merges(Mode m) { return m == Mode::Merge || m == Mode::MergeSleep; }
constexpr bool sleeps(Mode m) { return m == Mode::Sleep || m == Mode::MergeSleep; }

/// Which pairs merge: `Default` carries the cures that 2D needs; `Paper` follows the paper to the
/// letter.
enum class MergingRule { Default, Paper };

/// Rules of unmerging: the same two; the default one decides from impulses that have converged
/// (docs/decisions/decided.md).
enum class UnmergingRule { Default, Paper };

enum class SolverMethod {
  Nncg,    ///< "nncg": block sweeps inside a nonsmooth nonlinear conjugate gradient
  Block,   ///< "block": sweeps with the exact 2×2 block of a manifold's normals
  Pgs,     ///< "pgs": the paper's plain projected Gauss-Seidel, one row at a time
  Newton,  ///< "newton": all rows of an island at once (dynamics/newton.h), then sweeps as "nncg"
};

/// Sweeps stand inside the conjugate gradient.
inline bool isAccelerated(SolverMethod method) {
  return method == SolverMethod::Nncg || method == SolverMethod::Newton;
}

enum class Stabilisation {
  Baumgarte,  ///< "baumgarte": a share of each overlap becomes a velocity
  Post,       ///< "post": positions are corrected after the step, velocities know nothing of it
};

/// [solver]
struct SolverSettings {
  SolverMethod method = SolverMethod::Nncg;
  int iterations = 10;  ///< sweeps of the full solve, Section 8.1
  Stabilisation stabilisation = Stabilisation::Baumgarte;
  double erp = 0.05;            ///< Baumgarte: part of the overlap that is removed per step [1]
  double compliance = 0.009;    ///< softness C = compliance · (1/mA + 1/mB), so it is [1]
  double max_correction = 0.5;  ///< fastest velocity with which overlap is removed [m/s]
  double margin = 0.005;        ///< contacts are kept up to this gap [m]
  double restitution_velocity = 0.5;  ///< slower approaches do not bounce [m/s]
};

/// Which welds of pairs with a single contact are allowed (Section 8.2).
enum class CycleCriterion { Off, Triangle, Rigid };

/// Where two bodies are looked at for how fast they move against each other (Fig. 2).
enum class Metric {
  Corners,  ///< "corners": at the corners of their boxes, Eq. (15)
  Naive,    ///< "naive": at their contacts alone, which a slow see-saw deceives
};

/// [merging], Table 1
struct MergingSettings {
  MergingRule rule = MergingRule::Default;
  double velocity = 1e-2;   ///< relative motion threshold, Eq. (17) [m/s]
  double breathing = 1e-5;  ///< largest change of the overlap between two steps [m]
  double sliding = 1e-2;    ///< slip threshold, Eq. (18) [m/s]
  int steps = 3;            ///< consecutive steps for which the criteria must hold
  CycleCriterion cycles = CycleCriterion::Rigid;
  Metric metric = Metric::Corners;
};

/// [unmerging], Table 1
struct UnmergingSettings {
  UnmergingRule rule = UnmergingRule::Default;
  double velocity = 2e-2;  ///< relative motion threshold [m/s]
  double sliding = 1e-2;   ///< slip threshold, Eq. (19) [m/s]
  int steps = 3;           ///< consecutive steps above the threshold
  int sweeps = 1;          ///< PGS sweeps per step over the contacts inside collections
  bool ordering = true;    ///< breadth first from what is new (Section 6.2)
};

/// [sleeping], Table 1
struct SleepingSettings {
  double velocity = 1e-5;  ///< [m/s]
  int steps = 3;
  double time = 1.0;  ///< an accelerating body must stay below `velocity` for so long ahead [s]
};

/// [material]: what a body has that does not say otherwise.
struct Material {
  double friction = 0.6;     ///< two bodies touch with the geometric mean sqrt(μA μB)
  double restitution = 0.0;  ///< two bodies touch with the larger one
  double rolling = 0.0;      ///< lever arm of the rolling resistance, likewise [m]
  double density = 1.0;      ///< [kg/m²]
};

/// [drawing]: what a pixel of a drawn scene means.
struct DrawingSettings {
  double pixel = 0.1;         ///< side of a pixel [m]
  double stiffness = 0.0;     ///< of a spring pixel [N/m]; 0: chosen from the body's mass
  double damping = 0.0;       ///< of a spring pixel [N s/m]; 0: chosen from the body's mass
  double pinned_until = 2.0;  ///< when a green body is let go [s]
};

struct Settings {
  SolverSettings solver;
  MergingSettings merging;
  UnmergingSettings unmerging;
  SleepingSettings sleeping;
  Material material;
  DrawingSettings drawing;
};

}  // namespace merge2d
