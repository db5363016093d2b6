#include "src2d/proofs/coverage.h"

#include <gtest/gtest.h>

#include "src2d/proofs/decided_settings.h"
#include "src2d/proofs/proof_gram.h"
#include "tests/src2d/relaxation/merged_testing.h"

namespace merge2d {
namespace {

/// A wall that has proofs of two loads: its weight, and a frame that accelerates to the right.
class TwoLoads {
 public:
  TwoLoads() : merged_(wall(3, 3)) {
    LoadCertificate& proof = certificate();
    proof.witnesses = {witness({0.0, -0.1, 0.0, 0.0, 0.0}), witness({0.02, -0.1, 0.0, 0.0, 0.0})};
    proof.inherited = 0;
    proof.columns.clear();
    proof.weights = {};
    fillGram(proof);
  }

  LoadCertificate& certificate() { return merged_.collection().certificate.front(); }
  const State& state() { return merged_.state(); }

  Coverage coverageOf(double x, double y) {
    CollectionLoad load;
    load.frame = {x, y, 0.0, 0.0, 0.0};
    load.norm = std::hypot(x, y);
    return merge2d::coverageOf(merged_.state(), merged_.collection(), load);
  }

 private:
  Witness witness(const FrameLoad& frame) {
    Witness of;
    of.frame = frame;
    of.lambda.resize(merged_.collection().blocks.size());
    return of;
  }

  Merged merged_;
};

TEST(Coverage, ALoadBetweenTwoThatWereCarriedHasTheirCombination) {
  TwoLoads loads;
  const Coverage between = loads.coverageOf(0.3 * 0.02, -0.1);
  EXPECT_TRUE(between.carried.holds);
  EXPECT_NEAR(between.weights[0], 0.7, 1e-3);
  EXPECT_NEAR(between.weights[1], 0.3, 1e-3);
  const Coverage heavier = loads.coverageOf(0.6 * 0.02, -0.2);
  EXPECT_TRUE(heavier.carried.holds) << "admissible impulses form a cone";
  EXPECT_NEAR(heavier.weights[0], 1.4, 2e-3);
  EXPECT_NEAR(heavier.weights[1], 0.6, 2e-3);
}

/// The criterion compares the distance of a load from the cone.
TEST(Coverage, ALoadBesideTheConeIsNotCovered) {
  TwoLoads loads;
  for (const double x : {-0.02, -0.005, 0.03, 0.1}) {
    const Coverage beside = loads.coverageOf(x, -0.1);
    EXPECT_FALSE(beside.carried.holds) << x;
    const double away = x < 0.0 ? -x : (0.1 * x - 0.1 * 0.02) / std::hypot(0.02, 0.1);
    EXPECT_NEAR(beside.carried.value, away, 0.02 * away) << x;
    EXPECT_EQ(beside.carried.criterion, "proof");
  }
  EXPECT_FALSE(loads.coverageOf(0.0, 0.1).carried.holds) << "nothing pulls";
}

TEST(Coverage, AProofUnderWhichMembersMoveCarriesNothing) {
  TwoLoads loads;
  for (Witness& witness : loads.certificate().witnesses) {
    witness.motion = 2.0 * cutSpeed(loads.state());
  }
  const Coverage coverage = loads.coverageOf(0.0, -0.1);
  EXPECT_FALSE(coverage.carried.holds);
  EXPECT_EQ(coverage.carried.criterion, "proof-motion");
}

TEST(Coverage, WithoutProofsNothingIsCovered) {
  TwoLoads loads;
  loads.certificate().witnesses.clear();
  loads.certificate().gram.clear();
  EXPECT_FALSE(loads.coverageOf(0.0, -0.1).carried.holds);
  EXPECT_FALSE(loads.coverageOf(0.0, 0.0).carried.holds);
}

}  // namespace
}  // namespace merge2d
