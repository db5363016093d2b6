/* What happens when a ball hits a wall that has merged: events, step by step. */

#include <merge2d/merge2d.h>
#include <stdio.h>
#include <stdlib.h>

static void check(m2_status status) {
  if (status == M2_OK) return;
  fprintf(stderr, "%s\n", m2_error());
  exit(1);
}

static void add_box(m2_scene* scene, m2_motion motion, double x, double y, m2_shape shape) {
  m2_body_def def = m2_body_def_default();
  def.motion = motion;
  def.position.x = x;
  def.position.y = y;
  def.shapes = &shape; /* used, not kept */
  def.shape_count = 1;
  check(m2_scene_add_body(scene, &def, NULL));
}

int main(void) {
  m2_scene* scene = m2_scene_new();
  add_box(scene, M2_PINNED, 0.0, -0.5, m2_box(20.0, 1.0));
  for (int i = 0; i < 6; ++i) add_box(scene, M2_DYNAMIC, 0.0, 0.5 + i, m2_box(1.0, 1.0));

  m2_world* world = NULL;
  check(m2_world_new(scene, M2_MERGE_SLEEP, &world));
  m2_scene_free(scene);
  check(m2_world_step(world, 100)); /* the tower merges */

  m2_body_def ball = m2_body_def_default();
  m2_shape disc = m2_circle(0.4);
  ball.name = "ball";
  ball.position.x = -4.0;
  ball.position.y = 4.5;
  ball.velocity.x = 12.0;
  ball.shapes = &disc;
  ball.shape_count = 1;
  check(m2_world_add_body(world, &ball, NULL));

  size_t unmerges = 0;
  for (int i = 0; i < 200; ++i) {
    const m2_event* events = NULL;
    size_t count = 0;
    check(m2_world_step(world, 1));
    check(m2_world_events(world, &events, &count));
    for (size_t k = 0; k < count; ++k) {
      const m2_event* e = &events[k];
      if (e->type != M2_EVENT_UNMERGE && e->type != M2_EVENT_IMPACT) continue;
      printf("t = %.2f s: %s of bodies %u and %u, %s\n", m2_world_time(world),
             m2_event_type_name((m2_event_type)e->type), (unsigned)e->a, (unsigned)e->b,
             m2_reason_name((m2_reason)e->reason));
      if (e->type == M2_EVENT_UNMERGE) ++unmerges;
    }
  }
  m2_world_free(world);
  return unmerges > 0 ? 0 : 1;
}
