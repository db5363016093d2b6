/* A tower of ten boxes comes to rest and becomes one collection.
 *
 *   cc -std=c99 hello_tower.c $(pkg-config --cflags --libs merge2d) -o hello_tower
 */

#include <merge2d/merge2d.h>
#include <stdio.h>
#include <stdlib.h>

static void check(m2_status status) {
  if (status == M2_OK) return;
  fprintf(stderr, "%s\n", m2_error());
  exit(1);
}

int main(void) {
  m2_scene* scene = m2_scene_new();
  m2_body_def def = m2_body_def_default();
  m2_shape shape = m2_box(20.0, 1.0);
  def.name = "ground";
  def.motion = M2_PINNED;
  def.position.y = -0.5;
  def.shapes = &shape;
  def.shape_count = 1;
  check(m2_scene_add_body(scene, &def, NULL));

  def = m2_body_def_default();
  shape = m2_box(1.0, 1.0);
  def.shapes = &shape;
  def.shape_count = 1;
  for (int i = 0; i < 10; ++i) {
    def.position.y = 0.5 + i;
    check(m2_scene_add_body(scene, &def, NULL));
  }

  m2_world* world = NULL;
  check(m2_world_new(scene, M2_MERGE_SLEEP, &world));
  m2_scene_free(scene); /* the world has a copy */
  for (int second = 0; second <= 2; ++second) {
    m2_counts now;
    check(m2_world_counts(world, &now));
    printf("t = %.1f s: %d bodies, %d simulated, %d collections\n", m2_world_time(world),
           now.bodies, now.active_bodies, now.collections);
    check(m2_world_step(world, 100));
  }

  m2_collection_id lowest = M2_NO_COLLECTION, highest = M2_NO_COLLECTION;
  check(m2_world_collection_of(world, 1, &lowest));
  check(m2_world_collection_of(world, 10, &highest));
  m2_world_free(world);
  return lowest != M2_NO_COLLECTION && lowest == highest ? 0 : 1;
}
