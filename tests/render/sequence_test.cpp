#include "render/sequence.h"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "render/png.h"
#include "src2d/core/error.h"
#include "tests/render/samples.h"
#include "tests/support/temporary_folder.h"

namespace merge2d {
namespace {

using Files = std::vector<std::vector<std::uint8_t>>;

/// Frame `k` of a small run: the wall moves, and its collections come and go.
Snapshot frameOf(const samples::Sample& sample, int k) {
  samples::Sample now = sample;
  for (BodyState& body : now.snapshot.bodies) body.x.x() += 0.05 * k;
  now.snapshot.collections.clear();
  now.collect(1 + k / 2, {samples::id(1), samples::id(2)});
  now.collect(20 + k / 3, {samples::id(3), samples::id(4)});
  now.snapshot.step = k;
  now.snapshot.time = 0.1 * k;
  return now.snapshot;
}

class SequenceTest : public testing::Test {
 protected:
  static constexpr int kFrames = 9;
  samples::Sample sample = samples::tower(3, 3, 1);
  FrameStyle style = samples::styleOf(sample, "A small wall", 160, 90);
  TemporaryFolder folder;

  std::optional<FrameDigests> digests{std::in_place};

  SequenceStats write(const std::filesystem::path& to, int workers, bool resume = false) {
    SequenceWriter writer(sample.bodies, style, {to, workers, resume, &*digests});
    for (int k = 0; k < kFrames; ++k) writer.add(frameOf(sample, k));
    writer.finish();
    EXPECT_EQ(writer.frames(), kFrames);
    return writer.stats();
  }

  static Files read(const std::filesystem::path& from) {
    Files files;
    for (int k = 0; k < kFrames; ++k) files.push_back(readFileBytes(from / frameName(k)));
    return files;
  }
};

TEST(FrameName, HasAConstantWidth) {
  EXPECT_EQ(frameName(0), "frame_000000.png");
  EXPECT_EQ(frameName(123456), "frame_123456.png");
}

TEST_F(SequenceTest, WritesAFrameForEachSnapshot) {
  const SequenceStats stats = write(folder.path() / "new" / "folder", 2);
  EXPECT_EQ(stats.written, kFrames);
  EXPECT_EQ(stats.kept, 0);
  EXPECT_GT(stats.bytes, 1000U);
  const Picture first = loadPng(folder.path() / "new" / "folder" / "frame_000000.png");
  EXPECT_EQ(first.width, 160);
  EXPECT_EQ(first.height, 90);
}

TEST_F(SequenceTest, GivesTheSameBytesWhateverTheNumberOfWorkers) {
  write(folder.path() / "one", 1);
  write(folder.path() / "two", 2);
  write(folder.path() / "four", 4);
  EXPECT_EQ(read(folder.path() / "one"), read(folder.path() / "two"));
  EXPECT_EQ(read(folder.path() / "one"), read(folder.path() / "four"));
}

TEST_F(SequenceTest, ResumesWithTheSameBytes) {
  const std::filesystem::path at = folder.path() / "frames";
  write(at, 2);
  const Files before = read(at);
  // An interruption: some frames are missing, and one is cut (by a disk that was full, say).
  std::filesystem::remove(at / frameName(3));
  std::filesystem::remove(at / frameName(8));
  std::filesystem::resize_file(at / frameName(5), 100);
  const SequenceStats stats = write(at, 2, true);
  EXPECT_EQ(stats.written, 3);
  EXPECT_EQ(stats.kept, kFrames - 3);
  EXPECT_EQ(read(at), before);
}

TEST_F(SequenceTest, DrawsFramesAgainThatAreNotThoseNoted) {
  write(folder.path(), 1);
  const Files before = read(folder.path());
  std::filesystem::copy_file(folder.path() / frameName(2), folder.path() / frameName(4),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_EQ(write(folder.path(), 1, true).written, 1);
  EXPECT_EQ(read(folder.path()), before);
  digests.emplace();
  EXPECT_EQ(write(folder.path(), 1, true).written, kFrames) << "nobody vouches for them";
}

TEST(FrameName, CanBeReadAgain) {
  EXPECT_EQ(frameNumber("frame_000012.png"), 12);
  for (const char* other : {"frame_12.png", "frame_-00012.png", "frame_00001x.png", "frame_.png",
                            "frame_000012.png.part", "xframe_000012.png", ""}) {
    EXPECT_EQ(frameNumber(other), std::nullopt) << other;
  }
}

TEST_F(SequenceTest, SkippedSnapshotsDecideOnColoursToo) {
  const std::filesystem::path all = folder.path() / "all", late = folder.path() / "late";
  write(all, 2);
  {
    SequenceWriter writer(sample.bodies, style, {late, 2, false, nullptr});
    for (int k = 0; k < 5; ++k) writer.skip(frameOf(sample, k));
    for (int k = 5; k < kFrames; ++k) writer.add(frameOf(sample, k));
    writer.finish();
  }
  EXPECT_EQ(readFileBytes(late / frameName(0)), readFileBytes(all / frameName(5)));
}

TEST_F(SequenceTest, PassesOnWhatAWorkerThrew) {
  std::filesystem::create_directories(folder.path() / frameName(2));  // cannot be replaced
  EXPECT_THROW(write(folder.path(), 2), IoError);
}

TEST_F(SequenceTest, SaysWhenTheFolderCannotBeMade) {
  std::ofstream(folder.path() / "file") << "in the way";
  EXPECT_THROW(
      SequenceWriter(sample.bodies, style, {folder.path() / "file" / "frames", 1, false, nullptr}),
      IoError);
}

TEST_F(SequenceTest, CanBeLeftBeforeItIsFinished) {
  SequenceWriter writer(sample.bodies, style, {folder.path(), 2, false, nullptr});
  for (int k = 0; k < 4; ++k) writer.add(frameOf(sample, k));
}

}  // namespace
}  // namespace merge2d
