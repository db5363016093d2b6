/// A steady step allocates nothing.

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/support/scenes.h"

namespace {

thread_local bool counting = false;
thread_local int allocations = 0;

void* allocate(std::size_t bytes, std::size_t alignment) {
  if (counting) ++allocations;
  const std::size_t whole = (std::max<std::size_t>(bytes, 1) + alignment - 1) / alignment;
  void* memory = std::aligned_alloc(alignment, whole * alignment);
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t bytes) { return allocate(bytes, alignof(std::max_align_t)); }
void* operator new[](std::size_t bytes) { return allocate(bytes, alignof(std::max_align_t)); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocate(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace merge2d {
namespace {

/// Calls of operator new while `work` runs.
template <class Work>
int allocationsIn(Work&& work) {
  allocations = 0;
  counting = true;
  work();
  counting = false;
  return allocations;
}

TEST(Allocation, TheCounterCounts) {
  EXPECT_EQ(allocationsIn([] { ::operator delete(::operator new(8)); }), 1);
  EXPECT_EQ(allocationsIn([] {}), 0);
}

TEST(Allocation, AStandingWallAllocatesNothing) {
  for (const Mode mode : {Mode::Reference, Mode::Sleep, Mode::Merge, Mode::MergeSleep}) {
    World world(wall(10, 10), inMode(mode));
    runSteps(world, 400);
    EXPECT_EQ(allocationsIn([&] { runSteps(world, 100); }), 0) << name(mode);
  }
}

TEST(Allocation, AWallOnASwingingPlatformAllocatesNothing) {
  for (const Mode mode : {Mode::Reference, Mode::Merge}) {
    World world(wallOnSwingingPlatform(10, 10, 0.4, 4.0), inMode(mode));
    runSteps(world, 1200);
    EXPECT_EQ(allocationsIn([&] { runSteps(world, 100); }), 0) << name(mode);
  }
}

TEST(Allocation, AWallThatMovesAcrossTheWorldAllocatesNothing) {
  Scene scene = noGravity();
  addWall(scene, 6, 6);
  for (BodyDesc& body : scene.bodies) body.velocity = {3, 1};
  World world = reference(scene);
  runSteps(world, 300);
  EXPECT_EQ(allocationsIn([&] { runSteps(world, 100); }), 0);
}

TEST(Allocation, CapturingAgainIntoTheSameSnapshotAllocatesNothing) {
  World world = reference(wall(10, 10));
  runSteps(world, 400);
  Snapshot snapshot;
  world.capture(snapshot);
  EXPECT_EQ(allocationsIn([&] { world.capture(snapshot); }), 0);
}

}  // namespace
}  // namespace merge2d
