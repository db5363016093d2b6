#include "src2d/relaxation/passed_load.h"

#include <gtest/gtest.h>

#include "src2d/proofs/coverage.h"
#include "src2d/proofs/decided_settings.h"
#include "src2d/relaxation/proof_search.h"
#include "src2d/relaxation/region_members.h"
#include "tests/src2d/relaxation/merged_testing.h"

namespace merge2d {
namespace {

/// So many sweeps over it count as more than those of a step: loads are passed on in it.
Scene largeWall() {
  Scene scene = wall(8, 6);
  scene.settings.solver.iterations = 1000;
  return scene;
}

double fastestUnder(Merged& merged, const CollectionLoad& load) {
  Collection& c = merged.collection();
  std::vector<Twist> gains;
  loadMembers(merged.state(), c, load, gains);
  c.push.forget();
  layOutPush(merged.state(), c);
  double most = 0.0;
  for (std::uint32_t m = 0; m < gains.size(); ++m) {
    most = std::max(most, cornerSpeed(merged.state(), c, m, leftOver(c, m, gains[m])));
  }
  return most;
}

std::vector<Impulses> impulsesOf(const Collection& c) {
  std::vector<Impulses> impulses;
  for (const ContactBlock& k : c.blocks) impulses.push_back(k.lambda);
  return impulses;
}

TEST(PassedLoad, AWeightOnTopIsCarriedAndKnownFromThenOn) {
  Merged merged(largeWall());
  Collection& c = merged.collection();
  const CollectionLoad load = merged.loadWith(merged.last() - 2, {0.0, -0.5});
  EXPECT_FALSE(coverageOf(merged.state(), c, load).carried.holds);
  ASSERT_GT(fastestUnder(merged, load), cutSpeed(merged.state()));
  ASSERT_TRUE(passesOn(merged.state(), merged.scratch(), c, load));
  EXPECT_LT(fastestUnder(merged, load), 2.0 * toleratedResidual(merged.state()));
  merged.expectAdmissible();
  EXPECT_TRUE(coverageOf(merged.state(), c, load).carried.holds);
  const CollectionLoad elsewhere = merged.loadWith(merged.last() - 2, {0.0, -0.25});
  EXPECT_TRUE(coverageOf(merged.state(), c, elsewhere).carried.holds)
      << "between two loads that are carried";
}

/// A search ahead knows nothing of the member that is loaded now.
TEST(PassedLoad, ASearchAheadOfAnotherLoadEnds) {
  Merged merged(largeWall());
  Collection& c = merged.collection();
  LoadCertificate& proof = c.certificate.front();
  ASSERT_FALSE(proof.witnesses.empty());
  beginSearchAhead(merged.state(), c, Witness(proof.witnesses.back()), 1.0);
  const CollectionLoad load = merged.loadWith(merged.last() - 2, {0.0, -0.5});
  ASSERT_TRUE(passesOn(merged.state(), merged.scratch(), c, load));
  EXPECT_TRUE(proof.search.start.empty());
  for (const Witness& witness : proof.witnesses) {
    EXPECT_EQ(witness.outer.size(), proof.columns.size());
  }
}

TEST(PassedLoad, APullBeyondTheWeightIsLeftToASearch) {
  Merged merged(largeWall());
  Collection& c = merged.collection();
  const std::vector<Impulses> before = impulsesOf(c);
  const CollectionLoad load = merged.loadWith(merged.last() - 2, {0.0, 0.5});
  EXPECT_FALSE(passesOn(merged.state(), merged.scratch(), c, load));
  EXPECT_EQ(impulsesOf(c), before);
}

/// It is new on all members: searches look ahead there, and their proofs last longer.
TEST(PassedLoad, AFrameThatMovesAnewIsLeftToASearch) {
  Merged merged(largeWall());
  merged.state().gravity.x() = 0.5;
  const CollectionLoad load = merged.loadWith(merged.last() - 2, {0.0, -0.5});
  EXPECT_FALSE(passesOn(merged.state(), merged.scratch(), merged.collection(), load));
}

}  // namespace
}  // namespace merge2d
