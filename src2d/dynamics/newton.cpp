#include "src2d/dynamics/newton.h"

#include "src2d/dynamics/interior_point.h"

namespace merge2d {
namespace {

std::shared_ptr<InteriorPoint> pointOf(std::span<const ContactBlock> blocks,
                                       std::span<const JointBlock> joints,
                                       std::span<const std::uint32_t> bodies,
                                       const std::vector<SolverVelocity>& u) {
  auto point = std::make_shared<InteriorPoint>(bodies, u);
  for (const ContactBlock& k : blocks) point->addBlock(k);
  for (const JointBlock& k : joints) point->addJoint(k);
  return point;
}

void takeAll(InteriorPoint& point, std::span<ContactBlock> blocks, std::span<JointBlock> joints,
             std::vector<SolverVelocity>& u) {
  for (ContactBlock& k : blocks) point.takeImpulses(k);
  for (JointBlock& k : joints) point.takeImpulses(k);
  for (const ContactBlock& k : blocks) applyImpulses(k, u[k.a], u[k.b]);
  for (const JointBlock& k : joints) applyJointImpulses(k, {}, u[k.a], u[k.b]);
}

}  // namespace

bool solveByNewton(std::span<ContactBlock> blocks, std::span<JointBlock> joints,
                   std::span<const std::uint32_t> bodies, std::vector<SolverVelocity>& u) {
  NewtonIterate iterate;
  const auto point = pointOf(blocks, joints, bodies, u);
  point->run(0.0, iterate, InteriorPoint::kMostSteps);
  if (point->converged()) takeAll(*point, blocks, joints, u);
  return point->converged();
}

bool continueByNewton(std::span<ContactBlock> blocks, std::span<JointBlock> joints,
                      std::span<const std::uint32_t> bodies, std::vector<SolverVelocity>& u,
                      double tolerance, NewtonIterate& iterate, int most_steps,
                      NewtonWorkspace& workspace) {
  if (iterate.unknowns.empty() || !workspace.point) {
    workspace.point = pointOf(blocks, joints, bodies, u);
    if (iterate.unknowns.size() != workspace.point->unknowns()) iterate = {};  // it begins
  }
  if (!workspace.point->run(tolerance, iterate, most_steps)) return false;
  iterate = {};
  takeAll(*workspace.point, blocks, joints, u);
  workspace = {};
  return true;
}

}  // namespace merge2d
