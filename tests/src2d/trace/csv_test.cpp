#include "src2d/trace/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace merge2d {
namespace {

using testing::EndsWith;
using testing::StartsWith;

Snapshot sample() {
  Snapshot s;
  s.step = 3;
  s.time = 0.03;
  s.events = {{EventType::Merge, BodyId{1}, BodyId{2}, CollectionId{0}, EventReason::None},
              {EventType::Merge, BodyId{2}, BodyId{3}, CollectionId{0}, EventReason::None},
              {EventType::Unmerge, BodyId{1}, BodyId{2}, CollectionId{0}, EventReason::Broken}};
  s.stats.bodies = 10;
  s.stats.active_bodies = 4;
  s.stats.collections = 2;
  s.stats.asleep = 1;
  s.stats.contacts = 20;
  s.stats.internal_contacts = 30;
  s.stats.max_penetration = 0.001;
  s.stats.residual = 0.5;
  s.stats.kinetic_energy = 6;
  s.stats.potential_energy = 7;
  s.stats.momentum = {8, 9};
  s.stats.angular_momentum = -1;
  s.stats.seconds.fill(0.25);
  return s;
}

TEST(CsvWriter, WritesARowUnderItsColumns) {
  std::stringstream text;
  CsvWriter writer(text, false);
  writer.add(sample());
  EXPECT_EQ(text.str(),
            "step,t,bodies,active_bodies,collections,asleep,contacts,internal_contacts,merges,"
            "unmerges,max_penetration,residual,kinetic_energy,potential_energy,momentum_x,"
            "momentum_y,angular_momentum\n"
            "3,0.03,10,4,2,1,20,30,2,1,0.001,0.5,6,7,8,9,-1\n");
}

TEST(CsvWriter, AddsTheSecondsOfAStepLast) {
  std::stringstream text;
  CsvWriter writer(text, true);
  writer.add(sample());
  EXPECT_THAT(text.str(), EndsWith(",9,-1,2.75\n"));
  EXPECT_NE(text.str().find(",seconds\n"), std::string::npos);
}

TEST(CsvWriter, BeginsInTheWayByWhichTablesAreRecognised) {
  std::stringstream text;
  const CsvWriter writer(text, true);
  EXPECT_THAT(text.str(), StartsWith(std::string(kCsvStart)));
}

}  // namespace
}  // namespace merge2d
