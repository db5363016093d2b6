// A state is saved and tried under two settings: which one keeps more bodies merged?

#include <merge2d/merge2d.h>

#include <cstdio>

int main() {
  const merge2d::Scene scene = merge2d::Scene::load("books");
  merge2d::World world(scene);
  world.step(100);
  const std::string state = world.save();

  // The same state, the same settings: the same bits.
  merge2d::World again(scene);
  again.restore(state);
  world.step(50);
  again.step(50);
  if (world.save() != again.save()) return 1;
  std::printf("both are the same after %lld steps\n", static_cast<long long>(world.steps()));

  // The same state under other settings.
  for (const double velocity : {0.001, 0.1}) {
    merge2d::World other(scene);
    other.set("merging.velocity", velocity);
    other.restore(state, true);
    other.step(50);
    std::printf("merging.velocity = %g m/s: %d bodies are simulated\n", velocity,
                other.counts().active_bodies);
  }
}
