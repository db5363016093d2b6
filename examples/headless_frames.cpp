// Pictures of a run, without a display: frame_000.png, frame_001.png, …

#include <merge2d/merge2d.h>

#include <cstdio>

int main() {
  merge2d::World world(merge2d::Scene::load("books"));
  merge2d::PictureDef picture = merge2d::pictureDef();
  picture.width = 480;
  picture.height = 270;
  picture.overlays = "contacts";
  for (int frame = 0; frame < 5; ++frame) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%03d.png", frame);
    world.writePng(name, picture);
    std::printf("%s shows t = %.2f s\n", name, world.time());
    world.step(20);
  }
}
